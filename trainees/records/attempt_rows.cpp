#include "trainees/records/attempt_rows.h"

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/cap_rows.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/lookup_tables.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

Severity severity_of(const std::string& name) {
  for (const Severity severity : {Severity::kInfo, Severity::kMinor, Severity::kMajor, Severity::kCritical}) {
    if (name == severity_name(severity)) return severity;
  }
  throw InputError("database: unknown severity \"" + name + "\"");
}

/// Many rows in a statement, then those that are left one by one: a statement's beginning and end cost more than a row.
/// @param row "(?, ?)". @param bind binds the parameters of a row, given with its position.
template <class Row, class Bind>
void insert_rows(sqlite3* connection, const std::string& table, const std::string& row, const std::vector<Row>& rows,
                 const Bind& bind) {
  std::size_t position = 0;
  for (const std::size_t at_once : {std::size_t{20}, std::size_t{1}}) {
    std::string sql = "INSERT INTO " + table + " VALUES " + row;
    for (std::size_t k = 1; k < at_once; ++k) sql += ", " + row;
    while (rows.size() - position >= at_once) {
      sql::Statement insert(connection, sql);
      for (std::size_t k = 0; k < at_once; ++k, ++position)
        bind(insert, rows[position], static_cast<std::int64_t>(position));
      insert.run();
    }
  }
}

void insert_events(sqlite3* connection, std::int64_t attempt, const std::vector<Event>& events) {
  EventKinds kinds(connection);
  const auto bind = [&](sql::Statement& insert, const Event& event, std::int64_t position) {
    insert.bind(attempt).bind(position).bind(event.t_s).bind(
        kinds.number(event.type, severity_name(event.severity), event.unit));
    insert.bind(event.object).bind(event.value).bind(event.tip_T.x()).bind(event.tip_T.y()).bind(event.tip_T.z());
  };
  insert_rows(connection, "event_row", "(? << 20 | ?, ?, ?, ?, ?, ?, ?, ?)", events, bind);
}

std::int64_t insert_score(sqlite3* connection, std::int64_t attempt, const Grade& grade) {
  sql::Statement score(connection,
                       "INSERT INTO score (attempt_id, revision, ruleset_sha256, value, passed, grade)"
                       " SELECT id, 0, ruleset_sha256, ?, ?, ? FROM attempt WHERE id = ?");
  score.bind(grade.score).bind(grade.passed).bind(grade.grade).bind(attempt).run();
  return sql::newest_row(connection);
}

void insert_grade(sqlite3* connection, std::int64_t score, const Grade& grade) {
  MetricKinds kinds(connection);
  insert_rows(connection, "metric_row", "(? << 10 | ?, ?, ?)", grade.metrics,
              [&](sql::Statement& insert, const Metric& row, std::int64_t position) {
                insert.bind(score).bind(kinds.number(row.name, row.unit)).bind(position).bind(row.value);
              });
  sql::Statement subscore(connection, "INSERT INTO subscore_row VALUES (?1 << 10 | ?2, ?3, ?4, ?5)");
  std::int64_t position = 0;
  for (const Subscore& row : grade.subscores) {
    if (position > 1023) throw InputError("an attempt has at most 1024 sub-scores");
    subscore.bind(score).bind(position++).bind(subscore_kind(connection, row)).bind(row.value).bind(row.raw).run();
  }
  insert_caps(connection, score, grade.caps);
}

void insert_device_rows(sqlite3* connection, std::int64_t attempt, const RunReport& device) {
  sql::Statement warning(connection, "INSERT INTO device_warning VALUES (?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const DeviceWarning& row : device.warnings) {
    warning.bind(attempt).bind(position++).bind(row.name).bind(row.first_s).bind(row.ticks).run();
  }
  sql::Statement transition(connection, "INSERT INTO device_transition_row VALUES (?1 << 20 | ?2, ?3, ?4)");
  position = 0;
  for (const DeviceTransition& row : device.transitions) {
    transition.bind(attempt).bind(position++).bind(row.t_s).bind(device_change(connection, row.from, row.to)).run();
  }
}

