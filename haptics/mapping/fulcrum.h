// An instrument through a port in the abdominal wall: the shaft passes the pivot p, so the tip moves against the hand.
//
// h handle (mapped stylus origin), d = |p - h|, u = (p - h)/d, L length, tip t = h + L u (depth L - d), roll phi =
// twist of the stylus about Z6 (swing-twist against its reference), all in T:
//   v_t = A v_h, A = u u^T + (1 - L/d)(I - u u^T);   omega = -(u x v_h)/d + roll' u
//   F_h = A^T F_t + (u x M_t)/d + (M_t . u) c/d,     M_h = (M_t . u) g        (transpose of the velocity map)
//   roll' = omega_S . g + v_h . c/d,  g = (z0 + z)/(1 + z0 . z),  c = (u0 x u)/(1 + u0 . u),  z = Z6, 0 = reference
// At the reference swing g = Z6 and c = 0. Plain roll' = omega_S . Z6 is no derivative of a pose: the instrument would
// have turned by the enclosed solid angle, some 20 degrees, after each circle of the hand (docs/frames_and_units.md).
// Thread: const model; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct Fulcrum {
  static constexpr double kNearest_m = 0.020;  ///< d below this: the map is held and the trainee told

  Vec3 port_T = Vec3(0, 0, 0.120);         ///< pivot, m
  double length_m = 0.3;                   ///< L, handle to tip
  Mat3 R_TS_reference = Mat3::Identity();  ///< mapped stylus whose twist counts as zero
  Mat3 R_TI_reference = Mat3::Identity();  ///< instrument at zero twist; its z axis is u0

  double distance_m(const Vec3& handle_T) const { return (port_T - handle_T).norm(); }
  /// Instrument of a mapped stylus. d must not be 0, u not opposite to u0, Z6 not opposite to its reference.
  Pose instrument_pose(const Pose& X_TS) const;
  /// @param V_TS_T mapped stylus (linear part at the handle). @return velocity of the tip frame.
  Twist instrument_twist(const Pose& X_TS, const Twist& V_TS_T) const;
  /// Wrench at the handle, in T. @param F_I_T on the instrument, moment about the tip.
  Wrench handle_wrench(const Pose& X_TS, const Wrench& F_I_T) const;
  /// Direction of Z6 when the stylus follows the shaft from its reference. @param handle_T mapped stylus origin.
  Vec3 followed_axis(const Vec3& handle_T) const;
  /// Mapped stylus that puts the tip at X_TI.p with the instrument's roll: reference swing, twisted about Z6.
  Pose mapped_stylus(const Pose& X_TI) const;
};

}  // namespace trocar
