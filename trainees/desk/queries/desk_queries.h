// What the pages of the desk ask of the database: the cohort in a line each, one trainee's detail, one attempt's.
//
// Everything is derived from the attempts as they stand; nothing is stored. Curves are never mixed over input or rubric
// (CurveKey). With 10^5 attempts of 500 trainees the cohort takes under 150 ms of CPU, an attempt under 100 ms
// (tests/bench/desk_bench.cpp). Thread: the Database's.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trainees/desk/queries/harm.h"
#include "trainees/progress/cohort_bands.h"
#include "trainees/progress/cusum.h"
#include "trainees/progress/judgement.h"
#include "trainees/progress/learning_curve.h"
#include "trainees/progress/rasch.h"
#include "trainees/progress/retention.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"

namespace trocar {

/// Curriculum whose newest version holds the rules of progress.
inline constexpr const char* kRulesName = "standard";
/// Those of its newest version that can be read, else those that are shipped.
ProgressRules rules_in_force(Database& database);

/// Empty fields do not filter.
struct CohortFilter {
  std::string group = {}, exercise = {}, level = {}, trainee = {};
  std::optional<Flag> flag = {};  ///< lines with that judgement among theirs
  bool deactivated = false;       ///< people who are deactivated too; of one trainee always
};

inline constexpr int kSparkScores = 20, kRowsForLosses = 5;

/// One trainee at one exercise, level, input and rubric.
struct CohortLine {
  std::string trainee, name = {};  ///< code; name "" when none is kept
  std::vector<std::string> groups = {};
  CurveKey key = {};
  std::string exercise_version = {};
  int tries = 0, graded = 0, passes = 0;       ///< tries: without those that the device ended
  int in_a_row = 0;                            ///< newest attempts passed
  std::optional<double> best = {}, last = {};  ///< scores
  std::vector<double> newest_scores = {};      ///< at most kSparkScores, oldest first
  std::optional<double> mean_peak_n = {};      ///< mean over graded attempts of the largest contact force
  int over_force = 0;                          ///< times that contact or grip went above its hard limit
  std::string last_utc = {};                   ///< start of the newest attempt
  std::string last_uuid = {};
  std::optional<double> reliability = {};      ///< of the mean of the newest scores
  std::string certified_utc = {};              ///< of the newest certificate that holds, "" without
  std::vector<Judgement> judgements = {};      ///< gravest first, at least one
  std::vector<std::int64_t> newest_rows = {};  ///< attempts that were tried, newest first, at most kRowsForLosses
  std::optional<Harm> harm = {};               ///< of those judged unsafe; its limit is not read here
};

/// By trainee, exercise, level, input, without whose training data were erased. @param now_utc for what is due.
std::vector<CohortLine> cohort_lines(Database& database, const ProgressRules& rules, const CohortFilter& filter,
                                     const std::string& now_utc);

/// Lines by their gravest flag, gravest first; otherwise in their order.
void sort_by_gravity(std::vector<CohortLine>& lines);

/// How somebody stands at one exercise, level, input and rubric, and the cohort beside it.
struct CurveDetail {
  LearningCurve curve = {};
  std::vector<CusumPoint> cusum = {};
  Competence competence = {};
  std::vector<Judgement> judgements = {};
  std::optional<double> reliability = {};
  std::vector<CohortPoint> cohort = {};       ///< quartiles by attempt number, this trainee's scores among them
  std::vector<RetentionDate> retention = {};  ///< of the newest certificate that holds
  std::vector<Benchmark> benchmarks = {};     ///< of exercise and level, newest first
};

struct WeekMinutes {
  std::string monday;  ///< "2026-02-23"
  double minutes = 0;  ///< of the exercises' clock
  int attempts = 0;
};

struct TraineeDetail {
  std::string code, name = {}, created_utc = {};
  bool training_erased = false;  ///< then there are no curves and no weeks
  std::vector<std::string> groups = {};
  std::vector<CurveDetail> curves = {};           ///< newest first
  std::vector<Certificate> certificates = {};     ///< newest first, revoked ones too
  std::vector<Note> notes = {};                   ///< newest first
  std::vector<WeekMinutes> weeks = {};            ///< oldest first; no week between is left out
  std::vector<PastAttempt> ended_by_device = {};  ///< in no curve, oldest first
  std::optional<double> ability_logit = {},
                        ability_se = {};  ///< Rasch; only when enough attempts exist and the SE is small
  int ability_n = 0;                      ///< own attempts that it rests on
  int rasch_attempts = 0;                 ///< of the whole database, that it rests on
  std::string ability_missing = {};       ///< one sentence, where there is no ability
  std::string rule_version = {};
};

/// @throws InputError: no such trainee.
TraineeDetail trainee_detail(Database& database, const std::string& code, const ProgressRules& rules,
                             const std::string& now_utc);

/// An item of the Rasch model.
struct RaschItem {
  std::string exercise_id, level, hand;
  RaschEstimate estimate = {};
};
struct RaschReport {
  int attempts = 0;
  std::vector<RaschItem> items = {};  ///< easiest first; only with a standard error that the rules allow
  std::map<std::string, RaschEstimate> abilities = {};  ///< by the trainee's row as text
  std::vector<std::string> set_aside = {};
  std::string missing = {};  ///< one sentence, where nothing can be estimated
};
/// Over all attempts of the database, as they count; nothing before the rules' number of attempts.
RaschReport rasch_report(Database& database, const ProgressRules& rules);

inline constexpr int kEarlierAttempts = 50, kExpertAttempts = 10;

/// Values of one metric round an attempt.
struct MetricDetail {
  std::string name, unit;
  std::optional<double> value = {};
  OwnValues own = {};                    ///< best is left empty: which way is better the metric does not say
  std::optional<Quartiles> cohort = {};  ///< over trainees, the newest graded attempt of each; from kLeastForCohort on
  int people = 0;
  std::optional<double> expert = {};  ///< median of the expert attempts
};

struct AttemptDetail {
  AttemptSummary summary = {};
  AttemptResult result = {};
  std::string finished_utc = {}, row_hash = {}, program = {};
  std::vector<MetricDetail> metrics = {};  ///< in the result's order
  std::vector<PastAttempt> earlier = {};   ///< own graded ones of the same curve before this one, newest first
  std::vector<AttemptSummary> experts =
      {};  ///< hand "expert", same exercise, level and rubric, newest first; same board first
};

/// @param name as AttemptStore::find takes it. @throws InputError: unknown, several, still running.
AttemptDetail attempt_detail(Database& database, const std::string& name);

}  // namespace trocar
