// Sequential tests over passed and failed attempts: when competence has been shown, and when it has been lost again.
//
// Learning (LC-CUSUM, Biau et al. 2008): S_0 = 0, S_t = max(0, S_(t-1) + W), W = ln((1 - p0) / (1 - p1)) for a pass,
// ln(p0 / p1) for a failure; shown when S_t >= h. Keeping (CUSUM of failures): +ln(p1 / p0) for a failure, ln((1 - p1)
// / (1 - p0)) for a pass, floor 0; relapse when S_t >= h_r, and competence is then to be shown again. p0, p1: failure
// rates that are adequate and inadequate.
//
// With 0.10, 0.25, h 2.5: the shortest run is 14 passes; within 50 attempts 94 % of adequate and 23 % of inadequate
// trainees show it, 0.2 % of those who fail half the time. With h_r 2: 92 % of relapses to a rate of 0.4 are seen
// within 15 attempts, one false alarm in some 100. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace trocar {

struct CusumRule {
  double adequate = 0.10, inadequate = 0.25;  ///< failure rates, 0 < adequate < inadequate < 1
  double shown_at = 2.5, relapse_at = 2.0;
};

struct CusumPoint {
  enum class Test : std::uint8_t { kLearning, kKeeping } test = Test::kLearning;
  double value = 0;      ///< after this attempt
  bool decided = false;  ///< shown, or relapse: the next attempt begins the other test at 0
};

/// One point an attempt, oldest first.
/// @throws std::invalid_argument for a rule that means nothing.
std::vector<CusumPoint> cusum(const std::vector<bool>& passed, const CusumRule& rule = {});

/// What the points come to.
struct Competence {
  bool shown = false;              ///< now
  std::optional<int> first_shown;  ///< attempts until it was first shown
  int relapses = 0;
  double value = 0;  ///< of the test that runs now; 0 when it has just begun
};
Competence competence_of(const std::vector<CusumPoint>& points);

/// Passes in a row from nothing that show competence.
int shortest_run(const CusumRule& rule = {});

}  // namespace trocar
