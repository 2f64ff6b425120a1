// The haptic loop: one function, tick(), from encoder counts to DAC codes. Read haptic_loop.cpp first.
//
// Every stage is a const model plus a small mutable state; ONE kinematic state serves velocity, force, gravity and
// passivity. Time comes in with the counts (elapsed periods): the tick reads no clock, takes no lock, allocates
// nothing, does no I/O and throws nothing. Frames and units: docs/frames_and_units.md. Thread: haptic task.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "haptics/contact/contact_renderer.h"
#include "haptics/contact/friction.h"
#include "haptics/contact/instrument.h"
#include "haptics/contact/stiffness_limit.h"
#include "haptics/control/channel_velocity.h"
#include "haptics/control/device_watch.h"
#include "haptics/control/passivity.h"
#include "haptics/control/peak_torque.h"
#include "haptics/control/pinch_channel.h"
#include "haptics/control/safety_log.h"
#include "haptics/control/sub_count_travel.h"
#include "haptics/control/supervisor.h"
#include "haptics/control/sure_friction.h"
#include "haptics/control/torque_history.h"
#include "haptics/control/torque_limiter.h"
#include "haptics/device/data_acquisition.h"
#include "haptics/device/device_model.h"
#include "haptics/device/transmission.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/tick_record.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/mapping/instrument_coupling.h"
#include "haptics/mapping/instrument_exchange.h"
#include "haptics/mapping/port_forces.h"

namespace trocar {

struct HapticLoopConfig {
  DaqCapabilities daq;  ///< rate and DAC bits of the back-end
  DeviceModel device;
  InstrumentMap map;
  PortParameters port;      ///< fulcrum mapping only
  ToolShape tool;           ///< in hand at first
  std::vector<Tool> tools;  ///< that the exchange switch goes through, `tool` the first; empty: `tool` alone
  ContactLaw contact_law = ContactLaw::kProxy;
  PassivityParameters passivity;  ///< arm; period_s is set from the rate
  PassivityParameters pinch_passivity = pinch_defaults();
  FrictionFeedForward friction;
  double pinch_coulomb_n = 0.04;  ///< of the slide [assumed]
  double pinch_play_m = 50e-6;    ///< way that the slide's friction gives back when it turns, half [assumed]
  SafetyLimits safety;
  MotorHeatParameters heat;
  MotorStates motors;  ///< how warm they are at first
  PeakTorqueParameters peak;
  VelocityMethod velocity = VelocityMethod::kBlend;
  int known_delay_periods = 0;    ///< whole periods between write and DAC beyond the seam's own one, as measured
  bool carry_weight = true;       ///< gravity compensation; off only to show what it is good for
  bool clamp_stiffness = false;   ///< contacts stiffer than K_max are weakened to it (stiffness_limit.h)
  double torque_rate = 100;       ///< N m/s a joint
  double pinch_force_rate = 500;  ///< N/s

  static PassivityParameters pinch_defaults();
};

class HapticLoop {
 public:
  /// @throws std::invalid_argument naming the field that no loop can be run with (loop_check.h).
  explicit HapticLoop(const HapticLoopConfig& config);

  /// One period. @param in latched sample; @param patch newest tissue patch; @param record filled with everything.
  /// @return codes for the next SYNC; record.amplifiers_armed says whether the amplifiers may be enabled.
  DacFrame tick(const DaqSample& in, const ContactPatch& patch, TickRecord& record) noexcept;

  /// Operator's act: leaves FAULT, back to the self-test.
  void reset_fault() noexcept;
  /// From the next tick on, arm and pinch.
  void set_passivity_law(PassivityLaw law) noexcept;
  /// A law of another's, for studies: takes the place of the arm's own, which goes on observing. It may allocate where
  /// the loop's own may not.
  void compare_with(std::function<double(const ContactWork&)> law) { compared_law_ = std::move(law); }
  void set_stiffness_clamp(bool clamp) noexcept { config_.clamp_stiffness = clamp; }
  const HapticLoopConfig& config() const { return config_; }
  /// Of the last tick, for the tissue.
  const SolvedContacts& contacts() const { return contact_.contacts(); }
  MotorStates motors() const { return watch_.motors(); }  ///< how warm they are by the model
  const SafetyLog& safety_log() const { return safety_log_; }
  const Homing& homing() const { return supervisor_.homing(); }
  const PassivityController& pinch_passivity() const { return pinch_passivity_; }

