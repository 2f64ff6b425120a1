#include "trainees/records/attempt_recovery.h"

#include <cstdint>
#include <utility>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/records/process_identity.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolderEnding = ".recordings";

struct RunningAttempt {
  std::int64_t id;
  std::string uuid, trainee, stored_recording;
  ProcessIdentity owner;
};

std::vector<RunningAttempt> running_attempts(sqlite3* connection) {
  std::vector<RunningAttempt> attempts;
  sql::Statement rows(
      connection,
      "SELECT a.id, a.uuid, t.code, recording_path, owner_pid, owner_boot, owner_start"
      " FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id WHERE status = 'running' ORDER BY a.id");
  while (rows.step()) {
    attempts.push_back(
        {rows.integer(0), rows.text(1), rows.text(2), rows.text(3), {rows.integer(4), rows.text(5), rows.integer(6)}});
  }
  return attempts;
}

/// Nothing but what is left of an attempt that was cut off.
/// @param problem why its row is not the one that began, "" when it is.
AttemptResult aborted_result(const fs::path& recording, const std::string& problem) {
  AttemptResult result;
  result.grade.status = AttemptStatus::kAborted;
  result.grade.grade = "not graded";
  result.integrity = problem.empty() ? "its program ended before the attempt was stored" : problem;
  result.cut_off = true;
  if (!recording.empty()) result.recording_sha256 = digest::of_readable_file(recording);
  return result;
}

/// @returns false when another program has ended the attempt in the meantime.
bool end_attempt(sqlite3* connection, const RunningAttempt& attempt, const fs::path& recording) {
  sql::Transaction transaction(connection);
  {
    sql::Statement again(connection, "SELECT 1 FROM attempt WHERE id = ? AND status = 'running'");
    if (!again.bind(attempt.id).step()) return false;
  }
  // Of a row that was changed nobody knows what file it names.
  const fs::path kept = as_begun(connection, attempt.uuid) ? recording : fs::path();
  write_result(connection, attempt.id, aborted_result(kept, begun_problem(connection, attempt.uuid)),
               kept.empty() ? "" : attempt.stored_recording);
  transaction.commit();
  return true;
}

}  // namespace

std::vector<RecoveredAttempt> recover_dead_attempts(sqlite3* connection, const fs::path& database) {
  std::vector<RecoveredAttempt> recovered;
  for (const RunningAttempt& attempt : running_attempts(connection)) {
    // Whoever changed the row may have given it an owner that lives for ever.
    if (process_lives(attempt.owner) && as_begun(connection, attempt.uuid)) continue;
    const fs::path recording = located_recording(database, attempt.stored_recording);
    std::error_code error;
    const bool left = !recording.empty() && fs::is_regular_file(fs::symlink_status(recording, error));
    const fs::path kept = left ? recording : fs::path();
    if (!end_attempt(connection, attempt, kept)) continue;
    recovered.push_back({attempt.uuid, attempt.trainee, kept});
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

std::vector<fs::path> recording_places(const fs::path& database, const std::string& stored) {
  if (stored.empty()) return {};
  const fs::path name = stored;
  if (database.empty()) return {name};
  const fs::path kept = name.is_absolute() ? name : database.parent_path() / name,
                 own = recordings_folder(database) / name.filename();
  if (kept == own) return {kept};
  // The usual place moves with the database's name; one that somebody chose is looked at first.
  const bool usual = !name.is_absolute() && name.parent_path().extension() == kFolderEnding;
  return usual ? std::vector<fs::path>{own, kept} : std::vector<fs::path>{kept, own};
}

fs::path located_recording(const fs::path& database, const std::string& stored) {
  const std::vector<fs::path> places = recording_places(database, stored);
  std::error_code error;
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, error)) return place;
  return places.empty()                   ? fs::path()
         : fs::path(stored).is_absolute() ? fs::path(stored)
                                          : database.parent_path() / stored;
}

fs::path recordings_folder(const fs::path& database) {
  return database.parent_path() / (database.stem().string() + kFolderEnding);
}

}  // namespace trocar
