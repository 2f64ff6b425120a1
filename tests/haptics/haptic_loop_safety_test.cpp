// Stops of every kind through the whole loop on the simulated device: how fast the torque goes, what stays, what it
// takes to come back. The times are those of docs/device_and_safety.md.
#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "haptics/control/gravity.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/device/mc4000/emulated_mc4000.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_loop_safety_test {
namespace {

using test::LoopRig;
using test::MakeRigBoard;
using test::RigBoard;
using test::working_pose;

constexpr double kAt = 3.6;

/// Moves slowly up and down above a floor, so that codes and counts change all the time.
class MovingRig : public LoopRig {
 public:
  explicit MovingRig(const InjectedFault& fault, HapticLoopConfig loop_config = {}, bool readback = true)
      : MovingRig(device_with(fault, readback), loop_config, MakeRigBoard{}) {}
  MovingRig(const SimulatedDaqConfig& device, const HapticLoopConfig& loop_config, const MakeRigBoard& make_board)
      : LoopRig(device, loop_config, make_board) {
    start();
    move(working_pose(), 1.0);
    rest = goal;
  }
  void swing(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      const double phase = 2 * std::numbers::pi * daq.time_s();
      goal.p = rest.p + 0.02 * Vec3(std::sin(2 * phase), std::sin(phase), std::cos(3 * phase));
      goal.R = Eigen::AngleAxisd(0.2 * std::sin(phase), Vec3(1, 1, 1).normalized()).toRotationMatrix() * rest.R;
      tick();
    }
  }
  double load() const {
    const auto held = board.hold();
    return daq.plant().motor_loads().cwiseAbs().maxCoeff();
  }
  Pose rest;

  static SimulatedDaqConfig device_with(const InjectedFault& fault, bool readback) {
    SimulatedDaqConfig device;
    device.faults.push_back(fault);
    device.dac_readback = readback;
    return device;
  }
};

struct Stop {
  const char* name;
  InjectedFault fault;
  FaultCode cause;
  int channel;
  int ticks;  ///< at most, from the SYNC at which it shows to no current at all
};

/// The driver of a card on the network, and the card that is not there.
RigBoard card_board(SimulatedDaq& device, const InjectedFault& fault) {
  struct Card final : DataAcquisition {
    Card(SimulatedDaq& d, const InjectedFault& f)
        : fake(d, {f}, options().wiring), driver([this] {
            Hostmot2Options own = options();
            own.card = fake.address();
            return own;
          }()) {}
    static Hostmot2Options options() {
      Hostmot2Options out;
      out.wait_share = out.rate_hz;  // a second: a busy machine may be late
      out.wiring.inputs.push_back({kHandFault, 69, false});
      return out;
    }
    DaqCapabilities capabilities() const noexcept override { return driver.capabilities(); }
    /// A card that has been silent for a few ticks stays so: it is not waited for any more.
    DaqSample read() noexcept override {
      if (silent_for < 6) last = driver.read();
      silent_for = last.elapsed_periods == 0 ? silent_for + 1 : 0;
      return last;
    }
    void write(const DacFrame& frame) noexcept override { driver.write(frame); }
    void arm(bool enabled) noexcept override {
      driver.arm(enabled);
      if (!enabled) fake.settle(driver.link().sent);
    }
    FakeHostmot2 fake;
    Hostmot2Daq driver;
    DaqSample last;
    int silent_for = 0;
  };
  auto card = std::make_unique<Card>(device, fault);
  FakeHostmot2* fake = &card->fake;
  return {.daq = std::move(card), .world = fake, .hold = [fake] { return fake->hold(); }};
}

/// The driver of the thesis' boards, and boards that are not there.
RigBoard boards_board(SimulatedDaq& device) {
  struct Boards final : DataAcquisition {
    explicit Boards(SimulatedDaq& d)
        : pair(d, 1000, {}, options().inputs), driver(pair.board(0), pair.board(1), options()) {}
    static Mc4000Options options() {
      Mc4000Options out;
      out.inputs.push_back({kHandFault, 1, 31, false});
      return out;
    }
    DaqCapabilities capabilities() const noexcept override { return driver.capabilities(); }
    DaqSample read() noexcept override { return driver.read(); }
    void write(const DacFrame& frame) noexcept override { driver.write(frame); }
    void arm(bool enabled) noexcept override { driver.arm(enabled); }
    EmulatedMc4000 pair;
    Mc4000Daq driver;
  };
  return {.daq = std::make_unique<Boards>(device), .world = &device};
}

