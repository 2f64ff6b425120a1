// Contact between a ring and the wire through it, in closed form.
//
// The ring is a thin circle of centre C and unit normal n, the wire a tube round its centre line. The line crosses the
// ring's plane in P with unit tangent t; e is the direction from C to P. The ring touches once P is further from C than
// the play, inner radius less the wire's radius: depth d = |P - C| - play, V = k d^2 / 2. With the wire straight where
// it crosses, the force on the ring is
//   F = -dV/dC = k d (e - n (t.e) / (n.t)),
// at right angles to the wire (no friction), and the moment about C is that of F acting in P. Hunt-Crossley damping as
// every contact has it. A ring that lies along the wire more than across it is judged as at kFlattest: the force stays
// bounded where a real ring would jam. Frame T, SI units. Thread: pure functions, any thread; no allocation.
#pragma once

#include <optional>
#include <span>

#include "haptics/exchange/ring_on_wire.h"
#include "haptics/quantities.h"

namespace trocar {

/// Where a line crosses the plane of a ring.
struct RingCrossing {
  Vec3 point_T = Vec3::Zero(), tangent_T = Vec3::UnitX();  ///< tangent: unit, along the line
  double along_m = 0;                                      ///< from the line's first point
};

/// The crossing nearest to the ring's centre; none when the line does not reach the plane.
std::optional<RingCrossing> cross_ring(std::span<const Vec3> line_T, const Vec3& centre_T, const Vec3& normal_T);

struct RingTouch {
  Wrench spring_I_T;          ///< on the instrument, moment about the tip, without damping
  double damping_factor = 1;  ///< >= 0
  double depth_m = 0;         ///< <= 0: no contact
  double stored_j = 0;
  Vec3 point_T = Vec3::Zero();    ///< on the wire's centre line
  Vec3 normal_T = Vec3::UnitZ();  ///< direction of the force
};

/// @param V_TI_T velocity of the instrument, linear part at the tip.
RingTouch touch_ring(const RingOnWire& ring, const Pose& X_TI, const Twist& V_TI_T);

}  // namespace trocar
