#include "trainees/attempt_chain.h"

#include "digest/digest.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

constexpr const char* kContent[] = {
    "SELECT a.uuid, t.uuid, exercise_id, exercise_version, rubric_sha256, level, seed, board, hand, organ_name,"
    " organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, owner_boot, owner_start,"
    " finished_utc, score, passed, grade, recording_path, recording_sha256, state_hash, device_backend, device_rate_hz,"
    " device_ticks, device_overruns, saturated_contact_share, passivity_active_share, min_energy_j, kappa, device_fault"
    " FROM attempt a JOIN trainee t ON t.id = a.trainee_id WHERE a.id = ?",
    "SELECT position, t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m FROM event"
    " WHERE attempt_id = ? ORDER BY position",
    "SELECT position, name, value, unit FROM metric WHERE attempt_id = ? ORDER BY position",
    "SELECT position, name, value, weight, raw, unit, full_at, zero_at, gate FROM subscore"
    " WHERE attempt_id = ? ORDER BY position",
    "SELECT position, reason FROM score_cap WHERE attempt_id = ? ORDER BY position",
};

std::string content_of(sqlite3* connection, std::int64_t attempt) {
  std::string content;
  for (const char* query : kContent) {
    sql::Statement rows(connection, query);
    rows.bind(attempt);
    while (rows.step()) {
      for (int column = 0; column < rows.columns(); ++column) content += rows.canonical(column);
      content += '\n';
    }
    content += "--\n";
  }
  return content;
}

std::string row_hash(sqlite3* connection, std::int64_t attempt, std::int64_t position, const std::string& previous,
                     const std::string& status) {
  return digest::of_bytes("trocar-attempt-1\n" + previous + "\n" + std::to_string(position) + "\n" + status + "\n" +
                          content_of(connection, attempt));
}

}  // namespace

void seal_attempt(sqlite3* connection, std::int64_t attempt, AttemptStatus status) {
  std::int64_t position = 1;
  std::string previous;
  {
    sql::Statement last(connection,
                        "SELECT chain_position, row_hash FROM attempt WHERE chain_position IS NOT NULL"
                        " ORDER BY chain_position DESC LIMIT 1");
    if (last.step()) {
      position = last.integer(0) + 1;
      previous = last.text(1);
    }
  }
  const std::string hash = row_hash(connection, attempt, position, previous, status_name(status));
  sql::Statement seal(connection,
                      "UPDATE attempt SET status = ?, chain_position = ?, prev_hash = ?, row_hash = ? WHERE id = ?");
  seal.bind(status_name(status)).bind(position).bind(previous).bind(hash).bind(attempt).run();
}

std::vector<std::string> check_chain(sqlite3* connection) {
  std::vector<std::string> problems;
  sql::Statement links(connection,
                       "SELECT id, uuid, chain_position, prev_hash, row_hash, status FROM attempt"
                       " WHERE status <> 'running' ORDER BY chain_position");
  std::string previous;
  std::int64_t expected = 1;
  while (links.step()) {
    const std::string name = "attempt " + links.text(1);
    const std::int64_t position = links.integer(2);
    if (position != expected) {
      problems.push_back("before " + name + ": attempts " + std::to_string(expected) + " to " +
                         std::to_string(position - 1) + " are missing");
    } else if (links.text(3) != previous) {
      problems.push_back(name + " does not follow the attempt before it");
    }
    if (row_hash(connection, links.integer(0), position, links.text(3), links.text(5)) != links.text(4)) {
      problems.push_back(name + " was changed after it was finished");
    }
    previous = links.text(4);
    expected = position + 1;
  }
  sql::Statement versions(connection, "SELECT sha256, toml, exercise_id FROM exercise_version ORDER BY sha256");
  while (versions.step()) {
    if (digest::of_bytes(versions.text(1)) != versions.text(0)) {
      problems.push_back("exercise " + versions.text(2) + ", version " + versions.text(0).substr(0, 12) +
                         ", was changed");
    }
  }
  return problems;
}

}  // namespace trocar
