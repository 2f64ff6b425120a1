// Attempts that died with their process: found when the database is opened, ended as "aborted", their recording kept.
//
// Internal to trainees/ but for RecoveredAttempt, which the program reports.
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

/// Marks every attempt whose process no longer lives as aborted and stores the digest of the recording it left.
/// Attempts of living processes are not touched. @param database its file, empty when in memory.
std::vector<RecoveredAttempt> recover_dead_attempts(sqlite3* connection, const std::filesystem::path& database);

/// How a recording is named in the database: relative to the database's folder when it lies inside, so that both can
/// move together; absolute otherwise.
std::string stored_recording_path(const std::filesystem::path& database, const std::filesystem::path& recording);
/// The inverse.
std::filesystem::path located_recording(const std::filesystem::path& database, const std::string& stored);

}  // namespace trocar
