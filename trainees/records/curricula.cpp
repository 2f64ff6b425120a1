#include "trainees/records/curricula.h"

#include <cmath>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/progress/benchmarks.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"

namespace trocar {
namespace {

constexpr std::size_t kLongestName = 64, kLongestText = 1000000;

constexpr const char* kCurricula = "SELECT uuid, name, sha256, toml, author, utc, version, id FROM curriculum";

Curriculum curriculum_of(const sql::Statement& row) {
  return {
      row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5), static_cast<int>(row.integer(6))};
}

Benchmark benchmark_of(const sql::Statement& row) {
  return {row.text(0),
          row.text(1),
          row.text(2),
          row.text(3),
          row.text(4),
          row.text(5),
          row.text(6),
          row.text(7),
          row.real(8),
          row.real(9),
          static_cast<int>(row.integer(10))};
}

/// These tables have one column for who wrote: without an account the printed name stands in it.
std::string signed_by(const Author& author) {
  return author.account_uuid.empty() ? author.printed : author.account_uuid;
}

struct TraineeRow {
  std::int64_t id = 0;
  std::string uuid;
};

TraineeRow trainee_row(sqlite3* connection, const std::string& code) {
  sql::Statement row(connection,
                     "SELECT t.id, t.uuid FROM person p JOIN trainee t ON t.id = p.trainee_id WHERE p.code = ?");
  if (!row.bind(code).step()) throw InputError("trainee \"" + code + "\": there is none");
  require_person(connection, row.integer(0), code);
  return {row.integer(0), row.text(1)};
}

std::vector<std::string> texts(sqlite3* connection, const char* query, const std::string& parameter) {
  std::vector<std::string> all;
  sql::Statement rows(connection, query);
  rows.bind(parameter);
  while (rows.step()) all.push_back(rows.text(0));
  return all;
}

void note_membership(sqlite3* connection, const char* action, const TraineeRow& trainee, const std::string& group,
                     const Author& author) {
  append_audit(connection, action, trainee.uuid, group, author.account_uuid.empty() ? "trocar" : author.account_uuid);
}

/// @param sql gives a row where something changed.
void change_group(Database& database, const std::vector<std::string>& trainees, const std::string& group,
                  const char* sql, const char* action, const Author& author) {
  sqlite3* connection = database.connection();
  AnchoredTransaction transaction(database);
  require_key(database);
  bool changed = false;
  for (const std::string& trainee : trainees) {
    const TraineeRow row = trainee_row(connection, trainee);
    sql::Statement change(connection, sql);
    const bool done = change.bind(row.id).bind(group).step();
    change.run();
    if (done) note_membership(connection, action, row, group, author);
    changed = changed || done;
  }
  if (changed) transaction.commit();
}

}  // namespace

