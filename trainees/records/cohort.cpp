#include "trainees/records/cohort.h"

#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

constexpr const char* kFinished = R"sql(
WITH finished AS (
  SELECT a.id, a.trainee_id, a.exercise_id, a.exercise_version, a.ruleset_sha256, a.level, a.started_utc,
         s.id AS score_id, s.value AS score, a.status IN ('completed', 'timeout')  AS is_graded, )sql";
constexpr const char* kRows = R"sql( WHERE a.status <> 'running'
     AND a.trainee_id NOT IN (SELECT trainee_id FROM erasure WHERE kind = 'training' AND row_holds('erasure', id))
     AND (?3 <> '' OR ?4 OR a.trainee_id NOT IN (SELECT trainee_id FROM
       (SELECT trainee_id, active, max(uuid) FROM standing WHERE row_holds('standing', id) GROUP BY trainee_id) WHERE active = 0))
)
SELECT t.code, f.exercise_id, f.level, count(*), sum(is_graded), sum(passed),
       max(CASE WHEN is_graded THEN score END),
       (SELECT n.value FROM attempt l LEFT JOIN score n ON n.attempt_id = l.id AND n.revision = 0
          WHERE l.trainee_id = f.trainee_id AND l.exercise_id = f.exercise_id AND l.level = f.level
          AND l.ruleset_sha256 = f.ruleset_sha256 AND l.status IN ('completed', 'timeout') ORDER BY l.id DESC LIMIT 1),
       avg(CASE WHEN is_graded THEN (SELECT value FROM metric WHERE score_id = f.score_id AND name = ?1) END),
       avg(CASE WHEN is_graded THEN (SELECT value FROM metric WHERE score_id = f.score_id AND name = ?2) END), max(f.started_utc),
       f.exercise_version, f.ruleset_sha256
FROM finished f
JOIN known_trainee t ON t.id = f.trainee_id
WHERE ?3 = '' OR t.code = ?3 COLLATE NOCASE
GROUP BY t.id, f.exercise_id, f.level, f.ruleset_sha256
ORDER BY t.code, f.exercise_id, f.level, min(f.id)
)sql";

}  // namespace

std::vector<CohortRow> cohort(Database& database, const std::string& trainee, bool deactivated) {
  sql::Statement rows(database.connection(), std::string(kFinished) + sql::kPassed +
                                                 " AS passed FROM attempt a"
                                                 " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0" +
                                                 sql::decision() + kRows);
  rows.bind(kPeakForceMetric).bind(kTimeMetric).bind(trainee).bind(deactivated);
  std::vector<CohortRow> result;
  while (rows.step()) {
    CohortRow row;
    row.trainee = rows.text(0);
    row.exercise_id = rows.text(1);
    row.level = rows.text(2);
    row.attempts = static_cast<int>(rows.integer(3));
    row.graded = static_cast<int>(rows.integer(4));
    row.passes = static_cast<int>(rows.integer(5));
    row.best = rows.optional_real(6);
    row.last = rows.optional_real(7);
    row.mean_peak_force_n = rows.optional_real(8);
    row.mean_time_s = rows.optional_real(9);
    row.last_utc = rows.text(10);
    row.exercise_version = rows.text(11);
    row.rubric_sha256 = rows.text(12);
    result.push_back(row);
  }
  return result;
}

int people_erased(Database& database) {
  return static_cast<int>(sql::query_integer(
      database.connection(), "SELECT count(*) FROM erasure WHERE kind = 'training' AND row_holds('erasure', id)"));
}

}  // namespace trocar
