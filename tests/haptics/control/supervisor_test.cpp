// States, homing, deadman, soft start and every fault, latched once.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/haptics/control/supervisor_fixture.h"

namespace trocar::supervisor_test {
namespace {

using test::kMaxCounts;
using test::kPeriod;
using test::SupervisorTest;
using Delta = SupervisorTest::Delta;

TEST_F(SupervisorTest, StartsOffThenTestsItself) {
  EXPECT_EQ(supervisor.state(), LoopState::kOff);
  EXPECT_FALSE(supervisor.armed());
  EXPECT_FALSE(supervisor.fault());
  step(0);
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest);
  EXPECT_FALSE(supervisor.armed());
  steps(95, 0);
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest);
  steps(10, 0);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed) << "0.1 s of passed checks";
}

TEST_F(SupervisorTest, HomesAfterHalfASecondOfStillness) {
  pass_self_test();
  int ticks = 0;
  while (supervisor.state() == LoopState::kUnhomed && ticks < 2000) {
    step(kHomeBeam);
    ++ticks;
  }
  EXPECT_NEAR(ticks, 500, 1);  // 0.5 s; the sum of 500 periods may round below it
  EXPECT_TRUE(supervisor.just_homed());
  step(0);
  EXPECT_FALSE(supervisor.just_homed()) << "only once";
}

