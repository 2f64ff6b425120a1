// Trainees, known by a code ("T-expert") and a UUID; no names stand here. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trainees/database.h"

namespace trocar {

struct Trainee {
  std::int64_t id = 0;
  std::string uuid, code, created_utc;
  int attempts = 0;  ///< finished ones
  int passes = 0;
  std::string last_utc;  ///< start of the newest attempt, empty when none
};

class TraineeStore {
 public:
  explicit TraineeStore(Database& database) : connection_(database.connection()) {}

  /// The trainee of that code, created when new. Codes differ by more than case.
  /// @throws InputError: a code is 1 to 32 letters, digits, '.', '-' or '_', beginning with a letter or digit, and
  /// not with "erased-".
  Trainee ensure_trainee(const std::string& code);
  /// The same, but only the row's number, and inside the caller's transaction.
  std::int64_t ensure_id(const std::string& code);
  std::optional<Trainee> find(const std::string& code) const;
  /// All, by code.
  std::vector<Trainee> list() const;

 private:
  sqlite3* connection_;
};

}  // namespace trocar
