// What a cohort says of one of its members: quartiles by attempt number, spread between trainees. For motivation and
// for reliability; a percentile opens nothing. Pure. Thread: any.
#pragma once

#include <optional>
#include <vector>

#include "trainees/progress/learning_curve.h"

namespace trocar {

struct Spread {
  double mean = 0, sd = 0;  ///< SD with n - 1
  int n = 0;
};
/// Empty with fewer than two values.
std::optional<Spread> spread_of(const std::vector<double>& values);

inline constexpr int kLeastForCohort = 3;  ///< trainees below which no band is drawn: it would show single people

struct CohortPoint {
  int attempt = 0;  ///< from 1
  int people = 0;
  Quartiles scores = {};
};
/// At each attempt number, over those who got so far; ends where fewer than kLeastForCohort did. @param scores_of each
/// trainee, oldest first.
std::vector<CohortPoint> cohort_curve(const std::vector<std::vector<double>>& scores_of);

/// Variance of true scores between trainees (one-way analysis of variance, method of moments): variance of the means of
/// the newest `window` scores, less the mean of their variances of the mean. 0 where chance alone explains the means;
/// empty with fewer than kLeastForCohort trainees who have three scores.
std::optional<double> between_variance(const std::vector<std::vector<double>>& scores_of, int window);

}  // namespace trocar