class Stops : public ::testing::TestWithParam<std::tuple<const char*, Stop>> {};

TEST_P(Stops, TorqueGoesInTimeAndTheFirstCauseStays) {
  const auto& [backend, stop] = GetParam();
  SimulatedDaqConfig device = MovingRig::device_with(stop.fault, true);
  MakeRigBoard make_board;
  if (backend == std::string(kFakeHostmot2Backend)) {
    if (stop.cause == FaultCode::kDacMismatch) GTEST_SKIP() << "this card's outputs cannot be read back";
    device = FakeHostmot2::device_config(device);
    make_board = [&fault = stop.fault](SimulatedDaq& d) { return card_board(d, fault); };
  }
  if (backend == std::string(kEmulatedMc4000Backend)) {
    device = EmulatedMc4000::device_config(device);
    make_board = boards_board;
  }
  MovingRig rig(device, {}, make_board);
  while (rig.daq.time_s() < kAt - 1.5e-3) {
    rig.swing(1);
    ASSERT_TRUE(rig.record.amplifiers_armed) << fault_name(rig.record.stylus.fault.code);
  }
  EXPECT_GT(rig.load(), 0.05) << "there is torque to lose";
  int ticks = 0;
  do {
    rig.swing(1);
    ++ticks;
  } while (rig.load() > 0 && ticks < 100);
  RecordProperty("ticks", ticks);
  EXPECT_LE(ticks, stop.ticks);
  rig.swing(50);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kFault);
  EXPECT_STREQ(fault_name(rig.record.stylus.fault.code), fault_name(stop.cause));
  EXPECT_EQ(rig.record.stylus.fault.channel, stop.channel);
  EXPECT_FALSE(rig.record.amplifiers_armed);
  EXPECT_EQ(rig.load(), 0);
  for (const std::int32_t code : rig.record.out.codes) EXPECT_EQ(code, 0);
  const Fault first = rig.record.stylus.fault;
  rig.swing(500);
  EXPECT_EQ(rig.record.stylus.fault.tick, first.tick) << "latched";
  EXPECT_EQ(rig.load(), 0) << "nothing brings the torque back";
  EXPECT_EQ(rig.allocations, 0u);
}

using K = InjectedFaultKind;
INSTANTIATE_TEST_SUITE_P(
    Injected, Stops,
    ::testing::Combine(
        ::testing::Values(kSimulatedBackend, kFakeHostmot2Backend, kEmulatedMc4000Backend),
        ::testing::Values(Stop{"EncoderJump", {K::kEncoderJump, kAt, 0, 2, 500}, FaultCode::kEncoderJump, 2, 2},
                          Stop{"DeadChannel", {K::kChannelInvalid, kAt, 0, 4, 0}, FaultCode::kChannelInvalid, 4, 2},
                          Stop{"SensorSilence", {K::kSensorSilence, kAt, 0, 0, 0}, FaultCode::kSensorSilent, -1, 2},
                          Stop{"EmergencyStop", {K::kEmergencyStop, kAt, 0, 0, 0}, FaultCode::kEmergencyStop, -1, 2},
                          Stop{"DriveFault", {K::kDriveFault, kAt, 0, 3, 0}, FaultCode::kDriveFault, 3, 2},
                          Stop{"DacStuck", {K::kDacStuck, kAt, 0, 1, 0}, FaultCode::kDacMismatch, 1, 2},
                          Stop{"HandNaN", {K::kHandNaN, kAt, 0.1, 0, 0}, FaultCode::kHandNonFinite, -1, 2},
                          Stop{"LostSyncs", {K::kMissedSync, kAt, 0, 0, 25}, FaultCode::kLateLoop, -1, 2},
                          // The board zeroes its DACs after 16 ms, the loop cuts the current when it hears of it.
                          Stop{"LostWrites", {K::kWatchdog, kAt, 0, 0, 0}, FaultCode::kWatchdog, -1, 18},
                          // Soft: faded within 20 ms.
                          Stop{"DriveHot", {K::kOverTemperature, kAt, 0, 0, 0}, FaultCode::kDriveHot, 0, 22})),
    [](const auto& stop) {
      const std::string backend = std::get<0>(stop.param);
      return (backend == kSimulatedBackend      ? "Simulated"
              : backend == kFakeHostmot2Backend ? "Hostmot2"
                                                : "Mc4000") +
             std::string(std::get<1>(stop.param).name);
    });

