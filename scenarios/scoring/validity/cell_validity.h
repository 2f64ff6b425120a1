// All that a sweep shows of one exercise at one level: orderings, reliability, classification, sensitivity.
//
// Pure. Thread: any.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/validity/association.h"
#include "scenarios/scoring/validity/reliability.h"
#include "scenarios/scoring/validity/scored_attempts.h"

namespace trocar {

/// What a drawn population shows. An attempt without a number earned nothing: it counts as 0.
struct PopulationValidity {
  int persons = 0, attempts = 0, without_number = 0;
  double one_attempt = 0;                                 ///< correlation of latent skill and the score of one attempt
  std::pair<double, double> one_attempt_interval{-1, 1};  ///< 95 %, by the number of persons
  double ranks = 0;                                       ///< the same of ranks
  double person_mean = 0;                                 ///< with each person's mean score
  /// Persons that were left out of what follows, because they lack attempts that others have.
  int incomplete = 0;
  int retests = 0;  ///< attempts of each person, each on a board and with a seed of its own where there are such
  std::optional<double> icc;                     ///< of them, ICC(2,1)
  std::array<std::size_t, 3> design{};           ///< persons, boards, attempts; one board: each attempt has its own
  std::optional<VarianceComponents> components;  ///< none: a single attempt each
};

/// Correlation, retest and components of the attempts of persons; nothing when there are fewer than three.
std::optional<PopulationValidity> population_validity(const std::vector<ScoredAttempt>& attempts);

struct CellValidity {
  std::vector<ValidityCheck> checks;
  std::optional<LeftOut> by_subscores, by_score;  ///< expert, intermediate and novice, three attempts of each at least
  std::vector<WeightTrial> weights;
  std::vector<BadScorer> bad_scorers;
  std::optional<PopulationValidity> population;
};

CellValidity cell_validity(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                           const ValidityScope& scope);

}  // namespace trocar
