#include "trainees/integrity/sealed_rows.h"

#include <sqlite3.h>

#include <map>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

constexpr const char* kAccountTable = "account";

struct SealedTable {
  std::string name, columns, from;  ///< r: the row itself
  bool travels = true;              ///< sealed_tables() names it
};

/// Other rows stand by their UUID, so that digests hold in every database that a row is carried to.
const std::vector<SealedTable>& tables() {
  static const std::string whose = origin_sql("r.uuid", "t.uuid");
  static const std::string of_trainee = " r JOIN trainee t ON t.id = r.trainee_id";
  static const std::string of_attempt = " r JOIN attempt a ON a.id = r.attempt_id";
  static const std::vector<SealedTable> kSealedTables{
      {"curriculum", "r.name, r.version, r.sha256, r.toml, r.author, r.utc", "curriculum r"},
      {"benchmark", "r.exercise_id, r.level, r.metric, r.full_at, r.zero_at, r.n, r.source, r.rule, r.author, r.utc",
       "benchmark r"},
      {"consent", whose + ", r.purpose, r.given, r.text, r.author, r.utc", "consent" + of_trainee},
      {"note", whose + ", (SELECT uuid FROM attempt WHERE id = r.attempt_id), r.author, r.printed, r.text, r.utc",
       "note" + of_trainee},
      {"rating", "a.uuid, r.account_uuid, r.rater, r.scale, r.item, r.value, r.utc", "rating" + of_attempt},
      {"signature", "a.uuid, r.row_hash, r.account_uuid, r.signer, r.meaning, r.note, r.utc", "signature" + of_attempt},
      {"verdict_override", "a.uuid, r.row_hash, r.author, r.printed, r.passed, r.reason, r.utc",
       "verdict_override" + of_attempt},
      {"certificate", whose + ", r.exercise_id, r.level, r.rule_version, r.evidence, r.author, r.printed, r.utc",
       "certificate" + of_trainee},
      {"revocation", "c.uuid, r.author, r.printed, r.reason, r.utc",
       "revocation r JOIN certificate c ON c.id = r.certificate_id"},
      {"erasure", "t.uuid, r.kind, r.rule, r.author, r.utc", "erasure" + of_trainee},
      {"standing", whose + ", r.active, r.reason, r.author, r.printed, r.utc", "standing" + of_trainee},
      {"assignment", whose + ", r.group_name, r.programme, r.due, r.author, r.printed, r.utc",
       "assignment r LEFT JOIN trainee t ON t.id = r.trainee_id"},
      {"withdrawal", "a.uuid, r.reason, r.author, r.printed, r.utc",
       "withdrawal r JOIN assignment a ON a.id = r.assignment_id"},
      {kAccountTable,
       "r.login, r.name, r.role, (SELECT uuid FROM trainee WHERE id = r.trainee_id), r.password, r.created_utc,"
       " r.disabled_utc",
       "account r", false},
  };
  return kSealedTables;
}

std::string actor_of(const std::string& author) { return author.empty() ? "trocar" : author; }

/// Column 0 is the UUID.
std::string digest_of_columns(const std::string& table, const sql::Statement& row) {
  std::string content = "trocar-row-1\n" + table + "\n";
  for (int column = 0; column < row.columns(); ++column) content += row.canonical(column);
  return digest::of_bytes(content);
}

std::string query_of(const SealedTable& table) { return "SELECT r.uuid, " + table.columns + " FROM " + table.from; }

const SealedTable& table_named(const std::string& name) {
  for (const SealedTable& table : tables())
    if (table.name == name) return table;
  throw InputError(name + ": no table whose rows are sealed");
}

/// Digests of the table's rows as they stand, by UUID. Rows that nothing can name are told at once.
std::map<std::string, std::string> digests_of(sqlite3* connection, const SealedTable& table,
                                              std::vector<std::string>& problems) {
  std::map<std::string, std::string> digests;
  sql::Statement rows(connection, query_of(table));
  while (rows.step()) {
    if (rows.text(0).empty()) {
      problems.push_back("a row of " + table.name + " has no identifier: it came in by another way");
    } else {
      digests[rows.text(0)] = digest_of_columns(table.name, rows);
    }
  }
  return digests;
}

