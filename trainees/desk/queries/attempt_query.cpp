// One attempt: its result, and the same numbers of one's own earlier ones, of the cohort and of experts.
#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using Values = std::map<std::string, std::vector<double>>;

constexpr const char* kExpertHand = "expert";

constexpr const char* kGraded =
    " WHERE a.exercise_id = ?1 AND a.level = ?2 AND a.hand = ?3 AND a.ruleset_sha256 = ?4 AND s.value IS NOT NULL"
    " AND a.status IN ('completed', 'timeout') AND a.id <> ?5";

std::vector<AttemptSummary> read_graded(sqlite3* connection, const std::string& more, const AttemptSummary& of,
                                        const std::string& hand) {
  sql::Statement rows(connection,
                      summary_query("t.code", " JOIN known_trainee t ON t.id = a.trainee_id") + kGraded + more);
  rows.bind(of.exercise_id).bind(of.level).bind(hand).bind(of.rubric_sha256).bind(of.row);
  std::vector<AttemptSummary> out;
  while (rows.step()) out.push_back(summary_of(rows));
  return out;
}

/// One's own graded attempts of the curve before this one, with their metrics.
std::vector<PastAttempt> earlier_than(sqlite3* connection, const AttemptSummary& of) {
  sql::Statement own(
      connection,
      "SELECT a.id FROM attempt a WHERE a.trainee_id = (SELECT trainee_id FROM attempt WHERE id = ?1) AND a.id < ?1"
      " AND a.exercise_id = ?2 AND a.level = ?3 AND a.hand = ?4 AND a.ruleset_sha256 = ?5"
      " AND a.status IN ('completed', 'timeout') ORDER BY a.id DESC LIMIT ?6");
  own.bind(of.row).bind(of.exercise_id).bind(of.level).bind(of.hand).bind(of.rubric_sha256).bind(kEarlierAttempts);
  sql::Statement metrics(connection,
                         "SELECT m.name, m.value FROM score s JOIN metric m ON m.score_id = s.id"
                         " WHERE s.attempt_id = ? AND s.revision = 0 AND m.value IS NOT NULL");
  std::vector<PastAttempt> out;
  sql::Statement summary(connection, summary_query("''", "") + " WHERE a.id = ?");
  while (own.step()) {
    if (summary.bind(own.integer(0)).step()) {
      out.push_back({summary_of(summary), {}});
      out.back().summary.trainee = of.trainee;
      metrics.bind(own.integer(0));
      while (metrics.step()) out.back().metrics[metrics.text(0)] = metrics.real(1);
      metrics.run();
    }
    summary.run();
  }
  return out;
}

/// The newest graded attempt of each trainee on the curve: everybody counts once.
std::vector<std::int64_t> one_of_each(sqlite3* connection, const AttemptSummary& of) {
  sql::Statement rows(
      connection,
      "SELECT max(id) FROM attempt INDEXED BY attempt_by_curve WHERE exercise_id = ? AND level = ? AND hand = ?"
      " AND substr(ruleset_sha256, 1, 16) = ? AND status IN ('completed', 'timeout') GROUP BY trainee_id");
  rows.bind(of.exercise_id).bind(of.level).bind(of.hand).bind(desk::rubric_start(of.rubric_sha256));
  std::vector<std::int64_t> out;
  while (rows.step()) out.push_back(rows.integer(0));
  return out;
}

Values values_of(sqlite3* connection, const std::vector<std::int64_t>& attempts) {
  sql::Statement rows(connection,
                      "SELECT m.name, m.value FROM score s JOIN metric m ON m.score_id = s.id"
                      " WHERE s.attempt_id = ? AND s.revision = 0 AND m.value IS NOT NULL");
  Values out;
  for (const std::int64_t attempt : attempts) {
    rows.bind(attempt);
    while (rows.step()) out[rows.text(0)].push_back(rows.real(1));
    rows.run();
  }
  return out;
}

std::vector<double> of_metric(const Values& values, const std::string& name) {
  const auto at = values.find(name);
  return at == values.end() ? std::vector<double>{} : at->second;
}

MetricDetail metric_detail(const Metric& metric, const std::vector<PastAttempt>& earlier, const Values& cohort,
                           const Values& experts) {
  MetricDetail out;
  out.name = metric.name;
  out.unit = metric.unit;
  out.value = metric.value;
  out.own = own_values(earlier, metric.name, true);
  out.own.best.reset();
  const auto people = of_metric(cohort, metric.name);
  out.people = static_cast<int>(people.size());
  if (out.people >= kLeastForCohort) out.cohort = quartiles(people);
  if (const auto of = quartiles(of_metric(experts, metric.name))) out.expert = of->median;
  return out;
}

void add_record(sqlite3* connection, AttemptDetail& detail) {
  sql::Statement row(connection,
                     "SELECT coalesce(finished_utc, ''), coalesce(row_hash, ''), program FROM attempt WHERE id = ?");
  row.bind(detail.summary.row).step();
  detail.finished_utc = row.text(0);
  detail.row_hash = row.text(1);
  detail.program = row.text(2);
}

}  // namespace

AttemptDetail attempt_detail(Database& database, const std::string& name) {
  sqlite3* connection = database.connection();
  const AttemptStore store(database);
  AttemptDetail out;
  out.summary = store.find(name);
  if (out.summary.status == "running") throw InputError("attempt " + out.summary.uuid + ": still runs");
  out.result = store.load(out.summary.row);
  add_record(connection, out);
  out.earlier = earlier_than(connection, out.summary);
  out.experts = read_graded(connection,
                            " ORDER BY a.board <> " + std::to_string(out.summary.board) + ", a.id DESC LIMIT " +
                                std::to_string(kExpertAttempts),
                            out.summary, kExpertHand);
  std::vector<std::int64_t> experts;
  for (const AttemptSummary& expert : out.experts) experts.push_back(expert.row);
  const Values of_cohort = values_of(connection, one_of_each(connection, out.summary)),
               of_experts = values_of(connection, experts);
  for (const Metric& metric : out.result.grade.metrics)
    out.metrics.push_back(metric_detail(metric, out.earlier, of_cohort, of_experts));
  return out;
}

}  // namespace trocar
