// Looks at what the tick computed, before it leaves: heat, speed, energy, singularity, encoders that
// do not count, a tissue that says nothing.
//
// Warns first, reduces the torque next, raises a fault last (docs/device_and_safety.md names the values). A joint or
// the tip that is too fast loses its contact force and is damped; if it is still too fast after overspeed_s, that is a
// fault. An encoder is suspected when its motor pushes hard in free space and it counts nothing; it is at fault when
// the other joints of the arm travel far meanwhile, or very far whatever the motor does. Thread: haptic task; no
// allocation.
#pragma once

#include <array>

#include "haptics/control/motor_heat.h"
#include "haptics/control/supervisor.h"
#include "haptics/device/device_model.h"
#include "haptics/exchange/loop_warning.h"

namespace trocar {

/// One tick as the watch sees it.
struct WatchedTick {
  std::uint64_t tick = 0;
  double periods = 1;                           ///< since the last tick
  std::array<std::int32_t, kChannels> delta{};  ///< counts since the last tick
  ChannelVector qd = ChannelVector::Zero();
  double tip_speed = 0;  ///< of the stylus, m/s
  double det_a = 1;
  ChannelVector torque = ChannelVector::Zero();  ///< total asked of the motors
  bool touching = false;                         ///< tissue or the jaws' block
  bool saturated = false;
  bool debt = false;       ///< an energy budget has faded its stiffness
  double patch_age_s = 0;  ///< since the tissue's patch was new
};

class DeviceWatch {
 public:
  /// @param motors how warm they are at first.
  DeviceWatch(const SafetyLimits& limits, const DeviceModel& model, const MotorHeatParameters& heat, double period_s,
              const MotorStates& motors = {});

  /// Raises what it finds. A torque that is not finite is left out of the heat model, which must outlive the fault.
  void update(const WatchedTick& now, Supervisor& supervisor);

  WarningBits warnings() const { return warnings_; }
  /// Share of the contact torque that may be rendered: heat, overspeed and an old patch.
  double contact_share() const;
  /// Against motion that is too fast; zero otherwise. @param qd rad/s.
  ChannelVector damping(const ChannelVector& qd) const;
  std::array<double, kChannels> winding_c() const;
  double hottest_c() const;
  MotorStates motors() const;

 private:
  void watch_heat(const WatchedTick& now, Supervisor& supervisor);
  void watch_speed(const WatchedTick& now, Supervisor& supervisor);
  void watch_encoders(const WatchedTick& now, Supervisor& supervisor);
  void watch_patch(const WatchedTick& now, Supervisor& supervisor);
  /// Counts that the arm has travelled since the last tick; a count that comes and goes is none.
  std::int64_t arm_travel(const std::array<std::int32_t, kChannels>& delta);
  void set(LoopWarning warning, bool on) {
    warnings_ = static_cast<WarningBits>(on ? warnings_ | bit(warning) : warnings_ & ~bit(warning));
  }

  SafetyLimits limits_;
  DeviceModel model_;
  ChannelVector strong_ = ChannelVector::Zero();  ///< torque from which a channel should move
  double period_s_;
  std::array<MotorHeat, kChannels> heat_;
  std::array<double, kChannels> pushed_s_{};              ///< much torque, no count, nothing touched
  std::array<std::int64_t, kArmJoints> pushed_travel_{};  ///< counts of the arm meanwhile
  std::array<std::int64_t, kArmJoints> quiet_travel_{};   ///< counts of the arm since this joint counted last
  std::array<std::int32_t, kArmJoints> off_place_{};  ///< counts from where travel was last taken, within the dither
  double too_fast_s_ = 0;
  double patch_share_ = 1;  ///< of the contact, that the age of its patch lets through
  WarningBits warnings_ = 0;
};

}  // namespace trocar
