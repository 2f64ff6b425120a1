#include "trainees/desk/queries/losses.h"

#include <algorithm>
#include <map>
#include <set>

#include "trainees/desk/queries/desk_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// One part over the attempts.
struct PartSum {
  LostSubscore lost = {};
  double values = 0;
  int graded = 0;
  std::vector<double> raws = {};
};

struct LossDraft {
  Losses losses = {};
  std::map<std::int64_t, PartSum> parts = {};  ///< by row of subscore_kind
  std::map<std::string, int> critical = {};
};

std::map<std::int64_t, Subscore> part_kinds(sqlite3* connection) {
  std::map<std::int64_t, Subscore> out;
  sql::Statement rows(connection,
                      "SELECT id, name, unit, coalesce(weight, 0), full_at, zero_at, gate FROM subscore_kind");
  while (rows.step()) {
    Subscore part;
    part.name = rows.text(1);
    part.unit = rows.text(2);
    part.weight = rows.real(3);
    part.full_at = rows.real(4);
    part.zero_at = rows.real(5);
    part.gate = rows.integer(6) != 0;
    out[rows.integer(0)] = part;
  }
  return out;
}

class LossPass {
 public:
  explicit LossPass(sqlite3* connection)
      : kinds_(part_kinds(connection)),
        score_(connection,
               "SELECT id, passed, value IS NOT NULL FROM score INDEXED BY score_first WHERE attempt_id = ? AND "
               "revision = 0"),
        parts_(connection,
               "SELECT kind_id, value, raw FROM subscore_row WHERE id BETWEEN ?1 << 10 AND ?1 << 10 | 1023"),
        caps_(connection, "SELECT kind, subject, below FROM score_cap WHERE score_id = ?"),
        critical_(connection,
                  "SELECT k.type FROM event_row r JOIN event_kind k ON k.id = r.kind_id WHERE r.id BETWEEN ?1 << 20 AND"
                  " ?1 << 20 | 1048575 AND k.severity = 'critical'") {}

  void add(std::int64_t attempt, LossDraft& draft) {
    ++draft.losses.attempts;
    score_.bind(attempt);
    const bool scored = score_.step() && score_.integer(2) != 0;
    const std::int64_t score = scored ? score_.integer(0) : 0;
    const bool passed = scored && score_.integer(1) != 0;
    score_.run();
    if (!scored) return add_critical(attempt, draft);  // one that was left after such an event still shows it
    ++draft.losses.graded;
    draft.losses.passed += passed ? 1 : 0;
    add_parts(score, draft);
    if (!passed) add_caps(attempt, score, draft);  // no cap lets an attempt pass
  }

  static Losses finished(LossDraft draft) {
    for (auto& [kind, sum] : draft.parts) {
      LostSubscore& lost = sum.lost;
      lost.part.value = sum.values / std::max(1, sum.graded);
      lost.points_lost = 100 * lost.part.weight * (1 - lost.part.value);
      if (const auto middle = quartiles(sum.raws)) lost.part.raw = middle->median;
      draft.losses.parts.push_back(lost);
    }
    std::stable_sort(draft.losses.parts.begin(), draft.losses.parts.end(),
                     [](const LostSubscore& a, const LostSubscore& b) { return a.points_lost > b.points_lost; });
    for (const auto& [type, count] : draft.critical) draft.losses.critical.push_back({type, true, count});
    std::stable_sort(draft.losses.critical.begin(), draft.losses.critical.end(),
                     [](const HarmfulEvents& a, const HarmfulEvents& b) { return a.count > b.count; });
    return draft.losses;
  }

 private:
  void add_caps(std::int64_t attempt, std::int64_t score, LossDraft& draft) {
    bool grave = false;
    caps_.bind(score);
    while (caps_.step()) {
      grave = grave || caps_.view(0) == "critical";
      if (caps_.view(0) == "unfinished") ++draft.losses.unfinished;
      if (caps_.view(0) != "gate") continue;
      for (auto& [kind, sum] : draft.parts) {
        if (sum.lost.part.name != caps_.view(1)) continue;
        ++sum.lost.gate_failed;
        sum.lost.gate_below = caps_.real(2);
        break;
      }
    }
    caps_.run();
    if (grave) add_critical(attempt, draft);
  }