bool erased_on_record(sqlite3* connection, const std::string& table, const std::string& uuid) {
  sql::Statement entry(connection,
                       "SELECT 1 FROM audit u JOIN erasure e ON e.uuid = u.detail WHERE u.subject = ? AND u.action = ?"
                       " AND row_holds('erasure', e.id)");
  return entry.bind(uuid).bind(table + " erased").step();
}

std::string named(const std::string& table, const std::string& uuid) { return table + " " + uuid; }

void check_table(sqlite3* connection, const SealedTable& table, std::vector<std::string>& problems) {
  auto digests = digests_of(connection, table, problems);
  const bool account = table.name == kAccountTable;  // of an account only the newest entry counts
  sql::Statement entries(
      connection, account ? "SELECT subject, detail FROM audit u WHERE action GLOB ? AND action <> 'account erased' AND"
                            " position = (SELECT max(position) FROM audit WHERE subject = u.subject AND action GLOB"
                            " 'account *' AND action <> 'account erased') ORDER BY position"
                          : "SELECT subject, detail FROM audit WHERE action = ? ORDER BY position");
  entries.bind(table.name + (account ? " *" : " added"));
  while (entries.step()) {
    const std::string uuid = entries.text(0);
    const auto row = digests.find(uuid);
    if (row == digests.end()) {
      if (!erased_on_record(connection, table.name, uuid)) problems.push_back(named(table.name, uuid) + " is missing");
      continue;
    }
    if (row->second != entries.text(1))
      problems.push_back(named(table.name, uuid) + " was changed after it was written");
    digests.erase(row);
  }
  for (const auto& [uuid, unused] : digests) {
    problems.push_back(named(table.name, uuid) + " has no entry in the audit trail: it came in by another way");
  }
}

/// What is bound to an attempt is bound to its bytes.
void check_bound(sqlite3* connection, const char* table, std::vector<std::string>& problems) {
  sql::Statement rows(
      connection, std::string("SELECT r.uuid, a.uuid FROM ") + table +
                      " r JOIN attempt a ON a.id = r.attempt_id WHERE r.row_hash IS NOT a.row_hash ORDER BY r.uuid");
  while (rows.step()) {
    problems.push_back(named(table, rows.text(0)) + " was given for another record than attempt " + rows.text(1) +
                       " holds");
  }
}

void check_texts(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(connection, "SELECT sha256, toml, name, version FROM curriculum ORDER BY uuid");
  while (rows.step()) {
    if (digest::of_bytes(rows.text(1)) == rows.text(0)) continue;
    problems.push_back("curriculum " + rows.text(2) + ", version " + rows.text(3) +
                       ": its text is not the one of its sha256");
  }
}

template <bool kPosition>
void say_row_holds(sqlite3_context* context, int /*count*/, sqlite3_value** values) {
  const auto* table = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
  try {
    const std::int64_t entry = RowEntries(sqlite3_context_db_handle(context), table == nullptr ? "" : table)
                                   .of(sqlite3_value_int64(values[1]));
    if (kPosition && entry == 0)
      sqlite3_result_null(context);
    else
      sqlite3_result_int64(context, kPosition ? entry : entry > 0);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, error.what(), -1);
  }
}

}  // namespace

RowEntries::RowEntries(sqlite3* connection, const std::string& table)
    : table_(table),
      account_(table == kAccountTable),
      content_(connection, query_of(table_named(table)) + " WHERE r.id = ?"),
      entries_(connection, std::string("SELECT ") + kEntryColumns + " FROM audit WHERE subject = ? AND action " +
                               (account_ ? "GLOB ? ORDER BY position DESC LIMIT 1" : "= ?")),
      signed_(connection) {}

