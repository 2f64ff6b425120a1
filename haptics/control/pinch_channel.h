// The pinch: seventh axis, a slide between thumb and finger, and what the jaws feel of the block between them.
//
// Opening o = slide position; a block of thickness h and stiffness k pushes the jaws apart with F = k (h - o) while
// o < h. The force is rendered through its own passivity budget (haptic_loop). Its limit, as the arm's:
//   K_max = max(least, min(2 b / T, b / (T/2 + Td), 2 fc / Delta))
// with the pinch's own b and fc and the slide's way in one count, Delta (stiffness_limit.h names the sources); least is
// the local stiffness that the budget gives at any delay. Stiffer blocks are weakened to it only where the arm's
// contacts are (clamp_stiffness). Thread: haptic task; no allocation.
#pragma once

#include <algorithm>

#include "haptics/contact/stiffness_limit.h"
#include "haptics/control/passivity.h"
#include "haptics/exchange/contact_patch.h"

namespace trocar {

struct GripResult {
  double force_n = 0;  ///< squeezing force, >= 0; renders as opening force on the slide
  double stored_j = 0;
};

/// @param opening_m gap between the jaw pads.
inline GripResult grip_block(const GripBlock& block, double opening_m) {
  const double squeeze = std::max(0.0, block.thickness_m - opening_m);
  return {block.stiffness_n_per_m * squeeze, 0.5 * block.stiffness_n_per_m * squeeze * squeeze};
}

/// @param pinch what the law assumes of the slide, with the loop's period and delay; @param coulomb_n friction of the
/// slide; @param count_m one count of it; @param asked stiffness of the block, N/m.
inline StiffnessLimit pinch_stiffness_limit(const PassivityParameters& pinch, double coulomb_n, double count_m,
                                            double asked) {
  StiffnessLimit limit;
  if (pinch.law == PassivityLaw::kOff) return limit;  // the baseline: nothing is held back
  const double b = pinch.viscous_n_s_per_m;
  const double passive =
      std::min({2 * b / pinch.period_s, b / (pinch.period_s / 2 + pinch.delay_s), 2 * coulomb_n / count_m});
  limit.k_max = std::max(passive, pinch.least_stiffness_n_per_m);
  if (asked > limit.k_max) limit.share = limit.k_max / asked;
  return limit;
}

inline constexpr double kSlideAlone = 0.4;  ///< N s/m of the pinch's slide without fingers [assumed]

}  // namespace trocar
