// Rasch model over passed and failed attempts: logit P(pass) = ability(trainee) - difficulty(item), item = exercise and
// level.
//
// Joint maximum likelihood with difficulties summing to 0. An estimate exists only where everybody can be reached from
// everybody along "passed" and "was failed by" (Fischer 1981): the largest such group is fitted, the rest (among them
// who has only passes or only failures) set aside and named. Standard errors from the curvature. Shown from
// ProgressRules::rasch_least_attempts on. Pure. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct RaschAnswer {
  std::string trainee, item;
  bool passed = false;
};

/// Attempts of a trainee at an item, counted.
struct RaschCell {
  std::string trainee, item;
  int tries = 0, passes = 0;
};

struct RaschEstimate {
  std::string name;
  double logit = 0, standard_error = 0;
  int n = 0;
};

struct RaschFit {
  std::vector<RaschEstimate> trainees, items;  ///< by name
  std::vector<std::string> set_aside;          ///< only passes or only failures, or not connected to the rest
  int rounds = 0;
  double largest_step = 0;  ///< of the last round, logit
};

/// Empty when nothing is left to fit.
std::optional<RaschFit> fit_rasch(const std::vector<RaschAnswer>& answers);
std::optional<RaschFit> fit_rasch(const std::vector<RaschCell>& cells);

}  // namespace trocar
