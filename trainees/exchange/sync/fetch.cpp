#include "trainees/exchange/sync/fetch.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/central_rights.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/erasure.h"

namespace trocar::sync {
namespace {

constexpr std::size_t kAtOnce = 200;

std::string quoted_name(const std::string& name) { return "\"" + name + "\""; }

/// A benchmark or certificate may name an exercise that was never practised here.
void know_exercise(sqlite3* connection, const CarriedTable& table, const Values& row) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].central != "exercise_id") continue;
    sql::Statement exercise(
        connection, "INSERT INTO exercise SELECT ?1, '', '' WHERE NOT EXISTS (SELECT 1 FROM exercise WHERE id = ?1)");
    exercise.bind(row[i].value_or("")).run();
    keep_exercise_once(connection, row[i].value_or(""));
  }
}

std::optional<std::string> value_at(const CarriedTable& table, const Values& row, const std::string& column) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].central == column) return row[i];
  }
  return std::nullopt;
}

bool is_here(sqlite3* connection, const char* table, const std::string& uuid) {
  sql::Statement row(connection, std::string("SELECT 1 FROM ") + table + " WHERE uuid = ?");
  return row.bind(uuid).step();
}

/// Whether the row has a place here.
bool has_place(sqlite3* connection, const CarriedTable& table, const Values& row, const Links& links) {
  if (const auto attempt = value_at(table, row, "attempt_uuid"); attempt && !is_here(connection, "attempt", *attempt))
    return false;
  if (const auto trainee = value_at(table, row, "trainee_uuid");
      trainee && !is_here(connection, "trainee", links.home(connection, *trainee))) {
    return false;
  }
  for (const auto& [of, ended] : {std::pair{"certificate", "revocation"}, std::pair{"assignment", "withdrawal"}}) {
    const auto what = value_at(table, row, std::string(of) + "_uuid");
    if (!what) continue;
    sql::Statement once(connection, std::string("SELECT EXISTS (SELECT 1 FROM ") + ended + " e WHERE " + of +
                                        "_id = w.id AND row_holds('" + ended + "', e.id)) FROM " + of +
                                        " w WHERE uuid = ?");
    return once.bind(*what).step() && once.integer(0) == 0;
  }
  return true;
}

/// Its UUID puts a row in its place among all of its kind (next_row_uuid): one that is none, or of a time far ahead,
/// would be the last word. @param latest of latest_time(): that of the centre, for the clock here may be wrong.
void require_name_of_row(const std::string& uuid, const std::string& latest) {
  if (!is_time_ordered(uuid)) throw InputError("its UUID is none of trocar's; left out");
  if (uuid.substr(0, 8) + uuid.substr(9, 4) > latest)
    throw InputError("its UUID is of a time more than a year ahead of the centre's clock; left out");
}

void insert_sealed(sqlite3* connection, const CarriedTable& table, const Values& row, const Links& links,
                   const std::string& latest) {
  const std::string uuid = row.front().value_or("");
  require_name_of_row(uuid, latest);
  Values placed = row;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].central != "trainee_uuid" || !row[i]) continue;
    placed[i] = links.home(connection, row[i].value_or(""));
    if (placed[i] != row[i]) note_origin(connection, uuid, row[i].value_or(""));
  }
  know_exercise(connection, table, row);
  insert_local(connection, table, placed);
  if (digest_of_row(connection, table.name, uuid) != row.back())
    throw InputError("its content is not that of its hash; left out");
  seal_row(connection, table.name, uuid, kFromCentre);
}

struct KnownPerson {
  std::string code;
  bool done = false;  ///< an erasure of that kind, or of more, stands here
};

std::optional<KnownPerson> person_here(sqlite3* connection, const std::string& trainee, const std::string& kind) {
  sql::Statement row(connection,
                     "SELECT code, EXISTS (SELECT 1 FROM erasure e WHERE trainee_id = k.id AND kind IN (?2, 'training')"
                     " AND row_holds('erasure', e.id))"
                     " FROM known_trainee k WHERE uuid = ?1");
  if (!row.bind(trainee).bind(kind).step()) return std::nullopt;
  return KnownPerson{row.text(0), row.integer(1) != 0};
}

}  // namespace

