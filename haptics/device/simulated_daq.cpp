#include "haptics/device/simulated_daq.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace trocar {
namespace {

constexpr double kTimeSlack = 1e-9;                             // s, against rounding of k * period
constexpr std::uint64_t kTremorStream = 0x9E3779B97F4A7C15ull;  // keeps the tremor's draws apart from the device's

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("simulated device: " + what);
}

const SimulatedDaqConfig& checked(const SimulatedDaqConfig& c) {
  require(c.rate_hz == 1000 || c.rate_hz == 2000 || c.rate_hz == 4000, "rate_hz is 1000, 2000 or 4000");
  require(c.substep_s > 0 && c.substep_s <= 250e-6, "substep_s lies in (0, 250e-6]");
  require(c.dac_bits >= 8 && c.dac_bits <= 24, "dac_bits lies in 8 to 24");
  require(c.extra_delay_periods >= 0 && c.extra_delay_periods <= kMaxExtraDelayPeriods,
          "extra_delay_periods is 0 to 63");
  for (const InjectedFault& f : c.faults) {
    require(f.channel >= 0 && f.channel < kChannels, "fault channel is 0 to 6");
    require(std::isfinite(f.at_s) && f.at_s >= 0 && f.duration_s >= 0 && std::isfinite(f.value),
            "fault times and value");
    require(f.kind != InjectedFaultKind::kMissedSync || (f.value >= 1 && f.value <= 1000),
            "missed SYNCs are 1 to 1000");
  }
  return c;
}

int substeps_of(const SimulatedDaqConfig& c) {
  return std::max(1, static_cast<int>(std::ceil(1.0 / (c.rate_hz * c.substep_s) - 1e-6)));
}

}  // namespace

SimulatedDaq::SimulatedDaq(const SimulatedDaqConfig& config)
    : config_(checked(config)),
      period_s_(1.0 / config.rate_hz),
      substep_s_(period_s_ / substeps_of(config)),
      substeps_(substeps_of(config)),
      plant_(config.plant ? *config.plant : draw_parameters(config.seed)),
      hand_(config.hand, config.seed ^ kTremorStream) {
  for (const InjectedFault& fault : config.faults) faults_.push_back({fault});
  const PlantParameters& p = plant_.parameters();
  plant_.place(plant_.angles() + p.jig_error, p.jig_jaw_opening);
  plant_.clamp(true);
  const ChannelVector outputs = plant_.outputs();
  for (int i = 0; i < kChannels; ++i) last_counts_[i] = count(i, outputs[i]);
}

DaqCapabilities SimulatedDaq::capabilities() const noexcept { return {"simulated", config_.rate_hz, config_.dac_bits}; }

std::int32_t SimulatedDaq::count(int channel, double output) const noexcept {
  const PlantParameters& p = plant_.parameters();
  const ChannelParameters& c = p.channel[channel];
  const double turns = output / c.ratio / (2.0 * std::numbers::pi);
  const auto whole = static_cast<std::int64_t>(std::floor(turns * p.counts_per_turn + c.encoder_offset_counts));
  return static_cast<std::int32_t>(static_cast<std::uint64_t>(whole) & 0xFFFFFFFFull);  // wraps as the counter does
}

DaqSample SimulatedDaq::read() noexcept {
  DaqSample sample;
  sample.elapsed_periods = 1 + missed_syncs();
  for (std::uint32_t n = 0; n < sample.elapsed_periods; ++n) {
    apply_faults_before();
    advance_period();
    ++sync_;
    latch_codes();
  }
  const ChannelVector outputs = plant_.outputs();
  for (int i = 0; i < kChannels; ++i) sample.counts[i] = count(i, outputs[i]);
  if (hand_.holding()) sample.digital_in |= kDeadman;
  if (hand_.fault()) sample.digital_in |= kHandFault;
  if (plant_.clamped()) sample.digital_in |= kHomeBeam;
  apply_faults_after(sample);
  last_counts_ = sample.counts;
  return sample;
}

void SimulatedDaq::advance_period() noexcept {
  apply_volts();
  force_on_hand_.setZero();
  force_on_finger_ = 0;
  for (int n = 0; n < substeps_; ++n) {
    const ExternalLoad load = hand_.update(plant_.motion(), substep_s_);
    plant_.step(substep_s_, load);
    force_on_hand_ -= load.stylus_B.force / substeps_;
    force_on_finger_ -= load.jaw_force_n / substeps_;
  }
  if (armed_) armed_for_s_ += period_s_;
  if (plant_.clamped() && armed_for_s_ >= kJigReleaseS - kTimeSlack) plant_.clamp(false);
}

