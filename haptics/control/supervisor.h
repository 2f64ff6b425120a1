// States and latched faults of the device loop:
//   OFF -> SELFTEST -> UNHOMED -> HOMED -> ARMED -> ACTIVE, any -> FAULT.
//
// OFF: until the first sample. SELFTEST: torque off; encoders still, DAC registers as written, no period missed and the
// deadman seen open, all for 0.1 s on end. UNHOMED: torque off; homed after the jig's beam has been seen for 50 ms and
// no encoder has moved for 0.5 s, and what homing.h asks for beyond that. HOMED: waits for the deadman to be closed by
// the operator: it must be seen open there first. ARMED: amplifiers on, codes zero, 20 ms. ACTIVE: torque ramped up in
// 1 s. An open deadman returns to HOMED. FAULT: a hard fault has codes zero and amplifiers inhibited within the same
// tick; a soft one (is_soft) fades weight compensation within 20 ms and drops the contact at once. Only reset_fault()
// (an operator's act) leaves it, to SELFTEST. No state re-enables torque by itself. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "haptics/control/homing.h"
#include "haptics/device/data_acquisition.h"
#include "haptics/exchange/stylus_state.h"

namespace trocar {

struct SafetyLimits {
  double selftest_s = 0.1;       ///< all checks passed on end
  double selftest_limit_s = 10;  ///< then the self-test has failed
  HomingLimits homing;
  double arm_s = 0.02;              ///< amplifiers on, codes zero
  double ramp_s = 1.0;              ///< soft start
  double fade_s = 0.02;             ///< torque fade of a soft fault
  double max_encoder_rate = 21.7;   ///< rad/s of joint, 30 counts a millisecond: faster is a fault of the encoder
  double max_pinch_speed = 2;       ///< m/s of the slide, likewise
  double max_joint_rate = 15;       ///< rad/s: damping, then fault
  double max_tip_speed = 2;         ///< m/s of the stylus, likewise
  double overspeed_s = 0.01;        ///< damped for so long before it is a fault
  double overspeed_damping = 0.01;  ///< N m s/rad
  double warn_det_a = 0.30, fault_det_a = 0.05;
  double stuck_torque_share = 0.3;  ///< of the channel's largest torque
  double stuck_s = 0.2;             ///< so long without a count in free space: suspected
  std::int64_t stuck_pushed_travel =
      2400;                       ///< counts of the arm during that: a fault [hands at work through a port reach 600]
  std::int32_t stuck_dither = 4;  ///< counts to either side that are a held arm's trembling and no travel
  std::int64_t stuck_travel = 12000;       ///< counts of the arm without one of this joint: a fault [4 x, likewise]
  std::uint32_t max_missed_in_a_row = 20;  ///< periods without a tick between them
  double max_missed_share = 0.01;          ///< of the last second
  /// Of the tissue's patch while ACTIVE; the contact fades from half of it on. Infinite: nobody makes patches anew.
  double max_patch_age_s = std::numeric_limits<double>::infinity();
  double patch_return_s = 0.05;  ///< in which the contact comes back with a new patch
};

/// What the self-test waits for; bits of Fault::value.
enum SelfTestCheck : std::uint32_t {
  kCheckStill = 1u << 0,    ///< an encoder moves with torque off
  kCheckDeadman = 1u << 1,  ///< the deadman has never been seen open
  kCheckPace = 1u << 2,     ///< periods are missed
};

class Supervisor {
 public:
  /// @param max_counts most counts that each channel can make in one period.
  Supervisor(const SafetyLimits& limits, const std::array<std::int32_t, kChannels>& max_counts, double period_s,
             const HomingModel& homing = {})
      : limits_(limits), max_counts_(max_counts), period_s_(period_s), homing_(limits.homing, homing, period_s) {}

  /// Checks the raw sample and advances the state. @param delta counts since the last tick.
  void observe(std::uint64_t tick, const DaqSample& sample, const std::array<std::int32_t, kChannels>& delta);
  /// Latches the first fault; later ones do not replace it, but a hard one ends the fade of a soft one.
  void raise(FaultCode code, std::uint64_t tick, int channel, double value);
  /// Operator's reset: back to SELFTEST. Does nothing but in FAULT.
  void reset_fault();

  LoopState state() const { return state_; }
  const Fault& fault() const { return fault_; }
  bool just_homed() const { return just_homed_; }
  const Homing& homing() const { return homing_; }
  /// Torque may flow: ACTIVE, or a soft fault that fades.
  bool powered() const { return state_ == LoopState::kActive || (state_ == LoopState::kFault && ramp_ > 0); }
  /// Amplifiers on.
  bool armed() const { return state_ == LoopState::kArmed || powered(); }
  double ramp() const { return ramp_; }  ///< 0..1

 private:
  using Delta = std::array<std::int32_t, kChannels>;
  void check_inputs(std::uint64_t tick, std::uint32_t digital_in);
  void check_counts(std::uint64_t tick, const DaqSample& sample, const Delta& delta);
  void check_pace(std::uint64_t tick, std::uint32_t elapsed_periods);
  void advance(std::uint64_t tick, const DaqSample& sample, const Delta& delta);
  void self_test(std::uint64_t tick, const DaqSample& sample, bool still);
  void arm(bool deadman);
  void enter(LoopState state);

  SafetyLimits limits_;
  std::array<std::int32_t, kChannels> max_counts_;
  double period_s_;
  LoopState state_ = LoopState::kOff;
  Fault fault_;
  double in_state_s_ = 0, passed_s_ = 0;  ///< since the state was entered; of its condition on end
  double ramp_ = 0;
  std::uint32_t missed_in_a_row_ = 0;
  double missed_lately_ = 0;        ///< periods, fading over a second
  bool deadman_seen_open_ = false;  ///< since the self-test began, then since homing
  bool just_homed_ = false;
  Homing homing_;
};

}  // namespace trocar