std::vector<std::string> missing_here(CentralLink& link, sqlite3* connection, const CarriedTable& table,
                                      const Wanted& wanted) {
  const Column& key = table.columns.front();
  std::vector<std::string> parameters{std::to_string(wanted.since)};
  parameters.insert(parameters.end(), wanted.parameters.begin(), wanted.parameters.end());
  const std::string where = wanted.condition.empty() ? "" : " AND (" + wanted.condition + ")";
  std::vector<std::string> missing;
  sql::Statement here(connection, "SELECT 1 FROM " + table.name + " WHERE " + quoted_name(key.local) + " = ?");
  for (const Values& row : link.run("SELECT " + quoted_name(key.central) + " FROM " + quoted_name(table.name) +
                                        " c WHERE c.seq > $1::bigint" + where + " ORDER BY 1",
                                    parameters)) {
    if (!here.bind(row.front().value_or("")).step()) missing.push_back(row.front().value_or(""));
    here.run();
  }
  return missing;
}

void fetch_missing(CentralLink& link, sqlite3* connection, const CarriedTable& table, const Wanted& wanted,
                   const std::function<void(const std::vector<Values>& rows)>& take) {
  const std::vector<std::string> keys = missing_here(link, connection, table, wanted);
  for (std::size_t from = 0; from < keys.size(); from += kAtOnce) {
    const auto begin = keys.begin() + static_cast<std::ptrdiff_t>(from);
    take(
        central_rows(link, table, {begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, keys.size() - from))}));
  }
}

bool take_one(sqlite3* connection, const std::string& name, std::vector<std::string>& problems,
              const std::function<void()>& action) {
  sql::execute(connection, "SAVEPOINT one");
  try {
    action();
    sql::execute(connection, "RELEASE one");
    return true;
  } catch (const InputError& error) {
    sql::execute(connection, "ROLLBACK TO one; RELEASE one");
    std::string line = name + ": " + error.what();
    for (char& c : line) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';  // it is printed on a terminal
    }
    problems.push_back(std::move(line));
    return false;
  }
}

void take_sealed(CentralLink& link, Database& database, const CarriedTable& table, const Wanted& wanted,
                 const Links& links, PullReport& report) {
  sqlite3* connection = database.connection();
  std::string latest;
  fetch_missing(link, connection, table, wanted, [&](const std::vector<Values>& rows) {
    if (latest.empty()) latest = link.run("SELECT " + latest_time()).front().front().value_or("");
    AnchoredTransaction transaction(database);
    int taken = 0;
    for (const Values& row : rows) {
      const std::string uuid = row.front().value_or("");
      // Somebody else's write may have been first: between the question and here.
      if (is_here(connection, table.name.c_str(), uuid) || !has_place(connection, table, row, links)) continue;
      taken += take_one(connection, table.name + " " + uuid, report.problems,
                        [&] { insert_sealed(connection, table, row, links, latest); });
    }
    if (taken == 0) return;
    transaction.commit();
    report.added[table.name] += taken;
  });
}

void take_erasures(CentralLink& link, Database& database, bool apply, PullReport& report) {
  // 'training' comes after 'identity': it takes what that leaves.
  for (const Values& row :
       link.run("SELECT trainee_uuid, kind, rule, author, utc FROM erased_trainee ORDER BY kind, utc, trainee_uuid")) {
    const std::string trainee = row[0].value_or(""), kind = row[1].value_or("");
    const auto person = person_here(database.connection(), trainee, kind);
    if (!person || person->done) continue;
    const std::string name = "trainee " + person->code + " (" + trainee + ")";
    if (!apply) {
      report.erasures.push_back(name + ": erased elsewhere (" + kind + "; " + row[2].value_or("") + "; " +
                                row[4].value_or("") + "), not here: --apply-erasures does it");
      continue;
    }
    try {
      erase_trainee(database, person->code, kind == "training" ? ErasureKind::kTraining : ErasureKind::kIdentity,
                    row[2].value_or(""), {row[3].value_or(""), ""});
      ++report.erased;
    } catch (const InputError& error) {
      report.problems.push_back(name + ": cannot be erased here: " + error.what());
    }
  }
}

}  // namespace trocar::sync
