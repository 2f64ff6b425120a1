// Counts to joint angles and joint torques to DAC codes: the electrical and capstan side of the device.
//
// q = q_home + ratio * 2 pi / counts_per_turn * (counts - counts_home) (thesis 3.1); code = round(volts / full scale *
// (2^(bits-1) - 1)), volts = motor torque / (Kt * A/V) - offset, motor torque = joint torque * ratio.
// Channels 0..5 in rad and N m, channel 6 (pinch) in m and N. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/device_model.h"

namespace trocar {

/// Joint travel of one encoder count, rad (m for the pinch).
double count_size(const Transmission& transmission);

/// Joint torque per volt of the DAC, N m/V (N/V for the pinch).
double torque_per_volt(const Transmission& transmission);

/// Largest torque that a channel can deliver at full DAC scale, N m (N for the pinch).
double max_joint_torque(const Transmission& transmission);

/// 64-bit accumulators over wrapping 32-bit counters.
class CountAccumulator {
 public:
  /// Takes the counters as the new zero.
  void reset(const std::array<std::int32_t, kChannels>& counts);
  /// Adds the wrap-safe differences since the last call and returns them.
  std::array<std::int32_t, kChannels> advance(const std::array<std::int32_t, kChannels>& counts);
  const std::array<std::int64_t, kChannels>& total() const { return total_; }

 private:
  std::array<std::int32_t, kChannels> last_{};
  std::array<std::int64_t, kChannels> total_{};
};

/// Positions of all channels. @param counts since homing; @param home positions at homing (rad, m).
ChannelVector joint_positions(const DeviceModel& model, const std::array<std::int64_t, kChannels>& counts,
                              const ChannelVector& home);

/// DAC codes for wanted torques, clamped at full scale.
DacFrame dac_codes(const DeviceModel& model, const ChannelVector& torque, int dac_bits);

/// Torques that a frame of codes really asks for (what quantisation and clamping left).
ChannelVector torques_of(const DeviceModel& model, const DacFrame& frame, int dac_bits);

}  // namespace trocar
