#include "trainees/attempt_rows.h"

#include "haptics/input_error.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

Severity severity_of(const std::string& name) {
  for (const Severity severity : {Severity::kInfo, Severity::kMinor, Severity::kMajor, Severity::kCritical}) {
    if (name == severity_name(severity)) return severity;
  }
  throw InputError("database: unknown severity \"" + name + "\"");
}

void insert_events(sqlite3* connection, std::int64_t attempt, const std::vector<Event>& events) {
  sql::Statement insert(connection, "INSERT INTO event VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const Event& event : events) {
    insert.bind(attempt).bind(position++).bind(event.t_s).bind(event.type).bind(severity_name(event.severity));
    insert.bind(event.object).bind(event.value).bind(event.unit);
    insert.bind(event.tip_T.x()).bind(event.tip_T.y()).bind(event.tip_T.z()).run();
  }
}

void insert_grade(sqlite3* connection, std::int64_t attempt, const Grade& grade) {
  sql::Statement metric(connection, "INSERT INTO metric VALUES (?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const Metric& row : grade.metrics) {
    metric.bind(attempt).bind(position++).bind(row.name).bind(row.value).bind(row.unit).run();
  }
  sql::Statement subscore(connection, "INSERT INTO subscore VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  position = 0;
  for (const Subscore& row : grade.subscores) {
    subscore.bind(attempt).bind(position++).bind(row.name).bind(row.value).bind(row.weight).bind(row.raw);
    subscore.bind(row.unit).bind(row.full_at).bind(row.zero_at).bind(row.gate).run();
  }
  sql::Statement cap(connection, "INSERT INTO score_cap VALUES (?, ?, ?)");
  position = 0;
  for (const std::string& reason : grade.caps) cap.bind(attempt).bind(position++).bind(reason).run();
}

std::vector<Event> read_events(sqlite3* connection, std::int64_t attempt) {
  std::vector<Event> events;
  sql::Statement rows(connection,
                      "SELECT t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m FROM event"
                      " WHERE attempt_id = ? ORDER BY position");
  rows.bind(attempt);
  while (rows.step()) {
    events.push_back({rows.real(0), rows.text(1), severity_of(rows.text(2)), static_cast<std::int32_t>(rows.integer(3)),
                      rows.real(4), rows.text(5), Vec3(rows.real(6), rows.real(7), rows.real(8))});
  }
  return events;
}

}  // namespace

void insert_attempt_rows(sqlite3* connection, std::int64_t attempt, const AttemptResult& result) {
  insert_events(connection, attempt, result.events);
  insert_grade(connection, attempt, result.grade);
}

void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result) {
  result.events = read_events(connection, attempt);
  sql::Statement metrics(connection, "SELECT name, value, unit FROM metric WHERE attempt_id = ? ORDER BY position");
  metrics.bind(attempt);
  while (metrics.step()) {
    result.grade.metrics.push_back({metrics.text(0), metrics.optional_real(1), metrics.text(2)});
  }
  sql::Statement subscores(connection,
                           "SELECT name, value, weight, raw, unit, full_at, zero_at, gate FROM subscore"
                           " WHERE attempt_id = ? ORDER BY position");
  subscores.bind(attempt);
  while (subscores.step()) {
    result.grade.subscores.push_back({subscores.text(0), subscores.real(1), subscores.real(2),
                                      subscores.optional_real(3), subscores.text(4), subscores.real(5),
                                      subscores.real(6), subscores.integer(7) != 0});
  }
  sql::Statement caps(connection, "SELECT reason FROM score_cap WHERE attempt_id = ? ORDER BY position");
  caps.bind(attempt);
  while (caps.step()) result.grade.caps.push_back(caps.text(0));
}

}  // namespace trocar
