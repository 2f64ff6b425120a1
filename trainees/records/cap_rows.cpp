#include "trainees/records/cap_rows.h"

#include <sqlite3.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

CapKind cap_kind_of(const std::string& name) {
  const auto at =
      std::find_if(kCapKinds.begin(), kCapKinds.end(), [&](CapKind kind) { return name == cap_kind_name(kind); });
  if (at == kCapKinds.end()) throw InputError("database: unknown kind of cap \"" + name + "\"");
  return *at;
}

std::string text_value(sqlite3_value* value) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_value_text(value));
  return text == nullptr ? "" : std::string(text, static_cast<std::size_t>(sqlite3_value_bytes(value)));
}

void say_cap(sqlite3_context* context, int /*count*/, sqlite3_value** values) {
  try {
    const std::string said =
        cap_sentence({cap_kind_of(text_value(values[0])), text_value(values[1]), sqlite3_value_double(values[2]),
                      sqlite3_value_int(values[3]), sqlite3_value_int(values[4]), sqlite3_value_double(values[5])});
    sqlite3_result_text(context, said.data(), static_cast<int>(said.size()), SQLITE_TRANSIENT);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, error.what(), -1);
  }
}

}  // namespace

void insert_caps(sqlite3* connection, std::int64_t score, const std::vector<Cap>& caps) {
  sql::Statement insert(connection, "INSERT INTO score_cap VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const Cap& cap : caps) {
    insert.bind(score).bind(position++).bind(cap_kind_name(cap.kind)).bind(cap.subject).bind(cap.below);
    insert.bind(cap.done).bind(cap.total).bind(cap.at_most).run();
  }
}

std::vector<Cap> read_caps(sqlite3* connection, std::int64_t attempt) {
  std::vector<Cap> caps;
  sql::Statement rows(connection,
                      "SELECT kind, subject, below, done, total, at_most FROM score_cap WHERE score_id ="
                      " (SELECT id FROM score WHERE attempt_id = ? AND revision = 0) ORDER BY position");
  rows.bind(attempt);
  while (rows.step()) {
    caps.push_back({cap_kind_of(rows.text(0)), rows.text(1), rows.real(2), static_cast<int>(rows.integer(3)),
                    static_cast<int>(rows.integer(4)), rows.real(5)});
  }
  return caps;
}

void add_cap_sentence(sqlite3* connection) {
  const int code = sqlite3_create_function(connection, "cap_sentence", 6, SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr,
                                           say_cap, nullptr, nullptr);
  if (code != SQLITE_OK) sql::raise(connection, code, "cannot add a function");
}

}  // namespace trocar
