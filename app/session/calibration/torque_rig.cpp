#include "app/session/calibration/torque_rig.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kFirstS = 0.005, kBurstS = 0.040, kReadS = 0.025, kPauseS = 0.005, kRestS = 2.0;
static_assert(kBurstS < kJigReleaseS, "the jig must stay closed");

int periods(double seconds, double rate_hz) { return static_cast<int>(seconds * rate_hz + 0.5); }

}  // namespace

TorqueRig::TorqueRig(const SimulatedDaqConfig& device, const TorqueCellConfig& cell, std::uint64_t seed)
    : daq_(device), cell_(cell), random_(seed) {
  for (int i = 0; i < kChannels; ++i) {
    scale_[i] = 1 + cell.scale_sd * random_.normal();
    zero_[i] = random_.symmetric(cell.zero_nm);
  }
}

ChannelVector TorqueRig::sample() {
  daq_.read();
  const ChannelVector loads = daq_.plant().motor_loads();
  ChannelVector read;
  for (int i = 0; i < kChannels; ++i) {
    const double torque = loads[i] * daq_.plant().parameters().channel[static_cast<std::size_t>(i)].ratio;
    hidden_[i] = std::clamp(hidden_[i] + torque - last_[i], -cell_.stiction_nm, cell_.stiction_nm);
    last_[i] = torque;
    read[i] = scale_[i] * (torque - hidden_[i]) + zero_[i] + cell_.noise_nm * random_.normal();
  }
  return read;
}

ChannelVector TorqueRig::burst(const DacFrame& first, const DacFrame& held) {
  const double rate = daq_.capabilities().rate_hz;
  const int all = periods(kBurstS, rate), read = periods(kReadS, rate);
  ChannelVector sum = ChannelVector::Zero();
  daq_.arm(true);
  for (int k = 0; k < all; ++k) {
    daq_.write(k < periods(kFirstS, rate) ? first : held);
    const ChannelVector now = sample();
    if (k >= all - read) sum += now;
  }
  daq_.arm(false);
  for (int k = 0; k < periods(kPauseS, rate); ++k) sample();
  return sum / read;
}

TorqueRig::Zero TorqueRig::rest() {
  const int all = periods(kRestS, daq_.capabilities().rate_hz);
  ChannelVector sum = ChannelVector::Zero(), squares = ChannelVector::Zero();
  daq_.arm(false);
  hidden_.setZero();
  for (int k = 0; k < all; ++k) {
    const ChannelVector now = sample();
    sum += now;
    squares += now.cwiseAbs2();
  }
  const ChannelVector mean = sum / all;
  return {mean, ((squares / all - mean.cwiseAbs2()).cwiseMax(0) / all).cwiseSqrt()};
}

}  // namespace trocar
