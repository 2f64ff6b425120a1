// Dry friction as a spring whose anchor is dragged along beyond the limit, without lag while it slides steadily.
//
// An anchor that is only dragged after the step has a spring that is longer by a step's way: friction would grow with
// speed. So the anchor goes ahead by what it slid in the last step, and after the step by what is then too much or too
// little. Thread: pure functions, any.
#pragma once

#include <cmath>

namespace trocar {

/// @param foreseen_m by which the anchor has gone ahead, in the force's direction
/// @param force_n of the spring after the step. @return by how much the anchor slides in all, from before the step
inline double slide(double foreseen_m, double force_n, double limit_n, double stiffness_n_per_m) {
  if (std::abs(force_n) > limit_n)
    return foreseen_m + std::copysign((std::abs(force_n) - limit_n) / stiffness_n_per_m, force_n);
  if (foreseen_m == 0) return 0;
  const double back = (force_n - std::copysign(limit_n, foreseen_m)) / stiffness_n_per_m;
  return std::abs(back) < std::abs(foreseen_m) ? foreseen_m + back : 0;
}

}  // namespace trocar
