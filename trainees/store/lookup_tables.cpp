#include "trainees/store/lookup_tables.h"

#include <initializer_list>

#include "haptics/input_error.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// Words with a sign between them that no name has.
std::string key_of(std::initializer_list<std::string_view> words) {
  std::string key;
  for (const std::string_view word : words) (key += word) += '\0';
  return key;
}

constexpr const char* kOfSubscore =
    "SELECT id FROM subscore_kind WHERE name = ?1 AND unit = ?2 AND weight IS ?3 AND full_at IS ?4 AND zero_at IS ?5 "
    "AND gate = ?6";

sql::Statement& bound(sql::Statement& statement, const Subscore& s) {
  return statement.bind(s.name).bind(s.unit).bind(s.weight).bind(s.full_at).bind(s.zero_at).bind(s.gate);
}

}  // namespace

EventKinds::EventKinds(sqlite3* connection) : connection_(connection) {
  sql::Statement rows(connection, "SELECT id, type, severity, unit FROM event_kind");
  while (rows.step()) known_[key_of({rows.view(1), rows.view(2), rows.view(3)})] = rows.integer(0);
}

std::int64_t EventKinds::number(const std::string& type, std::string_view severity, const std::string& unit) {
  std::int64_t& known = known_[key_of({type, severity, unit})];
  if (known != 0) return known;
  // The lowest two bits as the table asks for them.
  sql::Statement insert(
      connection_,
      "INSERT INTO event_kind SELECT (coalesce(max(id), 0) / 4 + 1) * 4 + (?2 = 'critical')"
      " + 2 * (?1 IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH')), ?1, ?2, ?3 FROM event_kind"
      " RETURNING id");
  insert.bind(type).bind(severity).bind(unit).step();
  known = insert.integer(0);
  insert.run();
  return known;
}

MetricKinds::MetricKinds(sqlite3* connection) : connection_(connection) {
  sql::Statement rows(connection, "SELECT id, name, unit FROM metric_kind");
  while (rows.step()) known_[key_of({rows.view(1), rows.view(2)})] = rows.integer(0);
}

std::int64_t MetricKinds::number(const std::string& name, const std::string& unit) {
  if (!taken_.insert(name).second) throw InputError("metric " + name + ": is there already");
  std::int64_t& known = known_[key_of({name, unit})];
  if (known != 0) return known;
  sql::Statement insert(connection_, "INSERT INTO metric_kind (name, unit) VALUES (?, ?) RETURNING id");
  insert.bind(name).bind(unit).step();
  known = insert.integer(0);
  insert.run();
  return known;
}

std::int64_t subscore_kind(sqlite3* connection, const Subscore& subscore) {
  {
    sql::Statement known(connection, kOfSubscore);
    if (bound(known, subscore).step()) return known.integer(0);
  }
  sql::Statement insert(connection,
                        "INSERT INTO subscore_kind (name, unit, weight, full_at, zero_at, gate)"
                        " VALUES (?, ?, ?, ?, ?, ?) RETURNING id");
  bound(insert, subscore).step();
  const std::int64_t number = insert.integer(0);
  insert.run();
  return number;
}

std::int64_t device_change(sqlite3* connection, const std::string& from, const std::string& to) {
  {
    sql::Statement known(connection, "SELECT id FROM device_change WHERE from_state = ? AND to_state = ?");
    if (known.bind(from).bind(to).step()) return known.integer(0);
  }
  sql::Statement insert(connection, "INSERT INTO device_change (from_state, to_state) VALUES (?, ?) RETURNING id");
  insert.bind(from).bind(to).step();
  const std::int64_t number = insert.integer(0);
  insert.run();
  return number;
}

}  // namespace trocar
