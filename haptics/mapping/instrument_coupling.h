// The instrument map in use: clutch, and hold when the handle comes too near to the port.
//
// While the clutch is pressed the instrument stays frozen, the scene's force fades out in 50 ms and the stylus moves
// freely; on release the registration takes up the offset (through a port: that of the handle), so that neither pose
// nor force jumps, and the force fades in again. Nearer to the port than Fulcrum::kNearest_m the map has no meaning:
// the instrument is held the same way until the handle is back, and the state says so. Nearness is that of the
// registration in use: a clutch released takes up its offset first. Thread: haptic task; no allocation.
#pragma once

#include "haptics/mapping/instrument_map.h"

namespace trocar {

class InstrumentCoupling {
 public:
  static constexpr double kFade_s = 0.050;
  static constexpr double kHysteresis_m = 0.002;  ///< beyond kNearest_m before a hold ends

  explicit InstrumentCoupling(const InstrumentMap& map);

  /// One tick. @param X_WS, V_WS stylus; @param clutch pressed; @param dt_s since the last tick.
  void update(const Pose& X_WS, const Twist& V_WS, bool clutch, double dt_s);
  /// Forgets every clutching (after homing): the next update starts from the exercise's own registration.
  void reset();

  const Pose& X_TI() const { return X_TI_; }
  const Twist& V_TI_T() const { return V_TI_T_; }
  /// Wrench at the stylus in W', not faded. @param F_I_T on the instrument, moment about the tip.
  Wrench stylus_wrench(const Wrench& F_I_T) const { return map_.stylus_wrench(X_WS_, F_I_T); }
  double share() const { return share_; }  ///< of the scene's force that is passed on, 0..1
  bool clutched() const { return clutched_; }
  bool held() const { return held_; }  ///< handle too near to the port
  bool frozen() const { return clutched_ || held_; }
  const InstrumentMap& map() const { return map_; }
  const Pose& X_WS() const { return X_WS_; }  ///< stylus at which the map was evaluated last

 private:
  bool near_port(const Pose& X_WS) const;
  /// The registration by which a stylus at X_WS has the instrument where it is.
  void take_up_offset(const Pose& X_WS);

  InstrumentMap map_;
  Registration first_;
  Pose X_WS_, X_TI_;
  Twist V_TI_T_;
  double share_ = 1;
  bool clutched_ = false, held_ = false;
};

}  // namespace trocar
