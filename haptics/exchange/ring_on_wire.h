// A ring at the tip of the instrument that has a wire through it: what the contact stage needs to make it felt.
//
// Part of the contact patch; the exercise fills it in while the ring is on the wire. Frame T unless the name says I,
// metres. Fixed size: copying it allocates nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

struct RingOnWire {
  static constexpr std::int32_t kMostPoints = 32;

  std::int32_t count = 0;                 ///< points in use; fewer than two: no wire is in the ring
  std::array<Vec3, kMostPoints> point_T;  ///< centre line of the wire near the ring, in order
  Vec3 centre_I = Vec3::Zero();           ///< of the ring
  Vec3 normal_I = Vec3::UnitX();          ///< unit, of its plane
  double play_m = 0;                      ///< inner radius of the ring less the radius of the wire
  double stiffness_n_per_m = 0;           ///< of the contact
  double damping_s_per_m = 0;             ///< Hunt-Crossley factor on the approach speed
};

}  // namespace trocar
