// Does a score tell skill apart? Group statistics of scripted hands and the orderings that an exercise must show.
//
// Cliff's delta (Cliff 1993): share of pairs in which the first group's value is larger minus the share in which it is
// smaller, -1..1. The bars are named values: the acceptance orderings that the catalogue of exercises was designed to.
// Pure: no device, no file. Thread: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenarios/scoring/rubric.h"

namespace trocar {

/// Outcomes of one hand on one exercise and level, one entry a seed.
struct HandOutcomes {
  std::vector<double> scores;  ///< 0..100, attempts with a number only
  int passes = 0;
  int without_score = 0;  ///< aborted, void or fault
  int too_fast = 0;       ///< of those: the device stopped because the arm went too fast
};

struct GroupSummary {
  int count = 0;
  double mean = 0, sd = 0, lowest = 0, highest = 0;  ///< sd of the sample, 0 for fewer than two
};

/// @param scores may be empty: all zero then.
GroupSummary summarise(const std::vector<double>& scores);

/// Passes of all attempts, those without a number among them; 0 for none.
double pass_share(const HandOutcomes& outcomes);

/// -1..1; 0 when either group is empty.
double cliffs_delta(const std::vector<double>& first, const std::vector<double>& second);

/// What an exercise must show at every level.
struct ValidityBars {
  double expert_mean = 85;
  double expert_over_intermediate = 5, intermediate_over_novice = 15;  ///< differences of means
  double delta_expert_intermediate = 0.6, delta_intermediate_novice = 0.8;
  double novice_pass_share = 0.10;  ///< at most, from the second level on
  double clumsy_mean = 50, clumsy_pass_share = 0.02, speed_runner_mean = 40;
  double expert_full_marks_share = 0.05;  ///< at most: a ceiling hides who is better
  double expert_best_time_share = 0.05;   ///< at most, of the sub-scores that are times
  double critical_score = 49,
         unfinished_score = 49;  ///< at most, with a critical event; times the share of objects done
  double left_out_share = 0.85;  ///< of expert, intermediate and novice, guessed by their sub-scores
  double skill_correlation = 0.7, retest_icc = 0.72;  ///< of a drawn population
};

/// One statement and whether it holds.
struct ValidityCheck {
  std::string name;  ///< "expert mean"
  double value = 0;
  std::string bar;        ///< ">= 85"
  bool met = false;       ///< also when it is not asked
  std::string not_asked;  ///< why it does not apply here; empty: it does
};

/// What kind of exercise and level it is.
struct ValidityScope {
  bool first_level = false;  ///< the novice's pass share is not asked there
  bool judges_force = true;  ///< without sub-scores of force or grip a heavy hand is as good as a light one
};

/// Does a rubric hold a sub-score of force or grip?
bool judges_force(const Rubric& rubric);

/// The checks that the hands present allow, in fixed order. @param outcomes by hand name; a hand without any score
/// fails the checks that need one. A speed-runner that the device stopped for going too fast has earned 0.
std::vector<ValidityCheck> check_validity(const std::map<std::string, HandOutcomes>& outcomes,
                                          const ValidityScope& scope = {}, const ValidityBars& bars = {});

}  // namespace trocar