 private:
  struct Motion {
    ArmState arm;
    ChannelVector q, qd;
    ChannelVector travel;  ///< since the last tick, to a fraction of a count
    Pose X_TI;
    Twist V_TI_T;
    double tip_speed = 0;                         ///< of the stylus, m/s
    std::array<std::int32_t, kChannels> delta{};  ///< counts since the last tick
    double periods = 1;                           ///< since the last tick
  };
  struct Contact {
    ContactResult tissue;
    GripResult grip;
    ChannelVector torque = ChannelVector::Zero();  ///< conjugate to tissue and grip, times share, before passivity
    double share = 1;       ///< of the contact that ramp, singularity, heat, clutch, exchange and K_max let through
    double port_share = 1;  ///< the same of the port's friction: without the stiffness limit
    double room = 1;        ///< share of all contact torque that the motors can give
    double jaw_share = 1;   ///< the same of the grip, without the clutch, with its own K_max
    StiffnessLimit limit;   ///< K_max and what it left of the spring
    double stiffness = 0;   ///< of that spring at the stylus, N/m
    double spring_n = 0;    ///< spring force asked at the stylus, without damping
    Vec3 commanded_W = Vec3::Zero();                  ///< force asked at the stylus
    ChannelVector port = ChannelVector::Zero();       ///< friction of the port, times share
    ChannelVector alignment = ChannelVector::Zero();  ///< spring that leads the stylus along the shaft
    double port_stored_j = 0;                         ///< in both, before share
    JointVector spring_torque = JointVector::Zero();  ///< conjugate to it, times share
  };

  Motion measure(const DaqSample& in) noexcept;
  Contact feel(const Motion& motion, const ContactPatch& patch) noexcept;
  ChannelVector make_passive(const Motion& motion, const Contact& contact) noexcept;
  TorqueShares hold_up(const Motion& motion, Contact& contact) noexcept;
  LimitedTorque share_out(const Motion& motion, const Contact& contact, TorqueShares shares) noexcept;
  void feel_port(const Motion& motion, Contact& contact) noexcept;
  void watch(const Motion& motion, const Contact& contact, const LimitedTorque& torque) noexcept;
  DacFrame to_codes(const LimitedTorque& torque) noexcept;
  void publish(const DaqSample& in, const Motion& motion, const Contact& contact, const LimitedTorque& torque,
               const DacFrame& out, TickRecord& record) const noexcept;
  void publish_instrument(const Contact& contact, const LimitedTorque& torque, StylusState& state) const noexcept;
  void take_home() noexcept;
  double rendered_share(double det_a) const noexcept;

  HapticLoopConfig config_;
  double period_s_;
  ChannelVector jig_, home_, count_;  ///< where the jig holds the channels, where they were homed; their count, rad (m)
  std::uint64_t tick_ = 0, periods_ = 0;
  CountAccumulator counts_;
  bool counting_ = false;
  std::uint64_t checked_stamp_ = ~std::uint64_t{0};  ///< patch whose triangles were checked last
  std::vector<ChannelVelocity> velocity_;            ///< one a channel, sized once
  InstrumentCoupling instrument_;
  InstrumentExchange exchange_;
  PortForces port_;
  ContactRenderer contact_;
  PassivityController arm_passivity_;
  PassivityParameters pinch_;  ///< with period and delay
  PassivityController pinch_passivity_;
  std::function<double(const ContactWork&)> compared_law_;
  SureFriction sure_friction_;
  PeakTorque peak_;
  TorqueLimiter limiter_;
  Supervisor supervisor_;
  DeviceWatch watch_;
  SafetyLog safety_log_;
  TorqueHistory asked_contact_;  ///< of the ticks past: acts after the known delay
  SubCountTravel fine_;
  SmoothedRates friction_rates_;
  double last_port_j_ = 0;                    ///< energy in the port's springs one tick ago
  bool arm_waits_ = true, jaws_wait_ = true;  ///< since ACTIVE, until their force has been small once
  double patch_age_s_ = 0;                    ///< since a new patch came, or since ACTIVE
};

}  // namespace trocar
