// The pinch: seventh axis, a slide between thumb and finger, and what the jaws feel of the block between them.
//
// Opening o = slide position; a block of thickness h and stiffness k pushes the jaws apart with F = k (h - o) while
// o < h. The force is rendered through its own passivity budget (haptic_loop). Thread: haptic task; no allocation.
#pragma once

#include <algorithm>

#include "haptics/exchange/contact_patch.h"

namespace trocar {

struct GripResult {
  double force_n = 0;     ///< squeezing force, >= 0; renders as opening force on the slide
  double stored_j = 0;
};

/// @param opening_m gap between the jaw pads.
inline GripResult grip_block(const GripBlock& block, double opening_m) {
  const double squeeze = std::max(0.0, block.thickness_m - opening_m);
  return {block.stiffness_n_per_m * squeeze, 0.5 * block.stiffness_n_per_m * squeeze * squeeze};
}

}  // namespace trocar
