// What the motors may be given: more than the thesis drives, for as long as winding and amplifier bear it.
//
// The most is DeviceModel's max_motor_torque. While a winding is below warm_c the most may be used; from there it falls
// to lasting_nm, which is reached at the heat model's warning: what goes beyond has ended before heat fades the
// contact. The amplifier gives more than continuous_a for peak_s only (AMC 12A8: 12 A for 2 s, 6 A for ever) and
// needs recover_s below that to give it again; the last kFadeS of it are faded. An arm whose most is no more than
// lasting_nm, as the thesis drives it, is never limited here. Channels 0..5 N m, 6 N. Thread: haptic task; no
// allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/control/motor_heat.h"
#include "haptics/device/device_model.h"
#include "haptics/device/transmission.h"

namespace trocar {

struct PeakTorqueParameters {
  double lasting_nm = 0.100;  ///< at the motor, that the thesis drives [C]
  double warm_c = 85;         ///< winding [chosen]
  double continuous_a = 6;    ///< of the amplifier [T 3.2]
  double peak_s = 2;          ///< [T 3.2]
  double recover_s = 10;      ///< below continuous_a until the whole peak is there again [assumed]
};

class PeakTorque {
 public:
  PeakTorque(const PeakTorqueParameters& p, const DeviceModel& model, const MotorHeatParameters& heat)
      : p_(p), warn_c_(heat.warn_c) {
    for (int i = 0; i < kChannels; ++i) {
      const Transmission& t = model.transmission[static_cast<std::size_t>(i)];
      most_[i] = max_joint_torque(t);
      lasting_[i] = std::min(most_[i], p.lasting_nm / t.ratio);
      continuous_[i] = p.continuous_a * t.torque_constant / t.ratio;
    }
    left_s_.fill(p.peak_s);
  }

  const ChannelVector& most() const { return most_; }
  /// @param given torque of this tick; @param winding_c of each channel. @return most of the next tick.
  ChannelVector update(const ChannelVector& given, const std::array<double, kChannels>& winding_c, double dt_s) {
    ChannelVector limit;
    for (int i = 0; i < kChannels; ++i) {
      double& left_s = left_s_[static_cast<std::size_t>(i)];
      const bool beyond = std::abs(given[i]) > continuous_[i];
      left_s = std::clamp(left_s + (beyond ? -1 : p_.peak_s / p_.recover_s) * dt_s, 0.0, p_.peak_s);
      const double amplifier = std::min(most_[i], continuous_[i]) +
                               std::max(0.0, most_[i] - continuous_[i]) * std::min(1.0, left_s / kFadeS);
      const double cool =
          std::clamp((warn_c_ - winding_c[static_cast<std::size_t>(i)]) / (warn_c_ - p_.warm_c), 0.0, 1.0);
      limit[i] = std::max(lasting_[i], lasting_[i] + cool * (amplifier - lasting_[i]));
    }
    return limit;
  }

 private:
  static constexpr double kFadeS = 0.5;
  PeakTorqueParameters p_;
  double warn_c_;
  ChannelVector most_, lasting_, continuous_;
  std::array<double, kChannels> left_s_{};  ///< of the amplifier's peak
};

}  // namespace trocar
