// Attempts that died with their process: found when the database is opened and ended, their recording kept.
//
// Nothing is graded then, not even from a recording that is whole: no program has seen that attempt to its end. What
// the recording gives can be looked at, and a person can decide on the attempt (docs/data_store.md). Internal to
// trainees/ but for RecoveredAttempt, which the program knows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

struct sqlite3;

namespace trocar {

struct RecoveredAttempt {
  std::string uuid, trainee;
  std::filesystem::path recording;  ///< readable to its last whole chunk; empty when there is none
};

/// Ends every attempt whose process no longer lives. Attempts of living processes are not touched.
/// @param database its file, empty when in memory.
std::vector<RecoveredAttempt> recover_dead_attempts(sqlite3* connection, const std::filesystem::path& database);

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