  void add_parts(std::int64_t score, LossDraft& draft) {
    parts_.bind(score);
    while (parts_.step()) {
      PartSum& sum = draft.parts[parts_.integer(0)];
      if (sum.graded++ == 0) sum.lost.part = kinds_[parts_.integer(0)];
      sum.values += parts_.real(1);
      if (const auto raw = parts_.optional_real(2)) sum.raws.push_back(*raw);
    }
    parts_.run();
  }

  void add_critical(std::int64_t attempt, LossDraft& draft) {
    critical_.bind(attempt);
    while (critical_.step()) ++draft.critical[critical_.text(0)];
    critical_.run();
  }

  std::map<std::int64_t, Subscore> kinds_;
  sql::Statement score_, parts_, caps_, critical_;
};

}  // namespace

std::vector<NewestAttempts> newest_attempts(const std::vector<CohortLine>& lines) {
  std::vector<NewestAttempts> out;
  for (const CohortLine& line : lines) out.push_back({line.key, line.newest_rows});
  return out;
}

std::vector<Losses> losses_of(Database& database, const std::vector<NewestAttempts>& of) {
  LossPass pass(database.connection());
  std::map<CurveKey, LossDraft> drafts;
  for (const NewestAttempts& one : of) {
    if (one.rows.empty()) continue;
    LossDraft& draft = drafts[one.key];
    draft.losses.key = one.key;
    ++draft.losses.people;
    for (const std::int64_t row : one.rows) pass.add(row, draft);
  }
  std::vector<Losses> out;
  for (auto& [key, draft] : drafts) out.push_back(LossPass::finished(std::move(draft)));
  return out;
}

MetricCohort metric_cohort(Database& database, const CurveKey& key, const std::string& metric) {
  sqlite3* connection = database.connection();
  MetricCohort out;
  std::map<std::int64_t, std::vector<double>> of_trainee;
  sql::Statement kinds(connection, "SELECT id, unit FROM metric_kind WHERE name = ?");
  sql::Statement values(
      connection,
      "SELECT a.trainee_id, m.value FROM attempt a INDEXED BY attempt_by_curve"
      " CROSS JOIN score s INDEXED BY score_first ON s.attempt_id = a.id AND s.revision = 0"
      " CROSS JOIN metric_row m ON m.id = s.id << 10 | ?5"
      " WHERE a.exercise_id = ?1 AND a.level = ?2 AND a.hand = ?3 AND substr(a.ruleset_sha256, 1, 16) = ?4"
      " AND a.status IN ('completed', 'timeout') AND m.value IS NOT NULL ORDER BY a.trainee_id, a.id");
  const std::set<std::int64_t> erased = desk::training_erased(connection);
  kinds.bind(metric);
  while (kinds.step()) {
    values.bind(key.exercise_id)
        .bind(key.level)
        .bind(key.hand)
        .bind(desk::rubric_start(key.rubric_sha256))
        .bind(kinds.integer(0));
    while (values.step()) {
      out.unit = kinds.text(1);
      if (!erased.contains(values.integer(0))) of_trainee[values.integer(0)].push_back(values.real(1));
    }
    values.run();
  }
  std::vector<std::vector<double>> all;
  for (auto& [trainee, of] : of_trainee) all.push_back(std::move(of));
  out.points = cohort_curve(all);
  return out;
}

std::vector<std::string> metrics_of_attempt(Database& database, std::int64_t row) {
  sql::Statement names(database.connection(),
                       "SELECT m.name FROM score s JOIN metric m ON m.score_id = s.id WHERE s.attempt_id = ? AND"
                       " s.revision = 0 ORDER BY m.position");
  names.bind(row);
  std::vector<std::string> out;
  while (names.step()) out.push_back(names.text(0));
  return out;
}

}  // namespace trocar