TEST(SoftStop, FadesTheWeightAndDropsTheContact) {
  MovingRig rig({K::kOverTemperature, kAt, 0, 0, 0});
  while (rig.daq.time_s() < kAt - 0.5e-3) rig.swing(1);
  const double before = rig.record.torque.norm();
  double last = before;
  int ticks = 0;
  for (; rig.record.amplifiers_armed && ticks < 60; ++ticks) {
    rig.swing(1);
    EXPECT_EQ(rig.record.stylus.F_I_T.force.norm(), 0) << "no contact force in a fault";
    EXPECT_LT(rig.record.torque.norm(), last + 0.02 * before) << "only downwards";
    if (ticks == 10) {
      EXPECT_NEAR(rig.record.torque.norm(), before / 2, 0.15 * before);
    }
    last = rig.record.torque.norm();
  }
  EXPECT_GE(ticks, 19);
  EXPECT_LE(ticks, 22);
}

TEST(Deadman, OpenTakesTheTorqueAndOnlyTheOperatorBringsItBack) {
  MovingRig rig({K::kDeadmanOpen, kAt, 0.3, 0, 0});
  while (rig.daq.time_s() < kAt - 1.5e-3) rig.swing(1);
  EXPECT_GT(rig.load(), 0.05);
  rig.swing(2);
  EXPECT_EQ(rig.load(), 0) << "stop category 0: by wire";
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kHomed);
  EXPECT_FALSE(rig.record.stylus.fault) << "the operator's right, no fault";
  rig.swing(295);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kHomed) << "while it is open";
  rig.swing(6);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kArmed) << "closed again by the operator";
  EXPECT_EQ(rig.record.torque.norm(), 0);
  rig.swing(25);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive);
  const double early = rig.record.torque.norm();
  rig.swing(1000);
  EXPECT_GT(rig.record.torque.norm(), 10 * early) << "with the soft start";
}

TEST(Deadman, AHandThatLetsGoSwitchesOff) {
  MovingRig rig({K::kHandLetsGo, kAt, 0.1, 0, 0});
  while (rig.daq.time_s() < kAt + 0.5e-3) rig.swing(1);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kHomed);
  EXPECT_EQ(rig.load(), 0);
}

TEST(StuckEncoder, OfAMovingArmIsFoundAndHarmlessUntilThen) {
  double worst_s = 0;
  for (int channel = 0; channel < kArmJoints; ++channel) {
    MovingRig rig({K::kEncoderStuck, kAt, 0, channel, 0});
    double fastest = 0;
    while (rig.record.stylus.loop != LoopState::kFault && rig.daq.time_s() < 60) {
      rig.swing(1);
      fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
    }
    EXPECT_STREQ(fault_name(rig.record.stylus.fault.code), "encoder-stuck");
    EXPECT_EQ(rig.record.stylus.fault.channel, channel);
    EXPECT_LT(fastest, 1.0) << "the hand swings at 0.5 m/s";
    worst_s = std::max(worst_s, rig.daq.time_s() - kAt);
  }
  RecordProperty("worst_s", std::to_string(worst_s));
  EXPECT_LT(worst_s, 15);
}

TEST(StuckDac, WithoutReadbackMotionBetraysIt) {
  // The pushing motor is seen only by what it does: too fast a joint, or nothing where the hand holds against it.
  MovingRig rig({K::kDacStuck, kAt, 0, 1, 0}, {}, false);
  double fastest = 0;
  for (int k = 0; k < 3000; ++k) {
    rig.swing(1);
    fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
  }
  EXPECT_LT(fastest, 1.0) << "one motor against a hand: no runaway";
  EXPECT_NE(rig.record.stylus.fault.code, FaultCode::kDacMismatch) << "it cannot know";
}