TEST_F(SupervisorTest, AMovingCountRestartsTheStillness) {
  pass_self_test();
  steps(400, kHomeBeam);
  Delta moved{};
  moved[4] = -1;
  step(kHomeBeam, moved);
  steps(490, kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  steps(15, kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
}

TEST_F(SupervisorTest, BeamMustBeSeenForFiftyMillisecondsOnEnd) {
  pass_self_test();
  steps(1000, 0);  // still for long, no beam
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  for (int i = 0; i < 40; ++i) {  // flicker: 40 ms on, 1 ms off
    steps(40, kHomeBeam);
    step(0);
  }
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  steps(48, kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  steps(4, kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
}

TEST_F(SupervisorTest, DeadmanDoesNothingBeforeHoming) {
  pass_self_test();
  steps(2000, kDeadman);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  EXPECT_FALSE(supervisor.armed());
}

TEST_F(SupervisorTest, ADeadmanHeldWhileHomingEndsDoesNotArm) {
  pass_self_test();
  steps(2000, kDeadman | kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
  close_deadman();
}

TEST_F(SupervisorTest, ArmedHoldsForAMomentWithoutTorque) {
  home();
  step(0);
  step(kDeadman);
  EXPECT_EQ(supervisor.state(), LoopState::kArmed);
  EXPECT_TRUE(supervisor.armed());
  EXPECT_FALSE(supervisor.powered());
  EXPECT_EQ(supervisor.ramp(), 0);
  steps(15, kDeadman);
  EXPECT_EQ(supervisor.state(), LoopState::kArmed);
  step(0);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed) << "let go again";
}

TEST_F(SupervisorTest, DeadmanArmsAndItsReleaseDisarms) {
  activate();
  EXPECT_TRUE(supervisor.armed());
  step(0);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
  EXPECT_FALSE(supervisor.armed());
  close_deadman();  // homing is kept
}

TEST_F(SupervisorTest, TorqueRampsUpInOneSecondAndStartsAnewAfterRelease) {
  activate();
  double last = supervisor.ramp();
  EXPECT_LT(last, 0.01);
  for (int i = 0; i < 999; ++i) {
    step(kDeadman);
    EXPECT_GE(supervisor.ramp(), last);
    EXPECT_LE(supervisor.ramp() - last, kPeriod * (1 + 1e-9));
    last = supervisor.ramp();
  }
  EXPECT_NEAR(last, 1, 2e-3);
  steps(10, kDeadman);
  EXPECT_EQ(supervisor.ramp(), 1);
  step(0);
  close_deadman();
  EXPECT_LT(supervisor.ramp(), 0.01);
}

TEST_F(SupervisorTest, EncoderJumpFaultsOnTheChannelThatJumped) {
  activate();
  Delta delta{};
  delta[2] = 30;
  step(kDeadman, delta);
  EXPECT_EQ(supervisor.state(), LoopState::kActive) << "30 counts a period are still allowed";
  delta[2] = -31;
  step(kDeadman, delta);
  expect_fault(FaultCode::kEncoderJump, 2);
  EXPECT_EQ(supervisor.fault().value, -31);
  EXPECT_EQ(supervisor.fault().tick, tick - 1);
}

TEST_F(SupervisorTest, MissedPeriodsAllowProportionallyMoreCounts) {
  activate();
  Delta delta{};
  delta[0] = 85;
  step(kDeadman, delta, 3);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  delta[0] = 95;
  step(kDeadman, delta, 3);
  expect_fault(FaultCode::kEncoderJump, 0);
}

TEST_F(SupervisorTest, TheSmallestIntegerIsAJumpToo) {
  Delta delta{};
  delta[6] = std::numeric_limits<std::int32_t>::min();
  step(0, delta);
  expect_fault(FaultCode::kEncoderJump, 6);
}

TEST_F(SupervisorTest, InvalidChannelFaults) {
  activate();
  DaqSample sample;
  sample.digital_in = kDeadman;
  sample.valid = 0x7F & ~(1u << 5);
  supervisor.observe(tick++, sample, {});
  expect_fault(FaultCode::kChannelInvalid, 5);
}

TEST_F(SupervisorTest, HandFaultBitFaults) {
  activate();
  step(kDeadman | kHandFault);
  expect_fault(FaultCode::kHandNonFinite, -1);
}

TEST_F(SupervisorTest, OnePercentOfASecondMissedFaultsLessDoesNot) {
  activate();
  for (int i = 0; i < 9; ++i) step(kDeadman, {}, 2);
  EXPECT_EQ(supervisor.state(), LoopState::kActive) << "nine periods of a thousand are borne";
  steps(3000, kDeadman);  // forgotten by then
  for (int i = 0; i < 9; ++i) step(kDeadman, {}, 2);
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
  for (int i = 0; i < 3; ++i) step(kDeadman, {}, 2);
  expect_fault(FaultCode::kLateLoop, -1);
}

TEST_F(SupervisorTest, OneLongGapFaultsAtOnce) {
  activate();
  step(kDeadman, {}, 26);
  expect_fault(FaultCode::kLateLoop, -1);
}

TEST_F(SupervisorTest, ABoardThatCountsNoPeriodFaults) {
  activate();
  step(kDeadman, {}, 0);
  expect_fault(FaultCode::kSensorSilent, -1);
}

TEST_F(SupervisorTest, AfterAResetADeadmanHeldAllAlongDoesNotArm) {
  activate();
  supervisor.raise(FaultCode::kOverspeed, 10, 1, 16);
  supervisor.reset_fault();
  steps(2000, kDeadman | kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest) << "it waits for the deadman to open";
  activate();
}

constexpr std::array kAllFaults{
    FaultCode::kNone,         FaultCode::kEncoderJump,   FaultCode::kChannelInvalid, FaultCode::kNonFinite,
    FaultCode::kOverspeed,    FaultCode::kSingular,      FaultCode::kEnergyDebt,     FaultCode::kOverheat,
    FaultCode::kLateLoop,     FaultCode::kHandNonFinite, FaultCode::kSelfTest,       FaultCode::kEncoderStuck,
    FaultCode::kSensorSilent, FaultCode::kDacMismatch,   FaultCode::kWatchdog,       FaultCode::kEmergencyStop,
    FaultCode::kDriveFault,   FaultCode::kDriveHot,      FaultCode::kStalePatch};

TEST_F(SupervisorTest, HardFaultsDisarmAtOnceSoftOnesFadeInTwentyMilliseconds) {
  for (const FaultCode code : kAllFaults) {
    if (code == FaultCode::kNone) continue;
    supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
    activate();
    steps(1100, kDeadman);
    supervisor.raise(code, 77, 3, 1.5);
    EXPECT_EQ(supervisor.state(), LoopState::kFault);
    EXPECT_EQ(supervisor.armed(), is_soft(code)) << fault_name(code);
    int ticks = 0;
    for (double last = supervisor.ramp(); supervisor.armed() && ticks < 100; last = supervisor.ramp(), ++ticks) {
      step(kDeadman);
      EXPECT_LT(supervisor.ramp(), last);
    }
    EXPECT_LE(ticks, 21) << fault_name(code);
    EXPECT_GE(ticks, is_soft(code) ? 19 : 0) << fault_name(code);
    expect_fault(code, 3);
    EXPECT_EQ(supervisor.fault().tick, 77u);
    EXPECT_EQ(supervisor.fault().value, 1.5);
  }
}

TEST_F(SupervisorTest, AHardFaultOrAnOpenDeadmanEndsTheFadeOfASoftOne) {
  for (const bool by_deadman : {false, true}) {
    supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
    activate();
    steps(1100, kDeadman);
    supervisor.raise(FaultCode::kOverheat, 77, 3, 121);
    steps(3, kDeadman);
    EXPECT_TRUE(supervisor.armed());
    supervisor.raise(FaultCode::kSingular, 80, -1, 0.01);
    EXPECT_TRUE(supervisor.armed()) << "another soft one changes nothing";
    step(by_deadman ? 0 : kDeadman | kEmergencyStop);
    expect_fault(FaultCode::kOverheat, 3);  // the first cause stays
  }
}

TEST_F(SupervisorTest, InputsOfTheBoardAreFaultsInEveryState) {
  const std::pair<std::uint32_t, FaultCode> inputs[] = {{kEmergencyStop, FaultCode::kEmergencyStop},
                                                        {kWatchdogFired, FaultCode::kWatchdog},
                                                        {kDriveFault << 4, FaultCode::kDriveFault},
                                                        {kDriveHot << 4, FaultCode::kDriveHot},
                                                        {kDacMismatch << 4, FaultCode::kDacMismatch}};
  for (const auto& [input, code] : inputs) {
    for (const bool active : {false, true}) {
      supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
      if (active) activate();
      step((active ? kDeadman : 0u) | input);
      steps(30, kDeadman | input);
      expect_fault(code, code == FaultCode::kEmergencyStop || code == FaultCode::kWatchdog ? -1 : 4);
      supervisor.reset_fault();
      step(input);
      EXPECT_EQ(supervisor.state(), LoopState::kFault) << "still there: the reset is refused";
    }
  }
}

TEST_F(SupervisorTest, AResetWithoutAFaultDoesNothing) {
  activate();
  supervisor.reset_fault();
  EXPECT_EQ(supervisor.state(), LoopState::kActive);
}

TEST_F(SupervisorTest, TheFirstFaultIsKept) {
  activate();
  supervisor.raise(FaultCode::kOverheat, 10, 1, 121);
  supervisor.raise(FaultCode::kSingular, 11, -1, 0.01);
  step(kDeadman | kHandFault);  // hard: ends the fade
  expect_fault(FaultCode::kOverheat, 1);
  EXPECT_EQ(supervisor.fault().tick, 10u);
}

TEST_F(SupervisorTest, NothingButAResetLeavesTheFault) {
  activate();
  supervisor.raise(FaultCode::kOverspeed, 10, 1, 16);
  steps(3000, kDeadman | kHomeBeam);
  steps(3000, kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kFault);
  supervisor.reset_fault();
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest) << "homing must be done again";
  EXPECT_FALSE(supervisor.fault());
  steps(3000, kDeadman);
  EXPECT_FALSE(supervisor.armed());
  steps(1, 0);
  activate();
}

TEST_F(SupervisorTest, RatesCountTheirOwnPeriods) {
  supervisor = Supervisor(SafetyLimits{}, kMaxCounts, 0.25e-3);
  for (int i = 0; i < 500 && supervisor.state() != LoopState::kUnhomed; ++i) step(0);
  int ticks = 0;
  while (supervisor.state() == LoopState::kUnhomed && ticks < 9000) {
    step(kHomeBeam);
    ++ticks;
  }
  EXPECT_NEAR(ticks, 2000, 2);
}

TEST(FaultNames, AreDistinctAndStable) {
  for (const FaultCode a : kAllFaults) {
    EXPECT_STRNE(fault_name(a), "unknown");
    for (const FaultCode b : kAllFaults) EXPECT_TRUE(a == b || std::strcmp(fault_name(a), fault_name(b)) != 0);
  }
  EXPECT_STREQ(fault_name(static_cast<FaultCode>(kAllFaults.size())), "unknown") << "a code without a name or a test";
}

}  // namespace
}  // namespace trocar::supervisor_test
