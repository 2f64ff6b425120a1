// Amplifier in current mode and brushed motor of one channel.
//
//   i_wanted = gain * V, cut to the amplifier's peak and to what the bus voltage leaves: |R i + Ke w| <= V_bus
//   R grows as the winding warms where the plant's options say so (plant_heat.h), and the headroom falls with it
//   i' = (i_wanted - i) / tau (exact exponential over a step),   load at the output = Kt i / ratio
// Units: V, A, output units of the channel. Thread: value type, one owner.
#pragma once

#include "haptics/device/plant/plant_heat.h"
#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

class PlantMotor {
 public:
  PlantMotor(const ChannelParameters& channel, const PlantParameters& plant);

  /// Current after dt with the command held; output_rate is the channel's speed. @return load at the output.
  double advance(double volts, double output_rate, double dt) noexcept;
  /// Inhibited for dt: no current; the motor cools.
  void rest(double dt) noexcept;
  /// Inhibit: no current, at once.
  void cut() noexcept { current_ = 0; }
  double current() const noexcept { return current_; }
  double output_load() const noexcept { return torque_constant_ * current_ / ratio_; }
  const PlantHeat& heat() const noexcept { return heat_; }

 private:
  double torque_constant_, resistance_, ratio_, gain_, bus_, limit_, tau_;
  PlantHeat heat_;
  double current_ = 0;
  double decay_ = 1, decay_dt_ = 0;  ///< exp(-dt/tau) of the last dt
};

}  // namespace trocar
