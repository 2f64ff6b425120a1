// From stylus to instrument and back: direct mapping, power-conjugate (docs/frames_and_units.md).
//
// X_TI = [R_TW' R_WS, R_TW' s p_WS + t] X_SI; rendered at the stylus: F = kappa s R^T F_T, M = kappa R^T M_T about the
// mapped stylus origin, so rendered power = kappa x scene power. Thread: const model; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct InstrumentMap {
  Pose X_TW;               ///< registration: device base W' in the theatre T
  double motion_scale = 1; ///< s, scene metres per device metre
  Pose X_SI;               ///< instrument in the stylus frame
  double force_scale = 1;  ///< kappa, 0 < kappa <= 1

  /// Instrument pose in T. @param X_WS stylus in W'.
  Pose instrument_pose(const Pose& X_WS) const;
  /// Velocity of the instrument, linear part at the tip, in T. @param V_WS stylus twist in W'.
  Twist instrument_twist(const Pose& X_WS, const Twist& V_WS) const;
  /// Wrench to render at the stylus origin, in W'. @param F_I_T scene wrench on the instrument, moment about the tip.
  Wrench stylus_wrench(const Pose& X_WS, const Wrench& F_I_T) const;
  /// Stylus pose that puts the instrument at X_TI: what a hand that knows the map aims for.
  Pose stylus_pose(const Pose& X_TI) const;
};

}  // namespace trocar
