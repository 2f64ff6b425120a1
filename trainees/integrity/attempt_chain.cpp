#include "trainees/integrity/attempt_chain.h"

#include <unordered_set>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

const std::string kAttempt =
    "SELECT a.uuid, " + origin_sql("a.uuid", "t.uuid") +
    ", a.exercise_id, exercise_version, a.ruleset_sha256, level, seed, board, hand, organ_name,"
    " organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, owner_boot, owner_start,"
    " finished_utc, s.value, coalesce(s.passed, 0), coalesce(s.grade, 'not graded'), recording_path, recording_sha256,"
    " state_hash, device_backend, device_rate_hz, device_ticks, device_overruns, saturated_contact_share,"
    " passivity_active_share, min_energy_j, kappa, device_fault,"
    " program, integrity, cut_off, device_realtime, device_plant, assists, (SELECT uuid FROM session WHERE id = "
    "session_id),"
    " (SELECT sha256 FROM device_calibration WHERE id = calibration_id), s.revision, s.ruleset_sha256"
    " FROM attempt a JOIN trainee t ON t.id = a.trainee_id LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0"
    " WHERE a.id = ?";

constexpr const char* kRows[] = {
    "SELECT r.id & 1048575, t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m FROM event_row r"
    " CROSS JOIN event_kind k ON k.id = r.kind_id WHERE r.id BETWEEN ?1 << 20 AND ?1 << 20 | 1048575 ORDER BY r.id",
    "SELECT position, name, r.value, unit FROM score s CROSS JOIN metric_row r ON r.id BETWEEN s.id << 10 AND s.id << "
    "10 | 1023"
    " CROSS JOIN metric_kind k ON k.id = r.id & 1023 WHERE s.attempt_id = ? AND s.revision = 0 ORDER BY position",
    "SELECT r.id & 1023, name, r.value, weight, raw, unit, full_at, zero_at, gate FROM score s"
    " CROSS JOIN subscore_row r ON r.id BETWEEN s.id << 10 AND s.id << 10 | 1023 CROSS JOIN subscore_kind k ON k.id = "
    "r.kind_id"
    " WHERE s.attempt_id = ? AND s.revision = 0 ORDER BY r.id",
    "SELECT position, kind, subject, below, done, total, at_most FROM score_cap m JOIN score s ON s.id = m.score_id"
    " WHERE s.attempt_id = ? AND s.revision = 0 ORDER BY position",
    "SELECT position, name, first_s, ticks FROM device_warning WHERE attempt_id = ? ORDER BY position",
    "SELECT r.id & 1048575, t_s, from_state, to_state FROM device_transition_row r CROSS JOIN device_change c ON c.id "
    "= r.change_id"
    " WHERE r.id BETWEEN ?1 << 20 AND ?1 << 20 | 1048575 ORDER BY r.id",
};

void add_rows(sqlite3* connection, const std::string& query, std::int64_t attempt, std::string& content) {
  sql::Statement rows(connection, query);
  rows.bind(attempt);
  while (rows.step()) {
    for (int column = 0, columns = rows.columns(); column < columns; ++column) rows.append_canonical(column, content);
    content += '\n';
  }
  content += "--\n";
}

std::string content_of(sqlite3* connection, std::int64_t attempt) {
  std::string content;
  content.reserve(16384);
  add_rows(connection, kAttempt, attempt, content);
  for (const char* query : kRows) add_rows(connection, query, attempt, content);
  return content;
}

/// What row_hash is made of besides the content.
struct Link {
  std::int64_t attempt, position, version;
  std::string previous, status;
};

std::string row_hash(sqlite3* connection, const Link& link) {
  return digest::of_bytes("trocar-attempt-" + std::to_string(link.version) + "\n" + link.previous + "\n" +
                          std::to_string(link.position) + "\n" + link.status + "\n" +
                          content_of(connection, link.attempt));
}

const std::string kLink =
    "SELECT a.id, a.uuid, coalesce(r.chain_position, a.chain_position), coalesce(r.prev_hash, a.prev_hash), row_hash, "
    "status, hash_version";
/// Whose training data are gone; an erasure that no signed entry holds excuses nothing.
const std::string kErased =
    "a.trainee_id IN (SELECT trainee_id FROM erasure WHERE kind = 'training' AND row_holds('erasure', id))";
const std::string kFinishedAttempts =
    " FROM attempt a LEFT JOIN replica r ON r.attempt_id = a.id WHERE status <> 'running'";
const std::string kLinks = kLink + ", " + kErased + kFinishedAttempts;
constexpr const char* kOwn = " AND r.attempt_id IS NULL";
constexpr const char* kOfOthers = " AND r.attempt_id IS NOT NULL";

Link link_of(const sql::Statement& row) {
  return {row.integer(0), row.integer(2), row.integer(6), row.text(3), row.text(5)};
}

Link next_link(sqlite3* connection, std::int64_t attempt, AttemptStatus status) {
  sql::Statement version(connection, "SELECT hash_version FROM attempt WHERE id = ?");
  version.bind(attempt).step();
  Link link{attempt, 1, version.integer(0), "", status_name(status)};
  sql::Statement last(connection,
                      "SELECT chain_position, row_hash FROM attempt WHERE chain_position IS NOT NULL"
                      " AND status <> 'running' ORDER BY chain_position DESC LIMIT 1");
  if (last.step()) {
    link.position = last.integer(0) + 1;
    link.previous = last.text(1);
    require_hash(link.previous, "the newest attempt");
  }
  return link;
}

