#include "haptics/control/supervisor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trocar {

void Supervisor::raise(FaultCode code, std::uint64_t tick, int channel, double value) {
  if (state_ == LoopState::kFault) return;
  fault_ = {code, static_cast<std::int8_t>(channel), tick, value};
  state_ = LoopState::kFault;
  ramp_ = 0;
}

void Supervisor::reset_fault() {
  fault_ = {};
  state_ = LoopState::kUnhomed;
  beam_s_ = still_s_ = ramp_ = 0;
  missed_in_a_row_ = 0;
  missed_lately_ = 0;
  deadman_must_open_ = true;
}

void Supervisor::check_sample(std::uint64_t tick, const DaqSample& sample,
                              const std::array<std::int32_t, kChannels>& delta) {
  const auto periods = static_cast<std::int32_t>(std::clamp<std::uint32_t>(sample.elapsed_periods, 1, 1000));
  for (int i = 0; i < kChannels; ++i) {
    if (!(sample.valid >> i & 1)) raise(FaultCode::kChannelInvalid, tick, i, 0);
    if (std::abs(static_cast<double>(delta[i])) > max_counts_[i] * static_cast<double>(periods)) {
      raise(FaultCode::kEncoderJump, tick, i, delta[i]);
    }
  }
  if (sample.digital_in & kHandFault) raise(FaultCode::kHandNonFinite, tick, -1, 0);
  check_pace(tick, sample.elapsed_periods);
}

void Supervisor::check_pace(std::uint64_t tick, std::uint32_t elapsed_periods) {
  if (elapsed_periods == 0) return raise(FaultCode::kLateLoop, tick, -1, 0);  // a board that counts no period is broken
  const std::uint32_t missed = elapsed_periods - 1;
  missed_in_a_row_ = missed > 0 ? missed_in_a_row_ + missed : 0;
  missed_lately_ = missed_lately_ * std::exp(-static_cast<double>(elapsed_periods) * period_s_) + missed;
  if (missed_in_a_row_ >= limits_.max_missed_in_a_row) raise(FaultCode::kLateLoop, tick, -1, missed_in_a_row_);
  if (missed_lately_ * period_s_ > limits_.max_missed_share) raise(FaultCode::kLateLoop, tick, -1, missed_lately_);
}

void Supervisor::observe(std::uint64_t tick, const DaqSample& sample,
                         const std::array<std::int32_t, kChannels>& delta) {
  just_homed_ = false;
  check_sample(tick, sample, delta);
  const bool deadman = sample.digital_in & kDeadman;
  deadman_must_open_ = deadman_must_open_ && deadman;
  switch (state_) {
    case LoopState::kUnhomed: {
      const bool still = std::all_of(delta.begin(), delta.end(), [](std::int32_t d) { return d == 0; });
      beam_s_ = sample.digital_in & kHomeBeam ? beam_s_ + period_s_ : 0;
      still_s_ = still ? still_s_ + period_s_ : 0;
      just_homed_ = beam_s_ >= limits_.beam_s && still_s_ >= limits_.still_s;
      if (just_homed_) state_ = LoopState::kHomed;
      break;
    }
    case LoopState::kHomed:
      ramp_ = 0;
      if (deadman && !deadman_must_open_) state_ = LoopState::kActive;
      break;
    case LoopState::kActive:
      ramp_ = std::min(1.0, ramp_ + period_s_ / limits_.ramp_s);
      if (!deadman) state_ = LoopState::kHomed;
      break;
    case LoopState::kFault: break;
  }
}

}  // namespace trocar
