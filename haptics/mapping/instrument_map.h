// From stylus to instrument and back, direct or through a port; power-conjugate (docs/frames_and_units.md).
//
// Mapped stylus X_TS = [R_TW' R_WS, s R_TW' p_WS + t]. Direct: X_TI = X_TS X_SI. Fulcrum: fulcrum.h on the mapped
// stylus. Rendered at the stylus: F = kappa s R^T F_S, M = kappa R^T M_S, the wrench conjugate to the mapped stylus, so
// rendered power = kappa x scene power. Thread: const model; no allocation.
#pragma once

#include <optional>

#include "haptics/mapping/fulcrum.h"
#include "haptics/quantities.h"

namespace trocar {

/// What clutching has added to the registration since the attempt began.
struct Registration {
  Vec3 shift_T = Vec3::Zero();   ///< of the mapped stylus origin, m
  Mat3 turn = Mat3::Identity();  ///< of the instrument in its own frame I
};

struct InstrumentMap {
  Pose X_TW;                       ///< registration: device base W' in the theatre T
  double motion_scale = 1;         ///< s, scene metres per device metre
  Pose X_SI;                       ///< direct mapping only: instrument in the stylus frame
  double force_scale = 1;          ///< kappa, 0 < kappa <= 1
  std::optional<Fulcrum> fulcrum;  ///< absent: direct mapping
  Registration registration;

  /// Stylus in T. @param X_WS stylus in W'.
  Pose mapped_stylus(const Pose& X_WS) const;
  /// Instrument pose in T. @param X_WS stylus in W'.
  Pose instrument_pose(const Pose& X_WS) const;
  /// Velocity of the instrument, linear part at the tip, in T. @param V_WS stylus twist in W'.
  Twist instrument_twist(const Pose& X_WS, const Twist& V_WS) const;
  /// Wrench to render at the stylus origin, in W'. @param F_I_T scene wrench on the instrument, moment about the tip.
  Wrench stylus_wrench(const Pose& X_WS, const Wrench& F_I_T) const;
  /// Stylus pose that puts the instrument at X_TI: what a hand that knows the map aims for. Through a port only tip and
  /// roll can be had; the stylus keeps its reference swing.
  Pose stylus_pose(const Pose& X_TI) const;
  /// Registration with which a stylus at X_WS has the instrument at X_TI: what releasing the clutch takes up. Through a
  /// port X_TI's shaft must pass it.
  Registration registration_keeping(const Pose& X_TI, const Pose& X_WS) const;
};

/// The map seen in a mirror, x -> -x in W' and in T: what a left hand has of a right hand's exercise.
InstrumentMap mirrored(const InstrumentMap& map);

}  // namespace trocar