Curriculum CurriculumStore::add(const std::string& name, const std::string& toml, const Author& author,
                                const Check& check) {
  check_printed("name of the curriculum", name, kLongestName);
  check_prose("curriculum " + name, toml, kLongestText);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  if (const std::string lost = lost_key(connection); !lost.empty())
    throw InputError("curriculum " + name + ": not kept, for a text that is not signed rules nothing: " + lost);
  const std::optional<Curriculum> last = newest(name);
  if (check) check(last);
  if (last && last->toml == toml) return *last;
  const Curriculum next{next_row_uuid(connection, "curriculum"),
                        name,
                        digest::of_bytes(toml),
                        toml,
                        signed_by(author),
                        utc_now(),
                        last ? last->version + 1 : 1};
  sql::Statement insert(
      connection,
      "INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc) VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.bind(next.uuid)
      .bind(name)
      .bind(next.version)
      .bind(next.sha256)
      .bind(toml)
      .bind(next.author)
      .bind(next.utc)
      .run();
  seal_row(connection, "curriculum", next.uuid, author.account_uuid);
  transaction.commit();
  return next;
}

std::optional<Curriculum> CurriculumStore::newest(const std::string& name,
                                                  const std::function<bool(const Curriculum&)>& fits) const {
  // Two stations may have written the same version, neither knowing of the other: then one holds, the same everywhere.
  sql::Statement row(database_->connection(),
                     std::string(kCurricula) + " WHERE name = ? ORDER BY version DESC, uuid DESC");
  row.bind(name);
  while (row.step()) {  // a row that came in by another way rules nothing, and hides none that does
    if (!row_holds(database_->connection(), "curriculum", row.integer(7))) continue;
    if (Curriculum one = curriculum_of(row); !fits || fits(one)) return one;
  }
  return std::nullopt;
}

std::vector<Curriculum> CurriculumStore::list(bool held) const {
  std::vector<Curriculum> all;
  sql::Statement rows(
      database_->connection(),
      std::string(kCurricula) + (held ? " WHERE row_holds('curriculum', id)" : "") + " ORDER BY uuid DESC");
  while (rows.step()) all.push_back(curriculum_of(rows));
  return all;
}

Benchmark CurriculumStore::add_benchmark(const Benchmark& numbers, const Author& author) {
  check_printed("exercise", numbers.exercise_id);
  check_printed("level", numbers.level);
  check_printed("metric", numbers.metric);
  check_printed("source", numbers.source, 1000);
  check_printed("rule", numbers.rule, 1000);
  if (!std::isfinite(numbers.full_at) || !std::isfinite(numbers.zero_at) || numbers.full_at == numbers.zero_at) {
    throw InputError("benchmark of " + numbers.metric + ": full marks and none need two different numbers");
  }
  for (const double value : {numbers.full_at, numbers.zero_at})
    if (numbers.metric == "score" && !lawful(lawful_range("score"), value)) {
      throw InputError("benchmark of score: " + std::to_string(value) + " is none; scores go " +
                       range_words(lawful_range("score")));
    }
  if (numbers.n < 0) throw InputError("benchmark of " + numbers.metric + ": n is the number of people, 0 or more");
  sqlite3* connection = database_->connection();
  Benchmark added = numbers;
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  added.uuid = next_row_uuid(connection, "benchmark");
  added.author = signed_by(author);
  added.utc = utc_now();
  sql::Statement exercise(
      connection, "INSERT INTO exercise SELECT ?1, '', '' WHERE NOT EXISTS (SELECT 1 FROM exercise WHERE id = ?1)");
  exercise.bind(added.exercise_id).run();
  keep_exercise_once(connection, added.exercise_id);
  sql::Statement insert(
      connection,
      "INSERT INTO benchmark (uuid, exercise_id, level, metric, full_at, zero_at, n, source, rule, author,"
      " utc) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(added.uuid)
      .bind(added.exercise_id)
      .bind(added.level)
      .bind(added.metric)
      .bind(added.full_at)
      .bind(added.zero_at);
  insert.bind(added.n).bind(added.source).bind(added.rule).bind(added.author).bind(added.utc).run();
  seal_row(connection, "benchmark", added.uuid, author.account_uuid);
  transaction.commit();
  return added;
}

std::vector<Benchmark> CurriculumStore::benchmarks(const std::string& exercise_id, const std::string& level) const {
  std::vector<Benchmark> all;
  sql::Statement rows(database_->connection(),
                      "SELECT uuid, exercise_id, level, metric, source, rule, author, utc, full_at, zero_at, n FROM "
                      "benchmark b WHERE (?1 = '' OR exercise_id = ?1)"
                      " AND (?2 = '' OR level = ?2)" +
                          newest_first("benchmark", "b", "exercise_id"));
  rows.bind(exercise_id).bind(level);
  while (rows.step()) all.push_back(benchmark_of(rows));
  return all;
}

void CurriculumStore::join(const std::vector<std::string>& trainees, const std::string& group, const Author& author) {
  check_printed("group", group, kLongestName);
  change_group(*database_, trainees, group, "INSERT OR IGNORE INTO membership VALUES (?, ?) RETURNING 1",
               "group joined", author);
}

void CurriculumStore::leave(const std::vector<std::string>& trainees, const std::string& group, const Author& author) {
  change_group(*database_, trainees, group,
               "DELETE FROM membership WHERE trainee_id = ? AND group_name = ? RETURNING 1", "group left", author);
}

std::vector<std::string> CurriculumStore::groups() const {
  return texts(database_->connection(), "SELECT DISTINCT group_name FROM membership WHERE ?1 = '' ORDER BY 1", "");
}

std::vector<std::string> CurriculumStore::groups_of(const std::string& trainee) const {
  return texts(database_->connection(),
               "SELECT group_name FROM membership m JOIN person p ON p.trainee_id = m.trainee_id"
               " WHERE p.code = ? ORDER BY 1",
               trainee);
}

std::vector<std::string> CurriculumStore::members(const std::string& group) const {
  return texts(database_->connection(),
               "SELECT p.code FROM membership m JOIN person p ON p.trainee_id = m.trainee_id"
               " WHERE group_name = ? ORDER BY 1",
               group);
}

}  // namespace trocar