/// UUID of another attempt that has the very recording, "" when none; asked of what no program graded.
std::string also_recorded_by(sqlite3* connection, std::int64_t attempt, const AttemptResult& result) {
  static const std::string kNothing = digest::of_bytes("");  // its program was killed before the first byte
  if (result.grade.score || result.recording_sha256.empty() || result.recording_sha256 == kNothing) return "";
  sql::Statement other(connection, "SELECT uuid FROM attempt WHERE recording_sha256 = ? AND id <> ?");
  return other.bind(result.recording_sha256).bind(attempt).step() ? other.text(0) : "";
}

void update_attempt(sqlite3* connection, std::int64_t row, const AttemptResult& result, const std::string& recording,
                    const std::string& ended_utc) {
  sql::Statement update(
      connection,
      "UPDATE attempt SET finished_utc = ?, integrity = ?, cut_off = ?, recording_path = ?,"
      " recording_sha256 = ?, state_hash = ?, device_backend = ?, device_rate_hz = ?, device_ticks = ?,"
      " device_overruns = ?, saturated_contact_share = ?, passivity_active_share = ?, min_energy_j = ?,"
      " kappa = ?, device_fault = ?, device_realtime = ?, device_plant = ? WHERE id = ?");
  const RunReport& device = result.device;
  update.bind(ended_utc).bind(result.integrity).bind(result.cut_off);
  update.bind(recording).bind(result.recording_sha256).bind(result.state_hash).bind(device.backend);
  update.bind(device.rate_hz).bind(device.ticks).bind(device.overruns).bind(device.saturated_contact_share);
  update.bind(device.passivity_active_share).bind(device.min_energy_j).bind(device.kappa).bind(device.fault);
  update.bind(device.realtime).bind(device.plant).bind(row).run();
}

std::vector<Event> read_events(sqlite3* connection, std::int64_t attempt) {
  std::vector<Event> events;
  sql::Statement rows(
      connection,
      "SELECT t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m FROM event_row r"
      " CROSS JOIN event_kind k ON k.id = r.kind_id WHERE r.id BETWEEN ?1 << 20 AND ?1 << 20 | 1048575 ORDER BY r.id");
  rows.bind(attempt);
  while (rows.step()) {
    events.push_back({rows.real(0), rows.text(1), severity_of(rows.text(2)), static_cast<std::int32_t>(rows.integer(3)),
                      rows.real(4), rows.text(5), Vec3(rows.real(6), rows.real(7), rows.real(8))});
  }
  return events;
}

void read_device_rows(sqlite3* connection, std::int64_t attempt, RunReport& device) {
  sql::Statement warnings(connection,
                          "SELECT name, first_s, ticks FROM device_warning WHERE attempt_id = ? ORDER BY position");
  warnings.bind(attempt);
  while (warnings.step()) {
    device.warnings.push_back({warnings.text(0), warnings.real(1), static_cast<std::uint64_t>(warnings.integer(2))});
  }
  sql::Statement transitions(connection,
                             "SELECT t_s, from_state, to_state FROM device_transition"
                             " WHERE attempt_id = ? ORDER BY position");
  transitions.bind(attempt);
  while (transitions.step())
    device.transitions.push_back({transitions.real(0), transitions.text(1), transitions.text(2)});
}

}  // namespace

std::int64_t remove_attempt_rows(sqlite3* connection, std::int64_t attempt) {
  const std::int64_t before = sql::changes_of(connection);
  const auto remove = [connection](const std::string& rows, std::int64_t of) {
    sql::Statement(connection, "DELETE FROM " + rows).bind(of).run();
  };
  std::vector<std::int64_t> scores;
  sql::Statement of_attempt(connection, "SELECT id FROM score WHERE attempt_id = ?");
  of_attempt.bind(attempt);
  while (of_attempt.step()) scores.push_back(of_attempt.integer(0));
  for (const std::int64_t score : scores) {
    for (const char* table : {"metric_row", "subscore_row"})
      remove(std::string(table) + " WHERE id BETWEEN ?1 << 10 AND ?1 << 10 | 1023", score);
    remove("score_cap WHERE score_id = ?", score);
  }
  for (const char* table : {"event_row", "device_transition_row"})
    remove(std::string(table) + " WHERE id BETWEEN ?1 << 20 AND ?1 << 20 | 1048575", attempt);
  for (const char* table : {"score", "device_warning"}) remove(std::string(table) + " WHERE attempt_id = ?", attempt);
  return sql::changes_of(connection) - before;
}

