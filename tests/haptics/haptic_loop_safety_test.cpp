// Stops through the whole loop on the simulated device, beyond how fast each fault takes the torque away (which is
// tests/app/device_bench/fault_trials_test.cpp, on every back-end): how a soft one fades, what stays, what it takes to
// come back.
#include <gtest/gtest.h>

#include <numbers>

#include "haptics/control/gravity.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_loop_safety_test {
namespace {

using test::LoopRig;
using test::working_pose;

constexpr double kAt = 3.6;

/// Moves slowly up and down above a floor, so that codes and counts change all the time.
class MovingRig : public LoopRig {
 public:
  explicit MovingRig(const InjectedFault& fault, HapticLoopConfig loop_config = {}, bool readback = true)
      : LoopRig(device_with(fault, readback), loop_config) {
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
  double load() const { return daq.plant().motor_loads().cwiseAbs().maxCoeff(); }
  Pose rest;

  static SimulatedDaqConfig device_with(const InjectedFault& fault, bool readback) {
    SimulatedDaqConfig device;
    device.faults.push_back(fault);
    device.dac_readback = readback;
    return device;
  }
};

using K = InjectedFaultKind;

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
