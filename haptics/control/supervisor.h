// States and latched faults of the device loop: UNHOMED -> HOMED -> ACTIVE, any -> FAULT.
//
// UNHOMED: torque off; homed after the jig's beam has been seen for 50 ms and no encoder has moved for 0.5 s.
// HOMED: waits for the deadman (after a reset it must be seen open first). ACTIVE: amplifiers armed, torque ramped up in 1 s; an open deadman returns to HOMED.
// FAULT: codes zero, amplifiers inhibited within the same tick; only reset_fault() (an operator's act) leaves it.
// Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/data_acquisition.h"
#include "haptics/exchange/stylus_state.h"

namespace trocar {

struct SafetyLimits {
  double beam_s = 0.05;                  ///< beam seen without a break before homing
  double still_s = 0.5;                  ///< no count on any channel before homing
  double ramp_s = 1.0;                   ///< soft start
  double max_encoder_rate = 21.7;        ///< rad/s of joint, 30 counts a millisecond: faster is a fault of the encoder
  double max_pinch_speed = 2;            ///< m/s of the slide, likewise
  double max_joint_rate = 15;            ///< rad/s
  double fault_det_a = 0.05;
  std::uint32_t max_missed_in_a_row = 20;   ///< periods without a tick between them
  double max_missed_share = 0.01;        ///< of the last second
};

class Supervisor {
 public:
  /// @param max_counts most counts that each channel can make in one period.
  Supervisor(const SafetyLimits& limits, const std::array<std::int32_t, kChannels>& max_counts, double period_s)
      : limits_(limits), max_counts_(max_counts), period_s_(period_s) {}

  /// Checks the raw sample and advances the state. @param delta counts since the last tick.
  void observe(std::uint64_t tick, const DaqSample& sample, const std::array<std::int32_t, kChannels>& delta);
  /// Latches the first fault; later ones are ignored.
  void raise(FaultCode code, std::uint64_t tick, int channel, double value);
  /// Operator's reset: back to UNHOMED.
  void reset_fault();

  LoopState state() const { return state_; }
  const Fault& fault() const { return fault_; }
  bool just_homed() const { return just_homed_; }
  bool armed() const { return state_ == LoopState::kActive; }
  double ramp() const { return ramp_; }  ///< 0..1

 private:
  void check_sample(std::uint64_t tick, const DaqSample& sample, const std::array<std::int32_t, kChannels>& delta);

  void check_pace(std::uint64_t tick, std::uint32_t elapsed_periods);

  SafetyLimits limits_;
  std::array<std::int32_t, kChannels> max_counts_;
  double period_s_;
  LoopState state_ = LoopState::kUnhomed;
  Fault fault_;
  double beam_s_ = 0, still_s_ = 0, ramp_ = 0;
  std::uint32_t missed_in_a_row_ = 0;
  double missed_lately_ = 0;             ///< periods, fading over a second
  bool deadman_must_open_ = false;       ///< after a reset: a deadman held all along does not arm
  bool just_homed_ = false;
};

}  // namespace trocar
