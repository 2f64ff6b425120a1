#include "haptics/device/transmission.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

double full_scale_code(int dac_bits) { return std::ldexp(1.0, dac_bits - 1) - 1; }

}  // namespace

double torque_per_volt(const Transmission& t) { return t.amps_per_volt * t.torque_constant / t.ratio; }

double count_size(const Transmission& t) { return t.ratio * 2 * std::numbers::pi / t.counts_per_turn; }

double max_joint_torque(const Transmission& t) {
  return std::min(t.max_motor_torque / t.ratio, torque_per_volt(t) * t.full_scale_v);
}

void CountAccumulator::reset(const std::array<std::int32_t, kChannels>& counts) {
  last_ = counts;
  total_.fill(0);
}

std::array<std::int32_t, kChannels> CountAccumulator::advance(const std::array<std::int32_t, kChannels>& counts) {
  std::array<std::int32_t, kChannels> delta;
  for (int i = 0; i < kChannels; ++i) {
    // Unsigned subtraction wraps by definition; the difference of two near counters is small and signed.
    delta[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(counts[i]) - static_cast<std::uint32_t>(last_[i]));
    total_[i] += delta[i];
  }
  last_ = counts;
  return delta;
}

ChannelVector joint_positions(const DeviceModel& model, const std::array<std::int64_t, kChannels>& counts,
                              const ChannelVector& home) {
  ChannelVector q;
  for (int i = 0; i < kChannels; ++i) {
    q[i] = home[i] + count_size(model.transmission[i]) * static_cast<double>(counts[i]);
  }
  return q;
}

DacFrame dac_codes(const DeviceModel& model, const ChannelVector& torque, int dac_bits) {
  DacFrame frame;
  const double full = full_scale_code(dac_bits);
  for (int i = 0; i < kChannels; ++i) {
    const Transmission& t = model.transmission[i];
    const double code = (torque[i] / torque_per_volt(t) - t.offset_v) / t.full_scale_v * full;
    // NaN passes a clamp: it is no torque.
    frame.codes[i] = std::isnan(code) ? 0 : static_cast<std::int32_t>(std::lround(std::clamp(code, -full, full)));
  }
  return frame;
}

ChannelVector torques_of(const DeviceModel& model, const DacFrame& frame, int dac_bits) {
  ChannelVector torque;
  for (int i = 0; i < kChannels; ++i) {
    const Transmission& t = model.transmission[i];
    torque[i] = (frame.codes[i] / full_scale_code(dac_bits) * t.full_scale_v + t.offset_v) * torque_per_volt(t);
  }
  return torque;
}

}  // namespace trocar
