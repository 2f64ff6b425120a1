// Attempts that died with their process: found when the database is opened and ended, their recording kept.
//
// An attempt whose recording is whole was over before its program died, or before its result could be stored (a full
// disk, a database held too long): it is graded again from the recording and stored as what it was. Any other is ended
// as "aborted". Internal to trainees/ but for RecoveredAttempt and Regrade, which the program knows.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"

struct sqlite3;

namespace trocar {

struct RecoveredAttempt {
  std::string uuid, trainee;
  std::filesystem::path recording;  ///< readable to its last whole chunk; empty when there is none
  AttemptStatus status = AttemptStatus::kAborted;
  std::optional<double> score;
};

/// The result that a recording holds; nothing when it is cut off. May throw InputError for a damaged one.
using Regrade = std::function<std::optional<AttemptResult>(const std::filesystem::path& recording)>;

/// Ends every attempt whose process no longer lives. Attempts of living processes are not touched.
/// @param database its file, empty when in memory. @param regrade empty: all are aborted.
std::vector<RecoveredAttempt> recover_dead_attempts(sqlite3* connection, const std::filesystem::path& database,
                                                    const Regrade& regrade);

/// How a recording is named in the database: relative to the database's folder when it lies inside, so that both can
/// move together; absolute otherwise.
std::string stored_recording_path(const std::filesystem::path& database, const std::filesystem::path& recording);
/// NAME.recordings beside NAME.db.
std::filesystem::path recordings_folder(const std::filesystem::path& database);
/// Where a recording may be, likeliest first: under the database's present name, for it may be a copy, and where it was
/// kept.
std::vector<std::filesystem::path> recording_places(const std::filesystem::path& database, const std::string& stored);
/// The first of them that is there, else where it was kept.
std::filesystem::path located_recording(const std::filesystem::path& database, const std::string& stored);

}  // namespace trocar
