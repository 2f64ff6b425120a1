#include "trainees/progress/past_attempts.h"
#include "trainees/records/verdicts.h"

#include <cmath>

#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

// Whose they are first: the other way round every score of everybody is read.
constexpr const char* kMetrics = R"sql(
SELECT s.attempt_id, m.name, m.value FROM attempt a
CROSS JOIN score s ON s.attempt_id = a.id AND s.revision = 0
CROSS JOIN metric m ON m.score_id = s.id
WHERE a.trainee_id IN (SELECT id FROM known_trainee WHERE code = ?1 COLLATE NOCASE)
  AND (?2 = '' OR a.exercise_id = ?2) AND m.value IS NOT NULL
)sql";

}  // namespace

PastAttempt past_attempt(const AttemptResult& result) {
  PastAttempt out;
  AttemptSummary& s = out.summary;
  s.uuid = result.uuid;
  s.trainee = result.trainee;
  s.exercise_id = result.exercise_id;
  s.exercise_version = result.exercise_version;
  s.level = result.level;
  s.hand = result.hand;
  s.started_utc = result.started_utc;
  s.seed = result.seed;
  s.board = result.board;
  s.status = status_name(result.grade.status);
  s.score = result.grade.score;
  s.passed = s.passed_by_score = result.grade.passed;  // a decision is a later row
  s.grade = result.grade.grade;
  s.organ_synthetic = result.organ_synthetic;
  s.rubric_sha256 = result.rubric_sha256;
  s.integrity = result.integrity;
  s.cut_off = result.cut_off;
  s.ended_by_device = ended_by_device(result);
  s.begun = begun(result);
  for (const Metric& metric : result.grade.metrics)
    if (metric.value && std::isfinite(*metric.value)) out.metrics[metric.name] = *metric.value;
  return out;
}

std::vector<PastAttempt> past_attempts(Database& database, const std::string& trainee, const std::string& exercise_id) {
  std::map<std::int64_t, std::map<std::string, double>> metrics;
  sql::Statement rows(database.connection(), kMetrics);
  rows.bind(trainee).bind(exercise_id);
  while (rows.step()) metrics[rows.integer(0)][rows.text(1)] = rows.real(2);
  std::vector<PastAttempt> out;
  for (const AttemptSummary& summary : AttemptStore(database).list({trainee, exercise_id}))
    if (summary.status != "running") out.push_back({summary, metrics[summary.row]});
  return out;
}

}  // namespace trocar
