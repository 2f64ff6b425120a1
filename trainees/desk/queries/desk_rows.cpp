#include "trainees/desk/queries/desk_rows.h"

#include "scenarios/scoring/attempt_result.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/certificate_standing.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::desk {
namespace {

/// Different values of the index's next column, from one to the next. (A comparison of several columns at once would
/// read all between.)
std::vector<std::string> steps(sqlite3* connection, const std::string& column, const std::string& fixed,
                               const std::vector<std::string>& at) {
  const std::string all = "SELECT min(" + column + ") FROM attempt INDEXED BY attempt_by_curve WHERE " + fixed;
  std::vector<std::string> out;
  sql::Statement first(connection, all), next(connection, all + " AND " + column + " > ?");
  for (const std::string& value : at) first.bind(value);
  for (sql::Statement* found = &first; found->step() && !found->is_null(0); found = &next) {
    out.push_back(found->text(0));
    if (found == &next) next.run();
    for (const std::string& value : at) next.bind(value);
    next.bind(out.back());
  }
  return out;
}

}  // namespace

std::vector<Combination> combinations(sqlite3* connection) {
  std::vector<Combination> out;
  sql::Statement exercises(connection, "SELECT id FROM exercise ORDER BY id");
  while (exercises.step()) {
    const std::string exercise = exercises.text(0);
    for (const std::string& level : steps(connection, "level", "exercise_id = ?", {exercise}))
      for (const std::string& hand : steps(connection, "hand", "exercise_id = ? AND level = ?", {exercise, level}))
        out.push_back({exercise, level, hand});
  }
  return out;
}

std::map<std::int64_t, Person> people(sqlite3* connection) {
  std::map<std::int64_t, Person> out;
  sql::Statement rows(connection,
                      "SELECT t.id, t.code, coalesce(p.name, ''), t.created_utc FROM known_trainee t"
                      " LEFT JOIN person p ON p.trainee_id = t.id ORDER BY t.id");
  while (rows.step()) out[rows.integer(0)] = {rows.integer(0), rows.text(1), rows.text(2), rows.text(3)};
  sql::Statement groups(connection, "SELECT trainee_id, group_name FROM membership ORDER BY trainee_id, group_name");
  while (groups.step()) out[groups.integer(0)].groups.push_back(groups.text(1));
  return out;
}

std::map<CertifiedSkill, HeldCertificate> certificates_held(Database& database) {
  const sql::ReadSnapshot snapshot(database.connection());
  const std::set<std::string> stand = certificates_beyond_doubt(database);
  // Without the evidence, which is most of them.
  sql::Statement rows(
      database.connection(),
      "SELECT c.trainee_id, c.exercise_id, c.level, c.utc, c.uuid, c.id FROM certificate c JOIN trainee t ON"
      " t.id = c.trainee_id LEFT JOIN revocation r ON r.certificate_id = c.id AND"
      " row_holds('revocation', r.id) WHERE coalesce(r.utc, '') = '' ORDER BY c.uuid DESC");
  sql::Statement evidence(database.connection(), "SELECT evidence FROM certificate WHERE uuid = ?");
  RowEntries entries(database.connection(), "certificate");
  std::map<CertifiedSkill, HeldCertificate> out;
  while (rows.step()) {
    HeldCertificate& held = out[{rows.integer(0), rows.text(1), rows.text(2)}];
    Certificate one;
    one.uuid = rows.text(4);
    const bool stands = stand.contains(one.uuid), is_signed = stands || entries.of(rows.integer(5)) > 0;
    if (!held.utc.empty() || (!is_signed && !held.in_question.empty())) continue;
    held = {is_signed ? rows.text(3) : "", ""};
    if (stands || !evidence.bind(one.uuid).step()) continue;
    one.evidence = evidence.text(0);
    evidence.run();
    held.in_question = standing_of(database, one).in_question;
  }
  return out;
}

std::set<std::int64_t> training_erased(sqlite3* connection) {
  std::set<std::int64_t> out;
  sql::Statement rows(connection,
                      "SELECT trainee_id FROM erasure WHERE kind = 'training' AND row_holds('erasure', id)");
  while (rows.step()) out.insert(rows.integer(0));
  return out;
}

bool of_erased(sqlite3* connection, const std::string& attempt_uuid) {
  sql::Statement row(connection,
                     "SELECT 1 FROM attempt a JOIN erasure e ON e.trainee_id = a.trainee_id WHERE a.uuid = ? AND"
                     " e.kind = 'training' AND row_holds('erasure', e.id)");
  return row.bind(attempt_uuid).step();
}

bool doubtful(double ticks, double overruns, double saturated_share, double late_share) {
  return overruns > late_share * ticks || saturated_share > kNotRendered;
}

std::string rubric_start(const std::string& sha256) { return sha256.substr(0, 16); }

std::map<std::int64_t, std::vector<double>> cohort_scores(sqlite3* connection, const CurveKey& key) {
  std::map<std::int64_t, std::vector<double>> out;
  sql::Statement rows(connection,
                      "SELECT a.trainee_id, s.value FROM attempt a INDEXED BY attempt_by_curve"
                      " CROSS JOIN score s INDEXED BY score_first ON s.attempt_id = a.id AND s.revision = 0"
                      " WHERE a.exercise_id = ? AND a.level = ? AND a.hand = ? AND substr(a.ruleset_sha256, 1, 16) = ?"
                      " AND a.status IN ('completed', 'timeout') AND s.value IS NOT NULL ORDER BY a.trainee_id, a.id");
  rows.bind(key.exercise_id).bind(key.level).bind(key.hand).bind(rubric_start(key.rubric_sha256));
  while (rows.step()) out[rows.integer(0)].push_back(rows.real(1));
  return out;
}

}  // namespace trocar::desk
