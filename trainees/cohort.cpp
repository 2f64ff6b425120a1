#include "trainees/cohort.h"

#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

constexpr const char* kQuery = R"sql(
WITH finished AS (
  SELECT a.*, status IN ('completed', 'timeout') AS is_graded FROM attempt a WHERE status <> 'running'
)
SELECT t.code, f.exercise_id, f.level, count(*), sum(is_graded), sum(passed),
       max(CASE WHEN is_graded THEN score END),
       (SELECT score FROM finished l WHERE l.trainee_id = f.trainee_id AND l.exercise_id = f.exercise_id
          AND l.level = f.level AND l.is_graded ORDER BY l.id DESC LIMIT 1),
       avg(CASE WHEN is_graded THEN peak.value END), avg(CASE WHEN is_graded THEN time.value END), max(f.started_utc)
FROM finished f
JOIN trainee t ON t.id = f.trainee_id
LEFT JOIN metric peak ON peak.attempt_id = f.id AND peak.name = ?1
LEFT JOIN metric time ON time.attempt_id = f.id AND time.name = ?2
WHERE ?3 = '' OR t.code = ?3
GROUP BY t.id, f.exercise_id, f.level
ORDER BY t.code, f.exercise_id, f.level
)sql";

}  // namespace

std::vector<CohortRow> cohort(Database& database, const std::string& trainee) {
  sql::Statement rows(database.connection(), kQuery);
  rows.bind(kPeakForceMetric).bind(kTimeMetric).bind(trainee);
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
    result.push_back(row);
  }
  return result;
}

}  // namespace trocar
