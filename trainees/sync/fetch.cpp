#include "trainees/sync/fetch.h"

#include <algorithm>
#include <set>

#include "haptics/input_error.h"
#include "trainees/anchored_transaction.h"
#include "trainees/erasure.h"
#include "trainees/kept_rows.h"
#include "trainees/sealed_rows.h"

namespace trocar::sync {
namespace {

constexpr std::size_t kAtOnce = 200;

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// A benchmark or certificate may name an exercise that was never practised here.
void know_exercise(sqlite3* connection, const CarriedTable& table, const Values& row) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].central != "exercise_id") continue;
    sql::Statement exercise(connection, "INSERT INTO exercise SELECT ?1, '', '' WHERE NOT EXISTS (SELECT 1 FROM exercise WHERE id = ?1)");
    exercise.bind(row[i].value_or("")).run();
    keep_exercise_once(connection, row[i].value_or(""));
  }
}

std::string author_of(const CarriedTable& table, const Values& row) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].central == "author" || table.columns[i].central == "account_uuid") return row[i].value_or("");
  }
  return "";
}

void insert_sealed(sqlite3* connection, const CarriedTable& table, const Values& row) {
  const std::string uuid = row.front().value_or("");
  know_exercise(connection, table, row);
  insert_local(connection, table, row);
  if (digest_of_row(connection, table.name, uuid) != row.back()) throw InputError("its content is not that of its hash; left out");
  seal_row(connection, table.name, uuid, author_of(table, row));
}

struct KnownPerson {
  std::string code;
  bool done = false;  ///< an erasure of that kind, or of more, stands here
};

std::optional<KnownPerson> person_here(sqlite3* connection, const std::string& trainee, const std::string& kind) {
  sql::Statement row(connection, "SELECT code, EXISTS (SELECT 1 FROM erasure WHERE trainee_id = k.id AND kind IN (?2, 'training'))"
                                 " FROM known_trainee k WHERE uuid = ?1");
  if (!row.bind(trainee).bind(kind).step()) return std::nullopt;
  return KnownPerson{row.text(0), row.integer(1) != 0};
}

}  // namespace

std::vector<std::string> missing_here(CentralLink& link, sqlite3* connection, const CarriedTable& table) {
  const Column& key = table.columns.front();
  std::set<std::string> here;
  sql::Statement rows(connection, "SELECT " + quoted(key.local) + " FROM " + table.name);
  while (rows.step()) here.insert(rows.text(0));
  std::vector<std::string> missing;
  for (const Values& row : link.run("SELECT " + quoted(key.central) + " FROM " + quoted(table.name) + " ORDER BY 1")) {
    if (!here.contains(row.front().value_or(""))) missing.push_back(row.front().value_or(""));
  }
  return missing;
}

void fetch_missing(CentralLink& link, sqlite3* connection, const CarriedTable& table,
                   const std::function<void(const std::vector<Values>& rows)>& take) {
  const std::vector<std::string> keys = missing_here(link, connection, table);
  for (std::size_t from = 0; from < keys.size(); from += kAtOnce) {
    const auto begin = keys.begin() + static_cast<std::ptrdiff_t>(from);
    take(central_rows(link, table, {begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, keys.size() - from))}));
  }
}

bool take_one(sqlite3* connection, const std::string& name, std::vector<std::string>& problems, const std::function<void()>& action) {
  sql::execute(connection, "SAVEPOINT one");
  try {
    action();
    sql::execute(connection, "RELEASE one");
    return true;
  } catch (const InputError& error) {
    sql::execute(connection, "ROLLBACK TO one; RELEASE one");
    problems.push_back(name + ": " + error.what());
    return false;
  }
}

void take_sealed(CentralLink& link, Database& database, const CarriedTable& table, PullReport& report) {
  sqlite3* connection = database.connection();
  fetch_missing(link, connection, table, [&](const std::vector<Values>& rows) {
    AnchoredTransaction transaction(database);
    int taken = 0;
    for (const Values& row : rows) {
      taken += take_one(connection, table.name + " " + row.front().value_or(""), report.problems,
                        [&] { insert_sealed(connection, table, row); });
    }
    if (taken == 0) return;
    transaction.commit();
    report.added[table.name] += taken;
  });
}

void take_erasures(CentralLink& link, Database& database, bool apply, PullReport& report) {
  // 'training' comes after 'identity': it takes what that leaves.
  for (const Values& row : link.run("SELECT trainee_uuid, kind, rule, author, utc FROM erasure ORDER BY kind, uuid")) {
    const std::string trainee = row[0].value_or(""), kind = row[1].value_or("");
    const auto person = person_here(database.connection(), trainee, kind);
    if (!person || person->done) continue;
    const std::string name = "trainee " + person->code + " (" + trainee + ")";
    if (!apply) {
      report.erasures.push_back(name + ": erased elsewhere (" + kind + "; " + row[2].value_or("") + "; " + row[4].value_or("") +
                                "), not here: --apply-erasures does it");
      continue;
    }
    try {
      erase_trainee(database, person->code, kind == "training" ? ErasureKind::kTraining : ErasureKind::kIdentity, row[2].value_or(""),
                    {row[3].value_or(""), ""});
      ++report.erased;
    } catch (const InputError& error) {
      report.problems.push_back(name + ": cannot be erased here: " + error.what());
    }
  }
}

}  // namespace trocar::sync