void SimulatedDaq::latch_codes() noexcept {
  constexpr std::size_t kRing = kMaxExtraDelayPeriods + 1;
  delayed_[delay_head_] = written_;
  const std::size_t out = (delay_head_ + kRing - static_cast<std::size_t>(config_.extra_delay_periods)) % kRing;
  delay_head_ = (delay_head_ + 1) % kRing;
  for (int i = 0; i < kChannels; ++i) {
    if (!dac_stuck_[i]) in_force_.codes[i] = delayed_[out].codes[i];
  }
}

void SimulatedDaq::apply_volts() noexcept {
  const PlantParameters& p = plant_.parameters();
  const std::int32_t full = (std::int32_t{1} << (config_.dac_bits - 1)) - 1;
  ChannelVector volts;
  for (int i = 0; i < kChannels; ++i) {
    const std::int32_t code = std::clamp(in_force_.codes[i], -full, full);
    const double ideal = p.dac_full_scale * code / full;
    volts[i] = std::clamp(ideal * p.channel[i].dac_gain + p.channel[i].dac_offset, -p.dac_full_scale, p.dac_full_scale);
  }
  plant_.command_volts(volts);
}

void SimulatedDaq::write(const DacFrame& frame) noexcept { written_ = frame; }

void SimulatedDaq::arm(bool enabled) noexcept {
  armed_ = enabled;
  plant_.enable_amplifiers(enabled);
  if (enabled) return;
  armed_for_s_ = 0;
  written_ = {};
  in_force_ = {};
  delayed_ = {};
}

void SimulatedDaq::set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept {
  hand_.set_intent(X_BS, jaw_opening_m, period_s_);
}

HandSense SimulatedDaq::sense() const noexcept {
  const StylusMotion m = plant_.motion();
  return {m.X_BS, force_on_hand_, force_on_finger_, m.jaw, plant_.amplifiers_enabled(), plant_.clamped()};
}

bool SimulatedDaq::lasts(const FaultState& state, double now) const noexcept {
  const InjectedFault& f = state.fault;
  const bool begun = now >= f.at_s - kTimeSlack;
  return begun && (f.duration_s == 0 || now < f.at_s + f.duration_s - kTimeSlack);
}

std::uint32_t SimulatedDaq::missed_syncs() noexcept {
  std::uint32_t missed = 0;
  const double next = time_s() + period_s_;
  for (FaultState& state : faults_) {
    if (state.fault.kind != InjectedFaultKind::kMissedSync || state.fired || !lasts(state, next)) continue;
    state.fired = true;
    missed += static_cast<std::uint32_t>(state.fault.value);
  }
  return missed;
}

void SimulatedDaq::apply_faults_before() noexcept {
  const double next = time_s() + period_s_;
  dac_stuck_.fill(false);
  for (const FaultState& state : faults_) {
    if (!lasts(state, next)) continue;
    if (state.fault.kind == InjectedFaultKind::kDacStuck) dac_stuck_[state.fault.channel] = true;
    if (state.fault.kind == InjectedFaultKind::kHandLetsGo) hand_.let_go();
    if (state.fault.kind == InjectedFaultKind::kHandNaN) {
      hand_.set_intent({Mat3::Identity(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}, 0, period_s_);
    }
  }
}

void SimulatedDaq::apply_faults_after(DaqSample& sample) noexcept {
  const double now = time_s();
  for (FaultState& state : faults_) {
    const InjectedFault& f = state.fault;
    if (!lasts(state, now)) continue;
    if (f.kind == InjectedFaultKind::kEncoderJump && !state.fired) {
      jump_[f.channel] += static_cast<std::int32_t>(f.value);
      state.fired = true;
    }
    if (f.kind == InjectedFaultKind::kChannelInvalid) {
      sample.valid = static_cast<std::uint8_t>(sample.valid & ~(1u << f.channel));
    }
  }
  for (int i = 0; i < kChannels; ++i) {
    sample.counts[i] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.counts[i]) + static_cast<std::uint32_t>(jump_[i]));
  }
  for (const FaultState& state : faults_) {
    const InjectedFault& f = state.fault;
    if (f.kind == InjectedFaultKind::kEncoderStuck && lasts(state, now))
      sample.counts[f.channel] = last_counts_[f.channel];
  }
}

}  // namespace trocar