void write_result(sqlite3* connection, std::int64_t attempt, AttemptResult result, std::string recording,
                  const std::string& ended_utc) {
  const auto tell = [&result](const std::string& words) {
    result.integrity += (result.integrity.empty() ? "" : "; ") + words;
  };
  if (remove_attempt_rows(connection, attempt) > 0) tell("rows that were put in for it while it ran were removed");
  if (const std::string other = also_recorded_by(connection, attempt, result); !other.empty()) {
    tell("in the place of its recording lies that of attempt " + other);
    recording = result.recording_sha256 = "";
  }
  const std::string utc = ended_utc.empty() ? utc_now() : ended_utc;
  insert_events(connection, attempt, result.events);
  insert_device_rows(connection, attempt, result.device);
  insert_grade(connection, insert_score(connection, attempt, result.grade), result.grade);
  update_attempt(connection, attempt, result, recording, utc);
  sql::Statement session(connection,
                         "UPDATE session SET ended_utc = ? WHERE id = (SELECT session_id FROM attempt WHERE id = ?)");
  session.bind(utc).bind(attempt).run();  // so far: each attempt of it moves its end
  seal_attempt(connection, attempt, result.grade.status);
}

void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result) {
  result.events = read_events(connection, attempt);
  read_device_rows(connection, attempt, result.device);
  sql::Statement metrics(connection,
                         "SELECT name, r.value, unit FROM score s CROSS JOIN metric_row r ON r.id BETWEEN s.id << 10"
                         " AND s.id << 10 | 1023 CROSS JOIN metric_kind k ON k.id = r.id & 1023"
                         " WHERE s.attempt_id = ? AND s.revision = 0 ORDER BY position");
  metrics.bind(attempt);
  while (metrics.step()) {
    result.grade.metrics.push_back({metrics.text(0), metrics.optional_real(1), metrics.text(2)});
  }
  sql::Statement subscores(
      connection,
      "SELECT name, value, weight, raw, unit, full_at, zero_at, gate FROM subscore WHERE score_id ="
      " (SELECT id FROM score WHERE attempt_id = ? AND revision = 0) ORDER BY position");
  subscores.bind(attempt);
  while (subscores.step()) {
    result.grade.subscores.push_back({subscores.text(0), subscores.real(1), subscores.real(2),
                                      subscores.optional_real(3), subscores.text(4), subscores.real(5),
                                      subscores.real(6), subscores.integer(7) != 0});
  }
  result.grade.caps = read_caps(connection, attempt);
}

std::string summary_query(const std::string& code, const std::string& joins) {
  return "SELECT a.id, a.uuid, " + code +
         ", a.exercise_id, a.level, a.hand, a.started_utc, a.seed, a.board, a.status, s.value, " + sql::kPassed +
         ", coalesce(s.grade, 'not graded'), a.organ_synthetic, a.exercise_version, a.ruleset_sha256, a.integrity,"
         " coalesce(s.passed, 0), coalesce(o.printed, ''), coalesce(o.utc, ''), a.cut_off, " +
         sql::kEndedByDevice + ", " + sql::kBegun + ", " + sql::kSoftRealTime + " FROM attempt a" + joins +
         " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0" + sql::decision();
}

AttemptSummary summary_of(const sql::Statement& row) {
  AttemptSummary summary;
  summary.row = row.integer(0);
  summary.uuid = row.text(1);
  summary.trainee = row.text(2);
  summary.exercise_id = row.text(3);
  summary.level = row.text(4);
  summary.hand = row.text(5);
  summary.started_utc = row.text(6);
  summary.seed = row.integer(7);
  summary.board = static_cast<int>(row.integer(8));
  summary.status = row.text(9);
  summary.score = row.optional_real(10);
  summary.passed = row.integer(11) != 0;
  summary.grade = row.text(12);
  summary.organ_synthetic = row.integer(13) != 0;
  summary.exercise_version = row.text(14);
  summary.rubric_sha256 = row.text(15);
  summary.integrity = row.text(16);
  summary.passed_by_score = row.integer(17) != 0;
  summary.decided_by = row.text(18);
  summary.decided_utc = row.text(19);
  summary.cut_off = row.integer(20) != 0;
  summary.ended_by_device = row.integer(21) != 0;
  summary.begun = row.integer(22) != 0;
  summary.soft_real_time = row.integer(23) != 0;
  return summary;
}

}  // namespace trocar
