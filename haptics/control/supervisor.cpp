#include "haptics/control/supervisor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trocar {

void Supervisor::enter(LoopState state) {
  state_ = state;
  in_state_s_ = passed_s_ = 0;
  if (state != LoopState::kFault) ramp_ = 0;
  if (state == LoopState::kUnhomed || state == LoopState::kSelfTest) homing_.begin();
}

void Supervisor::raise(FaultCode code, std::uint64_t tick, int channel, double value) {
  if (!is_soft(code)) ramp_ = 0;
  if (state_ == LoopState::kFault) return;
  fault_ = {code, static_cast<std::int8_t>(channel), tick, value};
  enter(LoopState::kFault);
}

void Supervisor::reset_fault() {
  if (state_ != LoopState::kFault) return;
  fault_ = {};
  missed_in_a_row_ = 0;
  missed_lately_ = 0;
  deadman_seen_open_ = false;
  enter(LoopState::kSelfTest);
}

void Supervisor::check_inputs(std::uint64_t tick, std::uint32_t digital_in) {
  if (digital_in & kEmergencyStop) raise(FaultCode::kEmergencyStop, tick, -1, 1);
  if (digital_in & kHandFault) raise(FaultCode::kHandNonFinite, tick, -1, 0);
  for (int i = 0; i < kChannels; ++i) {
    if (channel_input(digital_in, kDriveFault, i)) raise(FaultCode::kDriveFault, tick, i, 1);
    if (channel_input(digital_in, kDacMismatch, i)) raise(FaultCode::kDacMismatch, tick, i, 1);
    if (channel_input(digital_in, kDriveHot, i)) raise(FaultCode::kDriveHot, tick, i, 1);
  }
}

void Supervisor::check_counts(std::uint64_t tick, const DaqSample& sample, const Delta& delta) {
  const auto periods = static_cast<std::int32_t>(std::clamp<std::uint32_t>(sample.elapsed_periods, 1, 1000));
  for (int i = 0; i < kChannels; ++i) {
    if (!(sample.valid >> i & 1)) raise(FaultCode::kChannelInvalid, tick, i, 0);
    if (std::abs(static_cast<double>(delta[i])) > max_counts_[i] * static_cast<double>(periods)) {
      raise(FaultCode::kEncoderJump, tick, i, delta[i]);
    }
  }
}

void Supervisor::check_pace(std::uint64_t tick, std::uint32_t elapsed_periods) {
  if (elapsed_periods == 0) return raise(FaultCode::kSensorSilent, tick, -1, 0);
  const std::uint32_t missed = elapsed_periods - 1;
  missed_in_a_row_ = missed > 0 ? missed_in_a_row_ + missed : 0;
  missed_lately_ = missed_lately_ * std::exp(-static_cast<double>(elapsed_periods) * period_s_) + missed;
  if (missed_in_a_row_ >= limits_.max_missed_in_a_row) raise(FaultCode::kLateLoop, tick, -1, missed_in_a_row_);
  if (missed_lately_ * period_s_ > limits_.max_missed_share) raise(FaultCode::kLateLoop, tick, -1, missed_lately_);
}

void Supervisor::observe(std::uint64_t tick, const DaqSample& sample, const Delta& delta) {
  just_homed_ = false;
  if (state_ == LoopState::kOff) enter(LoopState::kSelfTest);
  check_inputs(tick, sample.digital_in);
  check_counts(tick, sample, delta);
  check_pace(tick, sample.elapsed_periods);
  // After the pace: a loop that slept so long that the watchdog fired is late, whatever the board did about it.
  if (sample.digital_in & kWatchdogFired) raise(FaultCode::kWatchdog, tick, -1, 1);
  advance(tick, sample, delta);
}

void Supervisor::advance(std::uint64_t tick, const DaqSample& sample, const Delta& delta) {
  const bool deadman = sample.digital_in & kDeadman;
  const bool still = homing_.still(delta);
  deadman_seen_open_ = deadman_seen_open_ || !deadman;
  in_state_s_ += period_s_;
  switch (state_) {
    case LoopState::kOff:
      break;
    case LoopState::kSelfTest:
      return self_test(tick, sample, still);
    case LoopState::kUnhomed:
      just_homed_ = homing_.update(sample, delta);
      if (!just_homed_) break;
      deadman_seen_open_ = false;  // a deadman held since before homing does not arm
      return enter(LoopState::kHomed);
    case LoopState::kHomed:
      if (deadman && deadman_seen_open_) enter(LoopState::kArmed);
      break;
    case LoopState::kArmed:
      return arm(deadman);
    case LoopState::kActive:
      ramp_ = std::min(1.0, ramp_ + period_s_ / limits_.ramp_s);
      if (!deadman) enter(LoopState::kHomed);
      break;
    case LoopState::kFault:
      ramp_ = deadman ? std::max(0.0, ramp_ - period_s_ / limits_.fade_s) : 0;
      break;
  }
}

void Supervisor::self_test(std::uint64_t tick, const DaqSample& sample, bool still) {
  std::uint32_t failing = 0;
  if (!still) failing |= kCheckStill;
  if (!deadman_seen_open_) failing |= kCheckDeadman;
  if (sample.elapsed_periods != 1) failing |= kCheckPace;
  passed_s_ = failing ? 0 : passed_s_ + period_s_;
  if (passed_s_ >= limits_.selftest_s) return enter(LoopState::kUnhomed);
  if (in_state_s_ >= limits_.selftest_limit_s) raise(FaultCode::kSelfTest, tick, -1, failing);
}

void Supervisor::arm(bool deadman) {
  if (!deadman) return enter(LoopState::kHomed);
  if (in_state_s_ >= limits_.arm_s) enter(LoopState::kActive);
}

}  // namespace trocar
