// The point nearest to a wish that no half-space forbids: where a proxy may go that several contacts hold.
//
//   min |s - w|^2  subject to  n_i . s >= -gap_i,  |n_i| = 1, gap_i >= 0  (s = 0 is always allowed)
// Solved exactly by incremental projection (Seidel 1991, three dimensions): the answer lies on no plane, one plane, the
// line of two or the corner of three. Cubic in the count at worst, no tolerance but rounding, whatever the angles.
// Thread: pure function, any thread; no allocation.
#pragma once

#include <span>

#include "haptics/quantities.h"

namespace trocar {

struct HalfSpace {
  Vec3 normal;     ///< unit, points to the allowed side
  double gap = 0;  ///< distance still free before it, >= 0
};

/// @return s, in the unit of w. Half-spaces beyond the first answer are met to rounding of |w|.
Vec3 nearest_allowed(const Vec3& w, std::span<const HalfSpace> half_spaces);

}  // namespace trocar