std::int64_t RowEntries::of(std::int64_t row) {
  std::int64_t found = 0;
  if (content_.bind(row).step()) {
    const std::string digest = digest_of_columns(table_, content_);
    entries_.bind(content_.text(0)).bind(table_ + (account_ ? " *" : " added"));
    while (found == 0 && entries_.step())
      if (entries_.view(5) == digest && signed_.contains(entries_)) found = entries_.integer(0);
    entries_.run();
  }
  content_.run();
  return found;
}

void add_row_holds(sqlite3* connection) {
  const std::pair<const char*, decltype(&say_row_holds<false>)> kFunctions[] = {{"row_holds", say_row_holds<false>},
                                                                                {"row_entry", say_row_holds<true>}};
  for (const auto& [name, function] : kFunctions) {
    const int code = sqlite3_create_function(connection, name, 2, SQLITE_UTF8 | SQLITE_DIRECTONLY, nullptr, function,
                                             nullptr, nullptr);
    if (code != SQLITE_OK) sql::raise(connection, code, "cannot add a function");
  }
}

const std::vector<std::string>& sealed_tables() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const SealedTable& table : tables()) {
      if (table.travels) names.push_back(table.name);
    }
    return names;
  }();
  return kNames;
}

std::string next_row_uuid(sqlite3* connection, const std::string& table) {
  sql::Statement rows(connection, "SELECT uuid, id FROM " + table + " ORDER BY uuid DESC");
  while (rows.step())  // a row that came in by another way counts nowhere, and takes no UUID away
    if (row_holds(connection, table, rows.integer(1))) return make_uuid_after(rows.text(0));
  return make_uuid_after("");
}

std::string newest_first(const std::string& table, const std::string& row, const std::string& of) {
  // What was written here was written after all that stood here: it counts as if it had the greatest UUID of these.
  // That of a program's own is so by itself; rows of older programs and a clock that was set back are not.
  const std::string entry = "row_entry('" + table + "', " + row + ".id)";
  return " ORDER BY CASE (SELECT n.actor FROM audit n WHERE n.position = " + entry + ") WHEN '" +
         std::string(kFromCentre) + "' THEN " + row + ".uuid ELSE max(" + row + ".uuid) FILTER (WHERE " + entry +
         " IS NOT NULL) OVER (PARTITION BY " + row + "." + of + " ORDER BY " + entry + ") END DESC, " + entry + " DESC";
}

bool row_holds(sqlite3* connection, const std::string& table, std::int64_t row) {
  return RowEntries(connection, table).of(row) > 0;
}

std::string digest_of_row(sqlite3* connection, const std::string& table, const std::string& uuid) {
  sql::Statement row(connection, query_of(table_named(table)) + " WHERE r.uuid = ?");
  if (row.bind(uuid).step()) return digest_of_columns(table, row);
  throw InputError(named(table, uuid) + ": not in this database");
}

void seal_row(sqlite3* connection, const std::string& table, const std::string& uuid, const std::string& author) {
  append_audit(connection, table + " added", uuid, digest_of_row(connection, table, uuid), actor_of(author));
}

void note_erased_row(sqlite3* connection, const std::string& table, const std::string& uuid,
                     const std::string& erasure_uuid, const std::string& author) {
  append_audit(connection, table + " erased", uuid, erasure_uuid, actor_of(author));
}

void seal_account(sqlite3* connection, const std::string& action, const std::string& uuid, const std::string& author) {
  append_audit(connection, action, uuid, digest_of_row(connection, kAccountTable, uuid), actor_of(author));
}

std::vector<std::string> check_sealed_rows(sqlite3* connection) {
  std::vector<std::string> problems;
  for (const SealedTable& table : tables()) check_table(connection, table, problems);
  for (const char* table : {"signature", "verdict_override"}) check_bound(connection, table, problems);
  check_texts(connection, problems);
  return problems;
}

}  // namespace trocar
