// Trainees, known by a code ("T-expert") and a UUID. Name and e-mail address are kept where somebody gives them, and go
// with the identity. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

struct Trainee {
  std::int64_t id = 0;
  std::string uuid, code, created_utc;
  std::string name = {}, email = {};  ///< empty where none was given
  int attempts = 0;                   ///< finished ones
  int passes = 0;
  std::string last_utc;  ///< start of the newest attempt, empty when none
};

/// @throws InputError: a code is 1 to 32 letters, digits, '.', '-' or '_', beginning with a letter or digit, and not
/// with "erased-".
void check_trainee_code(const std::string& code);
/// Enough to catch a name in the wrong place; whether an address is anybody's only a letter to it can tell.
/// @throws InputError
void check_address(const std::string& email);

class TraineeStore {
 public:
  explicit TraineeStore(Database& database) : database_(&database), connection_(database.connection()) {}

  /// The trainee of that code, created when new. Codes differ by more than case.
  /// @throws InputError: as check_trainee_code().
  Trainee ensure_trainee(const std::string& code);
  /// The same, but only the row's number, and inside the caller's transaction.
  std::int64_t ensure_id(const std::string& code);
  /// @param name code, "erased-..." of somebody whose identity has gone, or the trainee's whole UUID.
  std::optional<Trainee> find(const std::string& name) const;
  /// Name and e-mail address; what is not given stays, "" takes it away. @param author account's UUID, "" from the
  /// command line. @param check throws where what stands now is not to be changed: nobody else changes it in between.
  /// @throws InputError: nobody, erased, a name of more than 100 bytes, no address, the station's key is lost.
  Trainee edit(const std::string& code, const std::optional<std::string>& name, const std::optional<std::string>& email,
               const std::string& author, const std::function<void(const Trainee&)>& check = {});
  /// All, by code.
  std::vector<Trainee> list() const;

 private:
  Database* database_;
  sqlite3* connection_;
};

}  // namespace trocar
