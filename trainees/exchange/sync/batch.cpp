#include "trainees/exchange/sync/batch.h"

#include <algorithm>
#include <set>

#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::sync {
namespace {

/// Reads do not hold up writers (write-ahead log), and see one state.
class Reading {
 public:
  explicit Reading(sqlite3* connection) : connection_(connection) { sql::execute(connection, "BEGIN"); }
  ~Reading() { sql::execute(connection_, "COMMIT"); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

 private:
  sqlite3* connection_;
};

class BatchReader {
 public:
  BatchReader(sqlite3* connection, Batch& batch) : connection_(connection), batch_(&batch) {}

  void add_entry(const std::string& action, const std::string& subject, const std::string& detail) {
    if (action == kActionFinished) return add_attempt(subject);
    const std::size_t blank = action.rfind(' ');
    const std::string table = action.substr(0, blank),
                      verb = blank == std::string::npos ? "" : action.substr(blank + 1);
    const auto& names = sealed_tables();
    if (std::find(names.begin(), names.end(), table) == names.end()) return;  // accounts, groups, the file itself
    if (verb == "added" && !tells_who(table, subject)) add_sealed(table, subject, detail);
  }

  void add_identities() {
    sql::Statement people(connection_,
                          "SELECT t.uuid FROM person p JOIN trainee t ON t.id = p.trainee_id ORDER BY t.uuid");
    while (people.step()) {
      add(carried_bases()[2], people.text(0));
      add(carried_person(), people.text(0));
    }
    sql::Statement rows(connection_,
                        "SELECT action, subject, detail FROM audit WHERE action IN ('consent added', 'signature added',"
                        " 'rating added') ORDER BY position");
    while (rows.step()) {
      const std::string table = rows.text(0).substr(0, rows.text(0).find(' '));
      if (tells_who(table, rows.text(1))) add_sealed(table, rows.text(1), rows.text(2));
    }
  }

  void add_older_attempts() {
    sql::Statement rows(
        connection_,
        "SELECT uuid FROM attempt a WHERE status <> 'running' AND chain_position IS NOT NULL AND NOT EXISTS"
        " (SELECT 1 FROM audit u WHERE u.subject = a.uuid AND u.action = ?) ORDER BY chain_position");
    rows.bind(kActionFinished);
    while (rows.step()) add_attempt(rows.text(0));
  }

 private:
  bool tells_who(const std::string& table, const std::string& uuid) const {
    if (table == "consent") return true;
    if (table != "signature" && table != "rating") return false;
    sql::Statement own(connection_, "SELECT 1 FROM " + table +
                                        " r JOIN account c ON c.uuid = r.account_uuid WHERE r.uuid = ?"
                                        " AND c.trainee_id IS NOT NULL");
    return own.bind(uuid).step();
  }

  void add(const CarriedTable& table, const std::string& key) {
    if (key.empty() || !seen_.insert(table.name + " " + key).second) return;
    for (Values& row : local_rows(connection_, table, key)) batch_->rows[table.name].push_back(std::move(row));
  }

  void add_bases(const std::string& trainee, const std::string& exercise, const std::string& ruleset) {
    const auto& bases = carried_bases();
    add(bases[0], exercise);
    add(bases[1], ruleset);
    add(bases[2], trainee);
  }

  void add_attempt(const std::string& uuid) {
    sql::Statement about(connection_,
                         "SELECT a.id, t.uuid, a.exercise_id, a.ruleset_sha256, EXISTS (SELECT 1 FROM erasure e WHERE"
                         " e.trainee_id = t.id AND e.kind = 'training' AND row_holds('erasure', e.id)) FROM attempt a"
                         " JOIN trainee t ON t.id = a.trainee_id WHERE a.uuid = ?");
    if (!about.bind(uuid).step()) {
      batch_->problems.push_back("attempt " + uuid + " is in the audit trail and not in the database; not pushed");
      return;
    }
    const bool erased = about.integer(4) != 0;
    if (!erased && !attempt_vouched(connection_, about.integer(0))) {
      batch_->problems.push_back("attempt " + uuid + " was changed after it was finished; not pushed");
      return;
    }
    add_bases(about.text(1), about.text(2), about.text(3));
    add(carried_attempt(), uuid);
    for (const CarriedTable& table : carried_of_attempt()) add(table, uuid);
  }

  void add_sealed(const std::string& name, const std::string& uuid, const std::string& digest) {
    const CarriedTable& table = carried_sealed(name);
    std::vector<Values> rows = local_rows(connection_, table, uuid);
    if (rows.empty()) return;  // erased since, or check() tells
    if (digest_of_row(connection_, name, uuid) != digest) {
      batch_->problems.push_back(name + " " + uuid + " was changed after it was written; not pushed");
      return;
    }
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (table.columns[i].central == "trainee_uuid") add(carried_bases()[2], rows.front()[i].value_or(""));
      if (table.columns[i].central == "exercise_id") add(carried_bases()[0], rows.front()[i].value_or(""));
    }
    rows.front().push_back(digest);
    if (seen_.insert(name + " " + uuid).second) batch_->rows[name].push_back(std::move(rows.front()));
  }

  sqlite3* connection_;
  Batch* batch_;
  std::set<std::string> seen_;
};

}  // namespace

const CarriedTable& carried_audit() {
  static const CarriedTable kTable = [] {
    CarriedTable table{"audit", {}, 1, ""};
    for (const char* name : {"position", "utc", "actor", "action", "subject", "detail", "prev_hash", "row_hash"}) {
      table.columns.push_back({name, name, "", "", table.columns.empty() ? Kind::kInteger : Kind::kText});
    }
    return table;
  }();
  return kTable;
}

Batch read_batch(sqlite3* connection, std::int64_t from, int most) {
  const Reading reading(connection);
  Batch batch;
  batch.to = from;
  BatchReader reader(connection, batch);
  if (from == 0) reader.add_older_attempts();
  sql::Statement entries(connection,
                         "SELECT position, utc, actor, action, subject, detail, prev_hash, row_hash FROM audit"
                         " WHERE position > ? ORDER BY position LIMIT ?");
  entries.bind(from).bind(most);
  while (entries.step()) {
    Values values;
    for (int i = 0; i < entries.columns(); ++i) values.emplace_back(entries.text(i));
    batch.to = entries.integer(0);
    batch.audit.push_back(std::move(values));
    reader.add_entry(entries.text(3), entries.text(4), entries.text(5));
  }
  return batch;
}

Batch read_identities(sqlite3* connection) {
  const Reading reading(connection);
  Batch batch;
  BatchReader(connection, batch).add_identities();
  return batch;
}

}  // namespace trocar::sync
