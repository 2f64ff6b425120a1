#include "trainees/progress/cohort_bands.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr std::size_t kLeastScores = 3;

}  // namespace

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.size() < 2) return std::nullopt;
  Spread out;
  out.n = static_cast<int>(values.size());
  for (const double value : values) out.mean += value / out.n;
  double squares = 0;
  for (const double value : values) squares += (value - out.mean) * (value - out.mean);
  out.sd = std::sqrt(squares / (out.n - 1));
  return out;
}

std::vector<CohortPoint> cohort_curve(const std::vector<std::vector<double>>& scores_of) {
  std::vector<CohortPoint> out;
  for (std::size_t k = 0;; ++k) {
    std::vector<double> at;
    for (const auto& scores : scores_of)
      if (k < scores.size()) at.push_back(scores[k]);
    if (static_cast<int>(at.size()) < kLeastForCohort) return out;
    const int people = static_cast<int>(at.size());
    out.push_back({static_cast<int>(k) + 1, people, *quartiles(std::move(at))});
  }
}

std::optional<double> between_variance(const std::vector<std::vector<double>>& scores_of, int window) {
  std::vector<double> means;
  double of_means = 0;
  for (const auto& scores : scores_of) {
    if (scores.size() < kLeastScores) continue;
    const std::size_t n = std::min(scores.size(), static_cast<std::size_t>(std::max(window, 1)));
    const auto spread = spread_of({scores.end() - static_cast<std::ptrdiff_t>(n), scores.end()});
    if (!spread) continue;
    means.push_back(spread->mean);
    of_means += spread->sd * spread->sd / spread->n;
  }
  if (static_cast<int>(means.size()) < kLeastForCohort) return std::nullopt;
  const double observed = spread_of(means)->sd;
  return std::max(0.0, observed * observed - of_means / static_cast<double>(means.size()));
}

}  // namespace trocar
