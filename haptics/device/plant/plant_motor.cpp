#include "haptics/device/plant/plant_motor.h"

#include <algorithm>
#include <cmath>

namespace trocar {

PlantMotor::PlantMotor(const ChannelParameters& channel, const PlantParameters& plant)
    : torque_constant_(channel.torque_constant),
      resistance_(channel.resistance),
      ratio_(channel.ratio),
      gain_(channel.amplifier_gain),
      bus_(plant.bus_voltage),
      limit_(plant.current_limit),
      tau_(plant.amplifier_time_constant),
      heat_(plant.options.heat, channel.resistance) {}

double PlantMotor::advance(double volts, double output_rate, double dt) noexcept {
  if (dt != decay_dt_) {
    decay_dt_ = dt;
    decay_ = std::exp(-dt / tau_);
  }
  const double resistance = heat_.on() ? heat_.resistance() : resistance_;
  const double back_emf = torque_constant_ * output_rate / ratio_;
  // A motor driven faster than its no-load speed has no headroom on one side: current falls to what is left, not past
  // 0.
  const double highest = std::clamp((bus_ - back_emf) / resistance, 0.0, limit_);
  const double lowest = std::clamp((-bus_ - back_emf) / resistance, -limit_, 0.0);
  const double wanted = std::clamp(gain_ * volts, lowest, highest);
  current_ = wanted + (current_ - wanted) * decay_;
  if (heat_.on()) heat_.advance(current_, dt);
  return output_load();
}

void PlantMotor::rest(double dt) noexcept {
  if (heat_.on()) heat_.advance(0.0, dt);
}

}  // namespace trocar
