// Back-end of the seam with a simulated device and hand behind it.
//
// Timing, exactly. read() k is SYNC k: the plant runs one period under the codes in force since SYNC k-1, the
// encoders are latched, then the codes written last become those in force. So what is written after read() k acts
// from SYNC k+1 to SYNC k+2 and shows first in the counts of read() k+2: one period of delay, plus
// extra_delay_periods where configured, plus with the plant's jitter 0 to jitter_periods drawn anew each SYNC. Order is
// kept: what was written earlier reaches the DACs earlier, or is overtaken within one SYNC by what came with it.
// The device starts clamped in its jig, a little off the exact home pose, amplifiers inhibited. The jig opens when the
// amplifiers have been armed for kJigReleaseS without a break; it does not close again. arm(false) takes the
// current away at once and forgets the codes in force.
// Digital inputs: deadman closed while a hand holds the stylus and presses its switch, home beam received while the jig
// is there and its light comes through the coupler (infrared_beam.h), index marks with plant option `index`, hand fault
// while the hand's intent is not finite (it then exerts nothing), emergency stop and drive outputs by injected faults,
// DAC registers read back each SYNC. The safety chain is wired past the controller: the emergency stop and an open
// switch take the current away whatever arm() said. While armed a watchdog counts the SYNCs since the last write; after
// kWatchdogS it zeroes the DACs until disarmed. Thread: the haptic task's, which hand and force tap share. read, write,
// arm and the hand's calls neither allocate, lock nor throw.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/plant/device_plant.h"
#include "haptics/device/plant/hand_model.h"
#include "haptics/device/plant/infrared_beam.h"
#include "haptics/device/plant/plant_encoder.h"
#include "haptics/device/plant/plant_faults.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/simulated_world.h"

namespace trocar {

inline constexpr double kJigReleaseS = 0.050;
inline constexpr double kReturnS = 1.0;
inline constexpr double kWatchdogS = 0.016;  ///< two counts at an eighth of the SYNC clock
inline constexpr int kMaxExtraDelayPeriods = 63;

struct SimulatedDaqConfig {
  double rate_hz = 1000;     ///< 1000, 2000 or 4000
  double substep_s = 50e-6;  ///< longest sub-step of the plant
  int dac_bits = 16;
  int extra_delay_periods = 0;           ///< further whole periods between write and DAC, for studies
  std::uint64_t seed = 1;                ///< true parameters and tremor
  std::optional<PlantParameters> plant;  ///< exact device instead of one drawn by the seed
  HandParameters hand;
  std::vector<InjectedFault> faults;
  double watchdog_s = kWatchdogS;  ///< without a write until the board zeroes its DACs
  bool dac_readback = true;        ///< the board can read its DAC registers back (kDacMismatch)
  bool edge_times = false;         ///< the board tells when each counter last moved (DaqSample::edge_age_us)
};

/// A wall that pushes on the stylus itself, continuously: without counts, periods, delay or motors. What a wall felt
/// through this device could be at best, for studies. Frame W'.
struct IdealWall {
  Vec3 point = Vec3::Zero(), inward = Vec3::UnitZ();  ///< of its face; unit
  double stiffness = 0;                               ///< N/m
  double most_n = 0;                                  ///< force that the motors could give
};

class SimulatedDaq final : public DataAcquisition, public SimulatedWorld {
 public:
  /// @throws std::invalid_argument when a rate, bit count, delay, channel or time is out of range.
  explicit SimulatedDaq(const SimulatedDaqConfig& config);

  DaqCapabilities capabilities() const noexcept override;
  DaqSample read() noexcept override;
  void write(const DacFrame& frame) noexcept override;
  void arm(bool enabled) noexcept override;

  void set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept override;
  void press_clutch(bool pressed) noexcept override { clutch_pressed_ = pressed; }
  void press_pedal(bool pressed) noexcept override { pedal_pressed_ = pressed; }
  void press_exchange(bool pressed) noexcept override { exchange_pressed_ = pressed; }
  void press_deadman(bool pressed) noexcept override { pressed_ = pressed; }
  HandSense sense() const noexcept override;
  void miss_sync() noexcept override;
  double time_s() const noexcept override { return static_cast<double>(sync_) * period_s_; }

  void set_hand_parameters(const HandParameters& parameters) noexcept { hand_.set_parameters(parameters); }
  void release_hand() noexcept { hand_.let_go(); }
  void set_ideal_wall(const IdealWall& wall) noexcept { ideal_wall_ = wall; }
  double ideal_wall_n() const noexcept;  ///< its push now
  /// The operator carries the arm back into its jig within kReturnS, where it is clamped again.
  void return_to_jig() noexcept { lead_arm(JointVector::Zero(), kReturnS); }
  void lead_arm(const JointVector& from_jig, double seconds) noexcept override;
  /// For boards whose driver sets their watchdog. @param seconds more than nothing; infinite: off.
  void set_watchdog(double seconds) noexcept { config_.watchdog_s = seconds; }
  /// Codes that act on the DACs now, and counts that the encoders have missed: for tests and studies only.
  const DacFrame& codes_in_force() const noexcept { return in_force_; }
  std::int64_t counts_lost(int channel) const noexcept { return encoders_.lost(channel); }
  const HandModel& hand() const noexcept { return hand_; }
  /// The device itself: for tests and studies only, never for a controller.
  const DevicePlant& plant() const noexcept { return plant_; }

 private:
  void pass_period() noexcept;
  void watch_writes() noexcept;
  void latch_codes() noexcept;
  void apply_volts() noexcept;
  void advance_period() noexcept;
  void carry() noexcept;
  void disturb_hand() noexcept;
  void switch_amplifiers(double at_s) noexcept;
  std::uint32_t digital_inputs() const noexcept;
  double next_s() const noexcept { return time_s() + period_s_; }
  int delay_now() noexcept;

  SimulatedDaqConfig config_;
  double period_s_, substep_s_;
  int substeps_;
  DevicePlant plant_;
  PlantEncoders encoders_;
  JointVector home_ = JointVector::Zero();  ///< where the jig holds the joints
  JointVector from_ = JointVector::Zero();  ///< where the operator took the arm up
  JointVector to_ = JointVector::Zero();    ///< and where it goes
  double jaw_from_ = 0, carried_s_ = -1;    ///< on the way, < 0: not on the way
  double carry_s_ = kReturnS;               ///< that it takes
  InfraredBeam beam_;
  PlantPotentiometer potentiometer_;
  HandModel hand_;
  IdealWall ideal_wall_;
  PlantFaults faults_;

  std::uint64_t sync_ = 0;
  std::uint32_t missed_ = 0;  ///< SYNCs since the last news
  DacFrame written_, in_force_;
  std::array<DacFrame, kMaxExtraDelayPeriods + 1> delayed_{};  ///< ring of frames on their way to the DAC
  std::size_t delay_head_ = 0;
  PlantRandom jitter_, jig_play_;
  std::int64_t arrived_ = -1;  ///< newest SYNC whose frame has reached the DACs
  double armed_for_s_ = 0;
  bool armed_ = false, pressed_ = true, watchdog_fired_ = false;
  double unwritten_s_ = 0;          ///< since the last write, while armed
  std::uint32_t dac_mismatch_ = 0;  ///< bits of the group
  DaqSample last_;
  Vec3 force_on_hand_ = Vec3::Zero(), moment_on_hand_ = Vec3::Zero();
  double force_on_finger_ = 0;
  bool clutch_pressed_ = false, pedal_pressed_ = false, exchange_pressed_ = false;
};

}  // namespace trocar
