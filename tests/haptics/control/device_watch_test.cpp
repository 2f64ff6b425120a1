// Warn first, reduce next, fault last: heat, speed, singularity, encoders that do not count.
#include "haptics/control/device_watch.h"

#include "tests/haptics/control/supervisor_fixture.h"

namespace trocar::device_watch_test {
namespace {

using test::kPeriod;
using test::SupervisorTest;

class DeviceWatchTest : public SupervisorTest {
 protected:
  void SetUp() override { activate(); }
  bool warns(LoopWarning warning) const { return watch.warnings() & bit(warning); }
  void look(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      now.tick = tick++;
      watch.update(now, supervisor);
    }
  }
  void expect_cause(FaultCode code, int channel) {
    EXPECT_EQ(supervisor.state(), LoopState::kFault);
    EXPECT_STREQ(fault_name(supervisor.fault().code), fault_name(code));
    EXPECT_EQ(supervisor.fault().channel, channel);
  }
  /// Torque at the joint that this current in the motor makes, N m.
  static double torque_of(double amps) { return amps * DeviceModel{}.transmission[0].torque_constant / 0.23; }

  DeviceWatch watch{SafetyLimits{}, DeviceModel{}, MotorHeatParameters{}, kPeriod};
  WatchedTick now;
};

TEST_F(DeviceWatchTest, NothingWrongMeansNoWarningAndFullContact) {
  look(5000);
  EXPECT_EQ(watch.warnings(), 0);
  EXPECT_EQ(watch.contact_share(), 1);
  EXPECT_EQ(watch.damping(ChannelVector::Ones()).norm(), 0);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

TEST_F(DeviceWatchTest, AHotMotorIsWarnedOfThenFadedThenCut) {
  now.torque[3] = torque_of(4.31);
  double warned_c = 0, faded_c = 0;
  for (int k = 0; k < 30000 && supervisor.state() == LoopState::kActive; ++k) {
    look();
    if (warns(LoopWarning::kHotMotor) && warned_c == 0) warned_c = watch.hottest_c();
    if (watch.contact_share() < 1 && faded_c == 0) faded_c = watch.hottest_c();
  }
  // The winding warms by less than 0.02 K a tick.
  EXPECT_NEAR(warned_c, 100, 0.02);
  EXPECT_NEAR(faded_c, 110, 0.02);
  EXPECT_NEAR(watch.hottest_c(), 120, 0.02);
  EXPECT_EQ(watch.contact_share(), 0);
  expect_cause(FaultCode::kOverheat, 3);
}

TEST_F(DeviceWatchTest, MotorsBeginAsWarmAsTheyAreSaidToBe) {
  MotorStates motors;
  motors[5] = {105, 80};
  watch = DeviceWatch(SafetyLimits{}, DeviceModel{}, MotorHeatParameters{}, kPeriod, motors);
  EXPECT_EQ(watch.motors(), motors);
  look();
  EXPECT_TRUE(warns(LoopWarning::kHotMotor));
  EXPECT_LT(watch.motors()[5].winding_c, 105);
  motors[5].winding_c = 121;
  watch = DeviceWatch(SafetyLimits{}, DeviceModel{}, MotorHeatParameters{}, kPeriod, motors);
  look();
  expect_cause(FaultCode::kOverheat, 5);
}

TEST_F(DeviceWatchTest, ATorqueThatIsNoNumberFaultsAndSparesTheHeatModel) {
  now.torque[2] = std::numeric_limits<double>::quiet_NaN();
  look();
  expect_cause(FaultCode::kNonFinite, 2);
  EXPECT_EQ(watch.hottest_c(), 25);
}

TEST_F(DeviceWatchTest, AFastJointIsDampedForTenMillisecondsThenFaults) {
  now.qd[4] = -15.5;
  look(9);
  EXPECT_TRUE(warns(LoopWarning::kOverspeed));
  EXPECT_EQ(watch.contact_share(), 0) << "no contact force while it is too fast";
  EXPECT_GT(watch.damping(now.qd)[4], 0) << "against the motion";
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  look(3);
  expect_cause(FaultCode::kOverspeed, 4);
  EXPECT_EQ(supervisor.fault().value, -15.5);
}

TEST_F(DeviceWatchTest, AJointThatSlowsDownInTimeIsNoFault) {
  for (int k = 0; k < 20; ++k) {
    now.qd[4] = 16;
    look(9);
    now.qd[4] = 14;
    look();
  }
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  EXPECT_FALSE(warns(LoopWarning::kOverspeed));
  EXPECT_EQ(watch.contact_share(), 1);
}

TEST_F(DeviceWatchTest, AFastTipFaultsWithoutAChannel) {
  now.tip_speed = 2.1;
  look(12);
  expect_cause(FaultCode::kOverspeed, -1);
  EXPECT_EQ(supervisor.fault().value, 2.1);
}

TEST_F(DeviceWatchTest, ThePinchIsNotAJoint) {
  now.qd[kPinchChannel] = 16;  // m/s: the supervisor's count limit stops it long before
  look(50);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

TEST_F(DeviceWatchTest, NearSingularIsWarnedOfThenAFault) {
  now.det_a = 0.29;
  look();
  EXPECT_TRUE(warns(LoopWarning::kNearSingular));
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  now.det_a = 0.31;
  look();
  EXPECT_FALSE(warns(LoopWarning::kNearSingular)) << "a warning does not latch";
  now.det_a = 0.049;
  look();
  expect_cause(FaultCode::kSingular, -1);
}

TEST_F(DeviceWatchTest, SaturationAndDebtAreWarningsOnly) {
  now.saturated = now.debt = true;
  look(3000);
  EXPECT_TRUE(warns(LoopWarning::kForceSaturated));
  EXPECT_TRUE(warns(LoopWarning::kEnergyDebt));
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

TEST_F(DeviceWatchTest, MuchTorqueAndNoCountInFreeSpaceIsSuspect) {
  now.torque[1] = torque_of(1.3);  // 30 % of the motor's 4.31 A
  look(199);
  EXPECT_FALSE(warns(LoopWarning::kEncoderStuck));
  look(2);
  EXPECT_TRUE(warns(LoopWarning::kEncoderStuck));
  look(10000);
  EXPECT_EQ(supervisor.state(), LoopState::kActive) << "an arm held still looks the same: only a warning";
  now.delta[1] = 1;
  look();
  EXPECT_FALSE(warns(LoopWarning::kEncoderStuck));
}

TEST_F(DeviceWatchTest, NothingIsSuspectInContactOrWithLittleTorque) {
  now.torque[1] = torque_of(1.3);
  now.touching = true;
  look(1000);
  EXPECT_FALSE(warns(LoopWarning::kEncoderStuck));
  now.touching = false;
  now.torque[1] = torque_of(1.2);
  look(1000);
  EXPECT_FALSE(warns(LoopWarning::kEncoderStuck));
}

TEST_F(DeviceWatchTest, APushedJointThatStaysWhileTheArmTravelsIsAFault) {
  now.torque[1] = torque_of(2);
  now.delta[0] = now.delta[3] = 5;
  look(240);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  look();
  expect_cause(FaultCode::kEncoderStuck, 1);
}

TEST_F(DeviceWatchTest, WithoutTorqueTheArmMustTravelFar) {
  now.delta.fill(5);
  now.delta[2] = 0;
  look(480);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  look();
  expect_cause(FaultCode::kEncoderStuck, 2);
  EXPECT_EQ(supervisor.fault().value, 12025 - 5 * 4) << "the dither of five joints is no travel";
}

TEST_F(DeviceWatchTest, OneCountStartsTheTravelAnewAndTheJawsMayRest) {
  now.delta.fill(5);
  now.delta[kPinchChannel] = 0;
  for (int k = 0; k < 20; ++k) {
    now.delta[2] = 0;
    look(400);
    now.delta[2] = -1;
    look();
  }
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

TEST_F(DeviceWatchTest, AHeldArmThatTremblesDoesNotTravelHoweverLong) {
  now.torque[2] = torque_of(2);  // rests on its joint all the while
  for (int k = 0; k < 20000; ++k) {
    now.delta.fill(k % 2 == 0 ? 4 : -4);
    now.delta[2] = 0;
    look();
  }
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  now.delta.fill(5);
  now.delta[2] = 0;
  look(200);
  expect_cause(FaultCode::kEncoderStuck, 2);
}

TEST_F(DeviceWatchTest, AnOldPatchFadesTheContactThenFaultsSoftly) {
  SafetyLimits limits;
  limits.max_patch_age_s = 0.2;
  watch = DeviceWatch(limits, DeviceModel{}, MotorHeatParameters{}, kPeriod);
  const auto at_age = [&](double age_s) {
    now.patch_age_s = age_s;
    look();
    return watch.contact_share();
  };
  EXPECT_EQ(at_age(0.099), 1);
  EXPECT_FALSE(warns(LoopWarning::kStalePatch));
  EXPECT_NEAR(at_age(0.15), 0.5, 1e-9);
  EXPECT_TRUE(warns(LoopWarning::kStalePatch));
  EXPECT_NEAR(at_age(0.2), 0, 1e-9);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  EXPECT_NEAR(at_age(0.001), 0.02, 1e-9) << "a new patch brings it back, in 50 ms";
  EXPECT_FALSE(warns(LoopWarning::kStalePatch));
  for (int k = 0; k < 60; ++k) at_age(0.01);
  EXPECT_EQ(watch.contact_share(), 1);
  at_age(0.201);
  expect_cause(FaultCode::kStalePatch, -1);
}

TEST_F(DeviceWatchTest, WhereNobodyMakesPatchesAnewNoneIsOld) {
  now.patch_age_s = 1e9;
  look(10);
  EXPECT_EQ(watch.contact_share(), 1);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

}  // namespace
}  // namespace trocar::device_watch_test
