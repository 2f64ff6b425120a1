// Room between link l1 and the shoulder it hangs in: base ring and the two arcs of each leg (thesis figure 2.12).
//
// All arcs lie on spheres about O (table 2.3, figure 2.11): base ring through the actuators' ends on radius d1, leg i
// from U_i to W_i on d2 and from W_i to V_i on d3. l1 runs from O along (V1 + V2 + V3)/sqrt3. The link is inside the
// base ring only on the working assembly mode; elsewhere it would cross the ring's circumference. Frame W, metres.
// Thread: pure functions, any thread; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

inline constexpr double kBaseRing = 0.055;       ///< d1 (thesis table 2.3)
inline constexpr double kProximalArc = 0.040;    ///< d2
inline constexpr double kDistalArc = 0.028;      ///< d3
inline constexpr double kLinkHalfWidth = 0.006;  ///< of l1 [assumed]
inline constexpr double kLegHalfWidth = 0.004;   ///< of ring and legs [assumed]

struct LinkClearance {
  double ring_m = 0;  ///< from l1's surface to the base ring's; negative when it touches or has left the ring
  double legs_m = 0;  ///< from l1's surface to that of the nearest leg
  bool clear() const { return ring_m > 0 && legs_m > 0; }
};

/// @param theta th1..th3, rad. @param R_WP orientation of the platform in W.
LinkClearance link_clearance(const Vec3& theta, const Mat3& R_WP);

}  // namespace trocar
