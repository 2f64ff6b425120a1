#include "trainees/progress/plateau.h"

#include "trainees/progress/learning_curve.h"

namespace trocar {

std::optional<double> theil_sen_slope(const std::vector<double>& scores) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < scores.size(); ++i)
    for (std::size_t j = i + 1; j < scores.size(); ++j)
      slopes.push_back((scores[j] - scores[i]) / static_cast<double>(j - i));
  if (slopes.empty()) return std::nullopt;
  return quartiles(std::move(slopes))->median;
}

std::optional<Plateau> plateau(const std::vector<double>& scores, int window, double least_rise) {
  if (window < 2 || static_cast<int>(scores.size()) < window) return std::nullopt;
  const std::vector<double> newest(scores.end() - window, scores.end());
  Plateau out;
  out.n = window;
  out.rise = *theil_sen_slope(newest) * (window - 1);
  out.flat = out.rise < least_rise;
  return out;
}

}  // namespace trocar
