#include "trainees/attempt_recovery.h"

#include <cstdint>

#include "digest/digest.h"
#include "trainees/attempt_chain.h"
#include "trainees/attempt_identity.h"
#include "trainees/process_identity.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

struct RunningAttempt {
  std::int64_t id;
  std::string uuid, trainee, stored_recording;
  ProcessIdentity owner;
};

std::vector<RunningAttempt> running_attempts(sqlite3* connection) {
  std::vector<RunningAttempt> attempts;
  sql::Statement rows(connection,
                      "SELECT a.id, a.uuid, t.code, recording_path, owner_pid, owner_boot, owner_start"
                      " FROM attempt a JOIN trainee t ON t.id = a.trainee_id WHERE status = 'running' ORDER BY a.id");
  while (rows.step()) {
    attempts.push_back(
        {rows.integer(0), rows.text(1), rows.text(2), rows.text(3), {rows.integer(4), rows.text(5), rows.integer(6)}});
  }
  return attempts;
}

/// @returns false when another program has ended the attempt in the meantime.
bool abort_attempt(sqlite3* connection, const RunningAttempt& attempt, const std::string& recording,
                   const std::string& sha256) {
  sql::Transaction transaction(connection);
  {
    sql::Statement again(connection, "SELECT 1 FROM attempt WHERE id = ? AND status = 'running'");
    if (!again.bind(attempt.id).step()) return false;
  }
  sql::Statement update(connection,
                        "UPDATE attempt SET finished_utc = ?, recording_path = ?, recording_sha256 = ?"
                        " WHERE id = ?");
  update.bind(utc_now()).bind(recording).bind(sha256).bind(attempt.id).run();
  seal_attempt(connection, attempt.id, AttemptStatus::kAborted);
  transaction.commit();
  return true;
}

}  // namespace

std::vector<RecoveredAttempt> recover_dead_attempts(sqlite3* connection, const fs::path& database) {
  std::vector<RecoveredAttempt> recovered;
  for (const RunningAttempt& attempt : running_attempts(connection)) {
    if (process_lives(attempt.owner)) continue;
    const fs::path recording = located_recording(database, attempt.stored_recording);
    std::error_code error;
    const bool left = !recording.empty() && fs::is_regular_file(recording, error);
    const std::string sha256 = left ? digest::of_readable_file(recording) : "";
    if (abort_attempt(connection, attempt, left ? attempt.stored_recording : "", sha256)) {
      recovered.push_back({attempt.uuid, attempt.trainee, left ? recording : fs::path()});
    }
  }
  return recovered;
}

std::string stored_recording_path(const fs::path& database, const fs::path& recording) {
  if (recording.empty()) return "";
  const fs::path absolute = fs::absolute(recording).lexically_normal();
  if (database.empty()) return absolute.string();
  const fs::path relative = absolute.lexically_relative(database.parent_path());
  return relative.empty() || *relative.begin() == ".." ? absolute.string() : relative.string();
}

fs::path located_recording(const fs::path& database, const std::string& stored) {
  if (stored.empty() || fs::path(stored).is_absolute()) return stored;
  return database.parent_path() / stored;
}

}  // namespace trocar
