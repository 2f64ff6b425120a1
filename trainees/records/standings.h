// Who takes part: people are deactivated and reactivated, never deleted. Sealed rows: the newest of a person holds, and
// who has none is active.
//
// Who is deactivated keeps the record and the desk's account, begins no attempt, and is left out of cohort, grid and
// reminders unless asked for. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "trainees/records/assessments.h"

namespace trocar {

struct Standing {
  bool active = true;
  std::string reason = {}, printed = {}, utc = {};  ///< of the newest row; "" without one
};

class StandingStore {
 public:
  explicit StandingStore(Database& database) : database_(&database) {}

  /// All or none. Who stands so already is left. @param codes of trainees. @param reason up to 200 bytes, may be "".
  /// @returns how many changed. @throws InputError: nobody of that code, or an attempt of theirs is running.
  int set_active(const std::set<std::string>& codes, bool active, const std::string& reason, const Author& author);
  Standing of(const std::string& code) const;

 private:
  Database* database_;
};

/// Row numbers of the trainees who are deactivated.
std::set<std::int64_t> deactivated(sqlite3* connection);

/// @throws InputError: the trainee is deactivated.
void require_active(sqlite3* connection, std::int64_t trainee);

}  // namespace trocar
