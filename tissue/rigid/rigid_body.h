// A free box or triangular ring: mass, inertia, pose and velocity, moved by gravity and impulses.
//
// Semi-implicit in rotation, leap-frog in translation (half of gravity's change before, half after the position), so a
// free fall is exact at the step ends. Frame T, SI units. Thread: tissue task; no allocation.
#pragma once

#include "tissue/rigid/collide.h"

namespace trocar {

struct RigidBody {
  Vec3 half = Vec3::Zero();  ///< half extents, m; of a ring: half the height of its triangle, twice, and of its own
  double hole_radius_m = 0;  ///< of a ring; 0: a box
  double mass_kg = 1;
  Pose X_TB;
  Vec3 velocity_T = Vec3::Zero();
  Vec3 spin_T = Vec3::Zero();  ///< rad/s
  bool asleep = true;          ///< at rest: neither gravity nor contacts are computed
  bool carried = false;        ///< moved by the jaws, not by impulses
  double quiet_s = 0;          ///< time at rest so far

  BoxShape shape() const { return {X_TB, half}; }
  bool is_ring() const { return hole_radius_m > 0; }
  RingShape ring() const { return {X_TB, half.x() * 2 / 3, half.z(), hole_radius_m}; }
  bool moves() const { return !asleep && !carried; }
  /// Inverse inertia in T, 1/(kg m^2); of a ring as if the box round its height were full.
  Mat3 inverse_inertia() const;
  Vec3 velocity_at(const Vec3& point_T) const { return velocity_T + spin_T.cross(point_T - X_TB.p); }
  void apply(const Vec3& impulse_T, const Vec3& point_T);
  /// Half of gravity's change over dt.
  void half_kick(double dt_s) { velocity_T.z() -= kGravity * dt_s / 2; }
  /// Moves by the present velocities over dt.
  void drift(double dt_s);
  void wake() {
    asleep = false;
    quiet_s = 0;
  }
};

}  // namespace trocar