/// A brisk press of the hand into a floor, then half a second of holding, under further delay behind the DAC register.
struct Press {
  double given_j = 0;  ///< most energy that the contact torque had given out beyond what it took in, true motion
  double unrest = 0;   ///< fastest stylus during the last half second, m/s
  LoopState state = LoopState::kOff;
};
Press press_under_delay(double stiffness, int periods) {
  HapticLoopConfig config;
  config.friction.share = 0;  // so that what is not gravity is contact
  MovingRig rig({K::kDelay, 0, 0, 0, static_cast<double>(periods)}, config);
  rig.daq.set_hand_parameters(hand_parameters(GripPreset::kFingertip));
  rig.run(0.5);
  rig.put_floor(0.004, stiffness);
  Press press;
  double energy = 0;
  ChannelVector last = rig.daq.plant().outputs();
  const Pose above = rig.goal;
  for (int k = 0; k < 1500; ++k) {
    rig.goal.p.z() = above.p.z() - 0.02 * std::min(1.0, k / 60.0);
    rig.tick();
    const ChannelVector now = rig.daq.plant().outputs();
    ChannelVector contact = rig.daq.plant().motor_loads();
    contact.head<kArmJoints>() -= gravity_torque(config.device, arm_state(now.head<kArmJoints>()));
    if (rig.record.stylus.contact) energy -= contact.head<kArmJoints>().dot((now - last).head<kArmJoints>());
    press.given_j = std::max(press.given_j, -energy);
    if (k >= 1000) press.unrest = std::max(press.unrest, rig.daq.plant().motion().V_BS.linear.norm());
    last = now;
  }
  press.state = rig.record.stylus.loop;
  return press;
}

TEST(ExtraDelay, IsUnseenButPassiveAtTheStiffnessOfTissue) {
  // A fingertip grip is the worst of the four. 4 mJ: what the law leaked at most over the reference's grid.
  for (const auto& [stiffness, periods] : {std::pair{150, 3}, {150, 5}, {150, 10}, {400, 3}}) {
    const Press press = press_under_delay(stiffness, periods);
    RecordProperty("given_uj_" + std::to_string(stiffness) + "_" + std::to_string(periods),
                   static_cast<int>(1e6 * press.given_j));
    EXPECT_EQ(press.state, LoopState::kActive) << "nothing shows it: " << stiffness << " N/m, " << periods;
    EXPECT_LT(press.given_j, 4e-3) << stiffness << " N/m, " << periods;
    EXPECT_LT(press.unrest, 0.05) << stiffness << " N/m, " << periods;
  }
}

TEST(ExtraDelay, OfTenPeriodsAtAStiffWallLeaksEnergyThatTheObserverDoesNotSee) {
  // The observer believes in one period. This is the limit of what can be held without knowing the delay.
  const Press press = press_under_delay(400, 10);
  RecordProperty("given_uj", static_cast<int>(1e6 * press.given_j));
  EXPECT_GT(press.given_j, 4e-3) << "it holds here too: say so in docs/device_and_safety.md";
  EXPECT_LT(press.unrest, 1) << "a limit cycle under the hand, no runaway";
}

TEST(EnergyDebt, WarnsAndFadesThenStopsSoftly) {
  // Limits small enough for what a delayed wall leaks; the order is what counts.
  HapticLoopConfig config;
  config.passivity.law = PassivityLaw::kBudgeted;
  config.passivity.fade_debt_j = 2e-6;
  config.passivity.fault_debt_j = 2e-5;
  config.passivity.forgiven_w = 0;
  MovingRig rig({K::kDelay, 0, 0, 0, 30}, config);
  rig.run(0.5);
  rig.put_floor(0.004, 400);
  const Pose above = rig.goal;
  bool warned = false;
  for (int k = 0; k < 6000 && rig.record.stylus.loop == LoopState::kActive; ++k) {
    rig.goal.p.z() = above.p.z() - 0.012 * (1 - std::cos(0.02 * k));
    rig.tick();
    warned = warned || (rig.record.warnings & bit(LoopWarning::kEnergyDebt));
  }
  EXPECT_TRUE(warned);
  ASSERT_STREQ(fault_name(rig.record.stylus.fault.code), "energy-debt");
  EXPECT_LT(rig.record.stylus.fault.value, -config.passivity.fault_debt_j);
  EXPECT_TRUE(rig.record.amplifiers_armed);
  rig.run(0.025);
  EXPECT_FALSE(rig.record.amplifiers_armed);
}

