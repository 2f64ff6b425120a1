#include "trainees/progress/cusum.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trocar {
namespace {

void require_meaning(const CusumRule& rule) {
  if (!(0 < rule.adequate && rule.adequate < rule.inadequate && rule.inadequate < 1 && rule.shown_at > 0 &&
        rule.relapse_at > 0))
    throw std::invalid_argument("cusum: wants 0 < adequate < inadequate < 1 and limits above 0");
}

/// Log likelihood ratio of one attempt for "adequate".
double for_adequate(bool passed, const CusumRule& rule) {
  return passed ? std::log((1 - rule.adequate) / (1 - rule.inadequate)) : std::log(rule.adequate / rule.inadequate);
}

}  // namespace

std::vector<CusumPoint> cusum(const std::vector<bool>& passed, const CusumRule& rule) {
  using Test = CusumPoint::Test;
  require_meaning(rule);
  std::vector<CusumPoint> points;
  Test test = Test::kLearning;
  double value = 0;
  for (const bool pass : passed) {
    const bool learning = test == Test::kLearning;
    value = std::max(0.0, value + (learning ? 1 : -1) * for_adequate(pass, rule));
    const bool decided = value >= (learning ? rule.shown_at : rule.relapse_at);
    points.push_back({test, value, decided});
    if (!decided) continue;
    test = learning ? Test::kKeeping : Test::kLearning;
    value = 0;
  }
  return points;
}

Competence competence_of(const std::vector<CusumPoint>& points) {
  Competence out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool learning = points[i].test == CusumPoint::Test::kLearning;
    if (points[i].decided) {
      out.shown = learning;
      if (learning && !out.first_shown) out.first_shown = static_cast<int>(i) + 1;
      if (!learning) ++out.relapses;
    }
    out.value = points[i].decided ? 0 : points[i].value;
  }
  return out;
}

int shortest_run(const CusumRule& rule) {
  require_meaning(rule);
  return static_cast<int>(std::ceil(rule.shown_at / for_adequate(true, rule) - 1e-9));
}

}  // namespace trocar
