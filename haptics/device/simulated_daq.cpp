#include "haptics/device/simulated_daq.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "haptics/device/index_mark.h"
#include "haptics/device/plant/plant_check.h"

namespace trocar {
namespace {

// Each keeps its draws apart from the device's.
constexpr std::uint64_t kTremorStream = 0x9E3779B97F4A7C15ull, kEncoderStream = 0xBF58476D1CE4E5B9ull,
                        kJitterStream = 0x94D049BB133111EBull, kBeamStream = 0xD6E8FEB86659FD93ull,
                        kJigStream = 0xA0761D6478BD642Full, kWiperStream = 0xE7037ED1A0B428DBull;

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("simulated device: " + what);
}

const SimulatedDaqConfig& checked(const SimulatedDaqConfig& c) {
  require(c.rate_hz == 1000 || c.rate_hz == 2000 || c.rate_hz == 4000, "rate_hz is 1000, 2000 or 4000");
  require(c.substep_s > 0 && c.substep_s <= 250e-6, "substep_s lies in (0, 250e-6]");
  require(c.dac_bits >= 8 && c.dac_bits <= 24, "dac_bits lies in 8 to 24");
  require(c.watchdog_s > 0, "watchdog_s is more than nothing");
  require(c.extra_delay_periods >= 0 && c.extra_delay_periods <= kMaxExtraDelayPeriods,
          "extra_delay_periods is 0 to 63");
  if (c.plant) {
    if (const auto refusal = plant_refusal(*c.plant)) require(false, refusal->text());
    const int jitter = c.plant->options.jitter_periods;
    require(jitter >= 0 && c.extra_delay_periods + jitter <= kMaxExtraDelayPeriods,
            "jitter and extra_delay_periods are 0 to 63 together");
  }
  for (const InjectedFault& f : c.faults) {
    const std::string refusal = injection_refusal(f);
    require(refusal.empty(), refusal);
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
      encoders_(plant_.parameters(), plant_.motor_outputs(), config.seed ^ kEncoderStream, config.edge_times),
      beam_(plant_.parameters().options.beam, config.seed ^ kBeamStream),
      potentiometer_(plant_.parameters().options.pinch, config.seed ^ kWiperStream),
      hand_(config.hand, config.seed ^ kTremorStream),
      faults_(config.faults),
      jitter_(config.seed ^ kJitterStream),
      jig_play_(config.seed ^ kJigStream) {
  const PlantParameters& p = plant_.parameters();
  home_ = plant_.angles() + p.jig_error;
  plant_.place(home_, p.jig_jaw_opening);
  plant_.clamp(true);
  const ChannelVector outputs = plant_.motor_outputs();
  encoders_ = PlantEncoders(p, outputs, config.seed ^ kEncoderStream, config.edge_times);
  for (int i = 0; i < kChannels; ++i) last_.counts[i] = encoders_.count(i, outputs[i]);
  if (potentiometer_.there()) last_.counts[kPinchChannel] = potentiometer_.read(plant_.motion().jaw);
}

void SimulatedDaq::lead_arm(const JointVector& from_jig, double seconds) noexcept {
  from_ = plant_.angles();
  to_ = home_ + from_jig;
  const double play = plant_.parameters().options.jig_play;
  if (play > 0 && from_jig.head<kArmJoints - 1>().isZero())
    for (int i = 0; i < kArmJoints - 1; ++i) to_[i] += jig_play_.symmetric(play);
  jaw_from_ = plant_.motion().jaw;
  carried_s_ = 0;
  carry_s_ = std::max(seconds, period_s_);
  plant_.clamp(true);
}

void SimulatedDaq::carry() noexcept {
  carried_s_ += period_s_;
  const double way = std::min(1.0, carried_s_ / carry_s_);
  plant_.place(from_ + way * (to_ - from_), jaw_from_ + way * (plant_.parameters().jig_jaw_opening - jaw_from_));
  if (way == 1.0) carried_s_ = -1;
}

DaqCapabilities SimulatedDaq::capabilities() const noexcept { return {"simulated", config_.rate_hz, config_.dac_bits}; }

DaqSample SimulatedDaq::read() noexcept {
  DaqSample sample;
  const std::uint32_t periods = 1 + faults_.missed_syncs(next_s());
  for (std::uint32_t n = 0; n < periods; ++n) pass_period();
  if (faults_.lasts(InjectedFaultKind::kSensorSilence, time_s())) {
    last_.elapsed_periods = 0;  // the board gives what it had
    return last_;
  }
  sample.elapsed_periods = periods + std::exchange(missed_, 0);
  const ChannelVector outputs = plant_.motor_outputs();
  for (int i = 0; i < kChannels; ++i) {
    sample.counts[i] = encoders_.count(i, outputs[i]);
    sample.edge_age_us[i] = encoders_.edge_age_us(i);
  }
  if (potentiometer_.there()) {
    sample.counts[kPinchChannel] = potentiometer_.read(plant_.motion().jaw);
    sample.edge_age_us[kPinchChannel] = 0;  // nobody dates it
  }
  sample.digital_in = digital_inputs();
  for (int i = kArmJoints - 1; i >= 0; --i)
    if (encoders_.at_mark(i, outputs[i])) sample.digital_in = (sample.digital_in & ~kMarkBits) | index_mark(i);
  faults_.spoil(sample, last_, time_s());
  last_ = sample;
  return sample;
}

void SimulatedDaq::pass_period() noexcept {
  disturb_hand();
  switch_amplifiers(next_s());
  advance_period();
  ++sync_;
  beam_.update(plant_.motion().X_BS, plant_.clamped(), faults_.lasts(InjectedFaultKind::kBeamDark, time_s()),
               faults_.lasts(InjectedFaultKind::kBeamLit, time_s()));
  watch_writes();
  latch_codes();
}

void SimulatedDaq::miss_sync() noexcept {
  pass_period();
  ++missed_;
}

std::uint32_t SimulatedDaq::digital_inputs() const noexcept {
  std::uint32_t in = dac_mismatch_;
  const bool opened = faults_.lasts(InjectedFaultKind::kDeadmanOpen, time_s());
  if (hand_.holding() && pressed_ && !opened) in |= kDeadman;
  if (hand_.fault()) in |= kHandFault;
  if (clutch_pressed_) in |= kClutch;
  if (pedal_pressed_) in |= kPedal;
  if (exchange_pressed_) in |= kExchange;
  if (beam_.lit()) in |= kHomeBeam;
  if (faults_.lasts(InjectedFaultKind::kEmergencyStop, time_s())) in |= kEmergencyStop;
  if (watchdog_fired_) in |= kWatchdogFired;
  for (int i = 0; i < kChannels; ++i) {
    if (faults_.lasts(InjectedFaultKind::kDriveFault, time_s(), i)) in |= kDriveFault << i;
    if (faults_.lasts(InjectedFaultKind::kOverTemperature, time_s(), i)) in |= kDriveHot << i;
  }
  return in;
}

/// The wired chain: emergency stop, enabling switch. Without a hand (a test bench) the switch counts as bridged.
void SimulatedDaq::switch_amplifiers(double at_s) noexcept {
  const bool cut = !pressed_ || faults_.lasts(InjectedFaultKind::kDeadmanOpen, at_s) ||
                   faults_.lasts(InjectedFaultKind::kEmergencyStop, at_s);
  if (plant_.amplifiers_enabled() != (armed_ && !cut)) plant_.enable_amplifiers(armed_ && !cut);
}

void SimulatedDaq::advance_period() noexcept {
  apply_volts();
  force_on_hand_.setZero();
  moment_on_hand_.setZero();
  force_on_finger_ = 0;
  for (int n = 0; n < substeps_; ++n) {
    const ExternalLoad load = hand_.update(plant_.motion(), substep_s_);
    ExternalLoad all = load;
    if (ideal_wall_.stiffness > 0) all.stylus_B.force -= ideal_wall_n() * ideal_wall_.inward;
    plant_.step(substep_s_, all);
    if (encoders_.watched()) encoders_.follow(plant_.motor_outputs(), substep_s_);
    force_on_hand_ -= load.stylus_B.force / substeps_;
    moment_on_hand_ -= load.stylus_B.moment / substeps_;
    force_on_finger_ -= load.jaw_force_n / substeps_;
  }
  if (carried_s_ >= 0) return carry();
  if (armed_) armed_for_s_ += period_s_;
  if (plant_.clamped() && armed_for_s_ >= kJigReleaseS - kTimeSlack) plant_.clamp(false);
}

double SimulatedDaq::ideal_wall_n() const noexcept {
  const double depth = (plant_.motion().X_BS.p - ideal_wall_.point).dot(ideal_wall_.inward);
  return std::clamp(ideal_wall_.stiffness * depth, 0.0, ideal_wall_.most_n);
}

void SimulatedDaq::watch_writes() noexcept {
  if (!armed_) return;
  unwritten_s_ += period_s_;
  watchdog_fired_ = watchdog_fired_ || unwritten_s_ > config_.watchdog_s + kTimeSlack;
  if (watchdog_fired_) written_ = {};
}

/// Periods that the codes in force lie back. Without jitter those of configuration and faults; with it no frame
/// overtakes.
int SimulatedDaq::delay_now() noexcept {
  const int known = std::min(kMaxExtraDelayPeriods, config_.extra_delay_periods + faults_.extra_delay(time_s()));
  const int most = plant_.parameters().options.jitter_periods;
  if (most == 0) return known;
  const int drawn = static_cast<int>((most + 1) * jitter_.unit());
  const auto now = static_cast<std::int64_t>(sync_);
  arrived_ = std::max(arrived_, now - std::min(kMaxExtraDelayPeriods, known + drawn));
  return static_cast<int>(now - arrived_);
}

void SimulatedDaq::latch_codes() noexcept {
  constexpr std::size_t kRing = kMaxExtraDelayPeriods + 1;
  const int delay = delay_now();
  delayed_[delay_head_] = written_;
  if (watchdog_fired_) delayed_ = {};
  const DacFrame& due = delayed_[(delay_head_ + kRing - static_cast<std::size_t>(delay)) % kRing];
  delay_head_ = (delay_head_ + 1) % kRing;
  dac_mismatch_ = 0;
  for (int i = 0; i < kChannels; ++i) {
    if (!faults_.lasts(InjectedFaultKind::kDacStuck, time_s(), i)) in_force_.codes[i] = due.codes[i];
    if (config_.dac_readback && in_force_.codes[i] != due.codes[i]) dac_mismatch_ |= kDacMismatch << i;
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

void SimulatedDaq::write(const DacFrame& frame) noexcept {
  if (faults_.lasts(InjectedFaultKind::kWatchdog, time_s())) return;  // the write does not reach the board
  written_ = frame;
  unwritten_s_ = 0;
}

void SimulatedDaq::arm(bool enabled) noexcept {
  armed_ = enabled;
  switch_amplifiers(time_s());
  if (enabled) return;
  armed_for_s_ = unwritten_s_ = 0;
  watchdog_fired_ = false;
  written_ = {};
  delayed_ = {};
  for (int i = 0; i < kChannels; ++i) {  // a stuck DAC keeps its code behind the inhibited amplifier
    if (!faults_.lasts(InjectedFaultKind::kDacStuck, time_s(), i)) in_force_.codes[i] = 0;
  }
}

void SimulatedDaq::set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept {
  hand_.set_intent(X_BS, jaw_opening_m, period_s_);
}

HandSense SimulatedDaq::sense() const noexcept {
  const StylusMotion m = plant_.motion();
  return {m.X_BS,           force_on_hand_, force_on_finger_, m.jaw, plant_.amplifiers_enabled(),
          plant_.clamped(), moment_on_hand_};
}

void SimulatedDaq::disturb_hand() noexcept {
  if (faults_.lasts(InjectedFaultKind::kHandLetsGo, next_s())) hand_.let_go();
  if (faults_.lasts(InjectedFaultKind::kHandNaN, next_s())) {
    hand_.set_intent({Mat3::Identity(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}, 0, period_s_);
  }
}

}  // namespace trocar