TEST(Overspeed, IsDampedThenFadedOut) {
  MovingRig rig({K::kHandNaN, 1000, 0, 0, 0});
  // A throw: the hand wants to be 60 cm away at once and moves as fast as a hand can.
  bool damped = false;
  for (int k = 0; k < 400 && rig.record.stylus.loop == LoopState::kActive; ++k) {
    rig.goal.p = rig.rest.p + Vec3(0.1, -0.6, 0.1);
    rig.tick();
    damped = damped || (rig.record.warnings & bit(LoopWarning::kOverspeed));
  }
  EXPECT_TRUE(damped);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kFault);
  EXPECT_STREQ(fault_name(rig.record.stylus.fault.code), "overspeed");
  EXPECT_TRUE(rig.record.amplifiers_armed) << "soft";
  rig.run(0.025);
  EXPECT_EQ(rig.load(), 0);
}

TEST(Heat, FadesTheContactThenCutsTheTorque) {
  HapticLoopConfig config;
  config.heat.winding_time_s = 0.05;  // a motor so small that its own gravity load cooks it within seconds
  config.heat.case_time_s = 0.5;
  config.heat.case_to_air_k_per_w = 600;
  MovingRig rig({K::kHandNaN, 1000, 0, 0, 0}, config);
  double warned_c = 0;
  for (int k = 0; k < 60000 && rig.record.stylus.loop == LoopState::kActive; ++k) {
    rig.swing(1);
    if ((rig.record.warnings & bit(LoopWarning::kHotMotor)) && warned_c == 0) warned_c = rig.record.winding_c;
  }
  EXPECT_NEAR(warned_c, 100, 1);
  ASSERT_STREQ(fault_name(rig.record.stylus.fault.code), "overheat");
  EXPECT_NEAR(rig.record.stylus.fault.value, 120, 1);
  rig.swing(25);
  EXPECT_EQ(rig.load(), 0);
  rig.loop.reset_fault();
  rig.swing(1);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kFault) << "a reset does not help while it is hot";
}

TEST(Reset, LeadsThroughEveryStateBackToWork) {
  MovingRig rig({K::kEncoderJump, kAt, 0, 0, 500});
  while (rig.record.stylus.loop != LoopState::kFault) rig.swing(1);
  rig.daq.press_deadman(false);
  rig.run(0.2);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kFault);
  rig.loop.reset_fault();
  rig.run(0.05);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kSelfTest);
  // The operator carries the arm back into its jig, which clamps it; then homing, deadman, soft start.
  rig.holding = false;
  rig.daq.release_hand();
  rig.daq.return_to_jig();
  rig.run(1.8);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kHomed);
  EXPECT_EQ(rig.load(), 0);
  rig.goal = rig.daq.sense().X_BS;
  rig.holding = true;
  rig.daq.press_deadman(true);
  rig.run(1.3);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive);
  EXPECT_FALSE(rig.record.stylus.fault);
  EXPECT_GT(rig.load(), 0.01) << "the weight is carried again";
  EXPECT_LT((rig.config.map.stylus_pose(rig.record.stylus.X_TI).p - rig.daq.sense().X_BS.p).norm(), 1e-3);
  std::vector<LoopState> states;
  for (const SafetyTransition& t : rig.loop.safety_log().transitions()) states.push_back(t.to);
  using L = LoopState;
  EXPECT_EQ(states, (std::vector<L>{L::kSelfTest, L::kUnhomed, L::kHomed, L::kArmed, L::kActive, L::kFault,
                                    L::kSelfTest, L::kUnhomed, L::kHomed, L::kArmed, L::kActive}));
}

}  // namespace
}  // namespace trocar::haptic_loop_safety_test
