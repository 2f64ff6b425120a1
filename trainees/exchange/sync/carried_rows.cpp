#include "trainees/exchange/sync/carried_rows.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/central_rights.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::sync {
namespace {

using Json = nlohmann::json;

std::string of(const char* what, const char* table, const std::string& where) {
  return std::string("(SELECT ") + what + " FROM " + table + " WHERE " + where + ")";
}

/// "@trainee" and the like: a column that points to another row.
Column reference(const std::string& to) {
  if (to == "score") {
    const char* joined = "score s JOIN attempt a ON a.id = s.attempt_id";
    return {"attempt_uuid", "score_id", of("a.uuid", joined, "s.id = r.score_id"),
            of("s.id", joined, "a.uuid = ? AND s.revision = 0")};
  }
  if (to == "calibration") {
    return {"calibration_sha256", "calibration_id", of("sha256", "device_calibration", "id = r.calibration_id"),
            of("id", "device_calibration", "sha256 = ? LIMIT 1")};
  }
  const std::string local = to + "_id";
  return {to + "_uuid", local, of("uuid", to.c_str(), "id = r." + local), of("id", to.c_str(), "uuid = ?")};
}

/// Whose a row was when it was written: one that was moved to a linked trainee goes as it was.
Column origin() {
  return {"trainee_uuid", "trainee_id", origin_sql("r.uuid", of("uuid", "trainee", "id = r.trainee_id")),
          of("id", "trainee", "uuid = ?")};
}

/// name: text, name#: integer, name~: real, @table: a reference.
Column column_of(std::string word) {
  if (word == "@origin") return origin();
  if (word.front() == '@') return reference(word.substr(1));
  Kind kind = Kind::kText;
  if (word.back() == '#') kind = Kind::kInteger;
  if (word.back() == '~') kind = Kind::kReal;
  if (kind != Kind::kText) word.pop_back();
  return {word, word, "", "", kind};
}

CarriedTable table(const char* name, const char* words, int keys = 1, const char* seal = "") {
  CarriedTable made{name, {}, keys, seal};
  std::istringstream in(words);
  for (std::string word; in >> word;) made.columns.push_back(column_of(word));
  return made;
}

CarriedTable sealed(const char* name, const char* words) { return table(name, words, 1, "digest"); }

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

const char* central_type(Kind kind) {
  switch (kind) {
    case Kind::kInteger:
      return "bigint";
    case Kind::kReal:
      return "double precision";
    default:
      return "text";
  }
}

bool has_digest(const CarriedTable& table) { return table.seal == "digest"; }

/// Columns at the centre with what `each` adds to their names, separated by commas; `digest` at the end of sealed
/// tables.
template <class Each>
std::string listed(const CarriedTable& table, const Each& each) {
  std::string text;
  for (const Column& column : table.columns)
    text += (text.empty() ? "" : ", ") + each(quoted(column.central), column.kind);
  return has_digest(table) ? text + ", " + each("\"digest\"", Kind::kText) : text;
}

std::string name_only(const std::string& name, Kind) { return name; }
std::string with_type(const std::string& name, Kind kind) { return name + " " + central_type(kind); }
std::string as_text(const std::string& name, Kind) { return name + "::text"; }

/// @param of "c." where a column of the table is meant and not one of the result: what went through ::text sorts as
/// text.
std::string keys_of(const CarriedTable& table, const std::string& of = "") {
  std::string text;
  for (std::size_t key = 0; key < static_cast<std::size_t>(table.keys); ++key) {
    text += (key == 0 ? "" : ", ") + of + quoted(table.columns[key].central);
  }
  return text;
}

std::string shortest(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::optional<std::string> value_of(const sql::Statement& row, int column, Kind kind) {
  if (row.is_null(column)) return std::nullopt;
  return kind == Kind::kReal ? shortest(row.real(column)) : row.text(column);
}

template <class Number>
Number number_of(const std::string& text) {
  Number number{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size())
    throw InputError("central database: \"" + text + "\" is no number");
  return number;
}

void bind_value(sql::Statement& statement, const std::optional<std::string>& value, Kind kind) {
  if (!value)
    statement.bind_null();
  else if (kind == Kind::kInteger)
    statement.bind(number_of<std::int64_t>(*value));
  else if (kind == Kind::kReal)
    statement.bind(number_of<double>(*value));
  else
    statement.bind(*value);
}

}  // namespace

const std::vector<CarriedTable>& carried_bases() {
  static const std::vector<CarriedTable> kTables{
      table("exercise", "id number title"),
      table("ruleset", "sha256 exercise_id version toml"),
      table("trainee", "uuid created_utc"),
  };
  return kTables;
}

const CarriedTable& carried_person() {
  static const CarriedTable kTable = table("person", "@trainee code name email");
  return kTable;
}

const CarriedTable& carried_attempt() {
  static const CarriedTable kTable = table("attempt",
                                           "uuid @origin @session @calibration exercise_id exercise_version "
                                           "ruleset_sha256 level seed# board# hand organ_name organ_source"
                                           " organ_sha256 organ_synthetic# organ_credit program started_utc owner_pid# "
                                           "owner_boot owner_start# status integrity cut_off#"
                                           " finished_utc recording_path recording_sha256 state_hash device_backend "
                                           "device_rate_hz~ device_ticks# device_overruns#"
                                           " saturated_contact_share~ passivity_active_share~ min_energy_j~ kappa~ "
                                           "device_fault device_realtime device_plant assists hash_version#"
                                           " chain_position# prev_hash row_hash",
                                           1, "row_hash");
  return kTable;
}

const std::vector<CarriedTable>& carried_of_attempt() {
  static const std::vector<CarriedTable> kTables{
      table("event", "@attempt position# t_s~ type severity object# value~ unit tip_x_m~ tip_y_m~ tip_z_m~", 2),
      table("device_warning", "@attempt position# name first_s~ ticks#", 2),
      table("device_transition", "@attempt position# t_s~ from_state to_state", 2),
      table("score", "@attempt revision# ruleset_sha256 value~ passed# grade", 2),
      table("metric", "@score name position# value~ unit", 2),
      table("subscore", "@score name position# value~ weight~ raw~ unit full_at~ zero_at~ gate#", 2),
      table("score_cap", "@score position# kind subject below~ done# total# at_most~", 2),
  };
  return kTables;
}

const std::vector<CarriedTable>& carried_sealed() {
  static const std::vector<CarriedTable> kTables{
      sealed("curriculum", "uuid name version# sha256 toml author utc"),
      sealed("benchmark", "uuid exercise_id level metric full_at~ zero_at~ n# source rule author utc"),
      sealed("consent", "uuid @origin purpose given# text author utc"),
      sealed("note", "uuid @origin @attempt author printed text utc"),
      sealed("rating", "uuid @attempt account_uuid rater scale item value~ utc"),
      sealed("signature", "uuid @attempt row_hash account_uuid signer meaning note utc"),
      sealed("verdict_override", "uuid @attempt row_hash author printed passed# reason utc"),
      sealed("certificate", "uuid @origin exercise_id level rule_version evidence author printed utc"),
      sealed("revocation", "uuid @certificate author printed reason utc"),
      sealed("erasure", "uuid @trainee kind rule author utc"),
      sealed("standing", "uuid @origin active# reason author printed utc"),
      sealed("assignment", "uuid @origin group_name programme due author printed utc"),
      sealed("withdrawal", "uuid @assignment reason author printed utc"),
  };
  return kTables;
}

const CarriedTable& carried_sealed(const std::string& name) {
  for (const CarriedTable& table : carried_sealed()) {
    if (table.name == name) return table;
  }
  throw InputError("table " + name + ": does not go to a central database");
}

std::vector<Values> local_rows(sqlite3* connection, const CarriedTable& table, const std::string& key) {
  std::string columns;
  for (const Column& column : table.columns) {
    columns += (columns.empty() ? "" : ", ") + (column.refers.empty() ? "r." + quoted(column.local) : column.refers);
  }
  const Column& first = table.columns.front();
  sql::Statement rows(connection, "SELECT " + columns + " FROM " + table.name + " r WHERE r." + quoted(first.local) +
                                      " = " + (first.found.empty() ? "?" : first.found));
  rows.bind(key);
  std::vector<Values> all;
  while (rows.step()) {
    Values values;
    for (int i = 0; i < rows.columns(); ++i)
      values.push_back(value_of(rows, i, table.columns[static_cast<std::size_t>(i)].kind));
    all.push_back(std::move(values));
  }
  return all;
}

void insert_local(sqlite3* connection, const CarriedTable& table, const Values& row) {
  std::string columns, values;
  for (const Column& column : table.columns) {
    columns += (columns.empty() ? "" : ", ") + quoted(column.local);
    values += (values.empty() ? "" : ", ") + (column.found.empty() ? "?" : column.found);
  }
  sql::Statement insert(connection, "INSERT INTO " + table.name + " (" + columns + ") VALUES (" + values + ")");
  for (std::size_t i = 0; i < table.columns.size(); ++i) bind_value(insert, row.at(i), table.columns[i].kind);
  insert.run();
}

std::string create_statement(const CarriedTable& table) {
  return "CREATE TABLE " + quoted(table.name) + " (" + listed(table, with_type) +
         ", \"station\" text NOT NULL, \"received\" timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (" +
         keys_of(table) + "))";
}

std::vector<std::string> insert_central(CentralLink& link, const CarriedTable& table, const std::vector<Values>& rows,
                                        const std::string& station) {
  if (rows.empty()) return {};
  const auto added =
      link.run("INSERT INTO " + quoted(table.name) + " (" + listed(table, name_only) + ", \"station\") SELECT " +
                   listed(table, name_only) + ", $2 FROM json_to_recordset($1::json) AS r(" + listed(table, with_type) +
                   ") WHERE " + is_sound(table.name) + " AND (" + (has_digest(table) ? may_bring(table.name) : "true") +
                   ")" + " ON CONFLICT DO NOTHING RETURNING " + quoted(table.columns.front().central),
               {json_rows(table, rows), station});
  std::vector<std::string> keys;
  for (const Values& row : added) keys.push_back(row.front().value_or(""));
  return keys;
}

std::vector<Values> central_rows(CentralLink& link, const CarriedTable& table, const std::vector<std::string>& keys) {
  if (keys.empty()) return {};
  return link.run("SELECT " + listed(table, as_text) + " FROM " + quoted(table.name) + " c WHERE c." +
                      quoted(table.columns.front().central) +
                      " IN (SELECT json_array_elements_text($1::json)) ORDER BY " + keys_of(table, "c."),
                  {json_list(keys)});
}

std::string json_rows(const CarriedTable& table, const std::vector<Values>& rows) {
  Json all = Json::array();
  for (const Values& row : rows) {
    Json one = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string name = i < table.columns.size() ? table.columns[i].central : "digest";
      if (row[i]) one[name] = *row[i];
    }
    all.push_back(std::move(one));
  }
  try {
    return all.dump();
  } catch (const Json::exception&) {
    throw InputError("a row of " + table.name + " holds text that is not UTF-8; it cannot go to the central database");
  }
}

std::string json_list(const std::vector<std::string>& texts) { return Json(texts).dump(); }

}  // namespace trocar::sync