/// Rows that an erasure has taken away must not be there.
void check_erased(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(connection,
                      "SELECT a.uuid FROM attempt a WHERE " + kErased +
                          " AND (EXISTS (SELECT 1 FROM score WHERE attempt_id = a.id)"
                          " OR EXISTS (SELECT 1 FROM event WHERE attempt_id = a.id)"
                          " OR EXISTS (SELECT 1 FROM device_warning WHERE attempt_id = a.id)"
                          " OR EXISTS (SELECT 1 FROM device_transition WHERE attempt_id = a.id)) ORDER BY a.id");
  while (rows.step())
    problems.push_back("attempt " + rows.text(0) + " has rows although its training data were erased");
}

/// Attempts of other stations: content, and that what each followed is here too. The chains of several stations lie
/// side by side.
void check_replicas(sqlite3* connection, std::vector<std::string>& problems) {
  std::unordered_set<std::string> there;
  if (sql::query_integer(connection, "SELECT EXISTS (SELECT 1 FROM replica)") == 0) return;
  sql::Statement known(connection,
                       "SELECT coalesce(r.chain_position, a.chain_position), a.row_hash FROM attempt a"
                       " LEFT JOIN replica r ON r.attempt_id = a.id WHERE a.row_hash IS NOT NULL");
  while (known.step()) there.insert(known.text(0) + " " + known.text(1));
  sql::Statement links(connection, kLinks + kOfOthers + " ORDER BY a.id");
  while (links.step()) {
    const std::string name = "attempt " + links.text(1);
    const Link link = link_of(links);
    if (link.position > 1 && !there.contains(std::to_string(link.position - 1) + " " + link.previous)) {
      problems.push_back(name + " of another station follows one that is not here");
    }
    const bool erased = links.integer(7) != 0;
    if (!erased && row_hash(connection, link) != links.text(4))
      problems.push_back(name + " of another station was changed");
  }
}

void check_attempt_texts(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement versions(connection, "SELECT sha256, toml, exercise_id FROM ruleset ORDER BY sha256");
  while (versions.step()) {
    if (digest::of_bytes(versions.text(1)) != versions.text(0)) {
      problems.push_back("exercise " + versions.text(2) + ", version " + versions.text(0).substr(0, 12) +
                         ", was changed");
    }
  }
  sql::Statement calibrations(connection, "SELECT sha256, toml, device FROM device_calibration ORDER BY id");
  while (calibrations.step()) {
    if (digest::of_bytes(calibrations.text(1)) != calibrations.text(0)) {
      problems.push_back("calibration of " + calibrations.text(2) + ", " + calibrations.text(0).substr(0, 12) +
                         ", was changed");
    }
  }
}

}  // namespace

void seal_attempt(sqlite3* connection, std::int64_t attempt, AttemptStatus status) {
  const Link link = next_link(connection, attempt, status);
  const std::string hash = row_hash(connection, link);
  sql::Statement seal(connection,
                      "UPDATE attempt SET status = ?, chain_position = ?, prev_hash = ?, row_hash = ? WHERE id = ?");
  seal.bind(link.status).bind(link.position).bind(link.previous).bind(hash).bind(attempt).run();
  sql::Statement uuid(connection, "SELECT uuid FROM attempt WHERE id = ?");
  uuid.bind(attempt).step();
  append_audit(connection, kActionFinished, uuid.text(0), hash);
}

bool attempt_holds(sqlite3* connection, std::int64_t attempt) {
  sql::Statement row(connection, kLink + kFinishedAttempts + " AND a.id = ?");
  return row.bind(attempt).step() && row_hash(connection, link_of(row)) == row.text(4);
}

bool attempt_vouched(sqlite3* connection, std::int64_t attempt) {
  if (!attempt_holds(connection, attempt)) return false;
  sql::Statement entry(connection,
                       "SELECT u.position FROM attempt a JOIN audit u ON u.subject = a.uuid AND u.action IN (?, ?)"
                       " AND u.detail = a.row_hash WHERE a.id = ?");
  entry.bind(kActionFinished).bind(kActionReplicated).bind(attempt);
  while (entry.step())
    if (entry_signed(connection, entry.integer(0))) return true;
  return false;
}

void require_vouched(sqlite3* connection, std::int64_t attempt, const std::string& what) {
  if (attempt_vouched(connection, attempt)) return;
  sql::Statement row(connection, "SELECT uuid FROM attempt WHERE id = ?");
  row.bind(attempt).step();
  throw InputError("attempt " + row.text(0) + ": was changed after it was finished and cannot be " + what +
                   "; see trocar db check");
}

std::vector<std::string> check_chain(sqlite3* connection) {
  std::vector<std::string> problems;
  sql::Statement links(connection, kLinks + kOwn + " ORDER BY a.chain_position");
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
    const bool erased = links.integer(7) != 0;
    if (!erased && row_hash(connection, link_of(links)) != links.text(4)) {
      problems.push_back(name + " was changed after it was finished");
    }
    previous = links.text(4);
    expected = position + 1;
  }
  check_replicas(connection, problems);
  check_erased(connection, problems);
  check_attempt_texts(connection, problems);
  return problems;
}

}  // namespace trocar
