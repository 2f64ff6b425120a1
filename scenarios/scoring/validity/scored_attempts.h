// Attempts of a sweep as the statistics want them, and other rubrics over them without another run.
//
// Sensitivity: what the score would tell with another weight. Scorers that are known to be bad must be noticed by the
// checks, or the checks are worth nothing. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/rubric.h"
#include "scenarios/scoring/validity/construct_validity.h"

namespace trocar {

/// One attempt at one exercise and level.
struct ScoredAttempt {
  std::string hand;
  std::optional<double> skill;  ///< latent, 0..1, of a person of a population
  std::int64_t board = 0, seed = 0;
  Grade grade;
  bool too_fast = false;  ///< the device stopped it because the arm went too fast
};

/// By hand, persons of a population left out: they are nobody's group.
std::map<std::string, HandOutcomes> outcomes_by_hand(const std::vector<ScoredAttempt>& attempts);

/// What a rubric makes of an attempt that another one graded. One without a number stays without.
Grade regrade(const Grade& grade, const Rubric& rubric);

/// Makes a grade of an attempt's metrics and of how it ended.
using Scorer = std::function<Grade(const Grade&)>;

/// The orderings; whether experts have head-room in the time that they need; what they would earn with one critical
/// event, and with half of the objects undone. @param scorer made the grades, and makes those of the spoilt attempts.
std::vector<ValidityCheck> check_attempts(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                          const ValidityScope& scope, const Scorer& scorer);

/// A rubric that differs in one weight, the others scaled so that all sum to 1.
struct WeightTrial {
  std::string subscore;
  double weight = 0;              ///< in the rubric
  double alone_delta = 0;         ///< Cliff's delta of expert and novice by this sub-score alone
  double without_delta = 0;       ///< by the score without it
  double less_changes = 0;        ///< share of the pass decisions that half of its weight changes
  double more_changes = 0;        ///< that half as much again changes
  std::vector<std::string> lost;  ///< checks that hold as it is and no longer with half or half as much again
};
/// Of all attempts, persons of a population too. One a sub-score, in the rubric's order.
std::vector<WeightTrial> try_weights(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                     const ValidityScope& scope);

/// A scorer that must be noticed.
struct BadScorer {
  std::string name;
  std::vector<std::string> lost;  ///< checks that hold for the rubric as it is and fail for this one; empty: unnoticed
};
/// Labels of expert and novice swapped, caps dropped, full marks at the expert's mean. Needs expert and novice.
std::vector<BadScorer> try_bad_scorers(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                       const ValidityScope& scope);

}  // namespace trocar
