// States, homing, deadman, soft start and every fault, latched once.
#include <gtest/gtest.h>

#include <cstring>

#include "haptics/control/supervisor.h"
#include "haptics_fixtures.h"

namespace trocar {
namespace {

constexpr std::array<std::int32_t, kChannels> kMaxCounts{30, 30, 30, 30, 30, 30, 30};
constexpr double kPeriod = 1e-3;
using Delta = std::array<std::int32_t, kChannels>;

class SupervisorTest : public ::testing::Test {
 protected:
  /// One tick with these inputs.
  void step(std::uint32_t digital, const Delta& delta = {}, std::uint32_t elapsed = 1) {
    DaqSample sample;
    sample.digital_in = digital;
    sample.elapsed_periods = elapsed;
    supervisor.observe(tick++, sample, delta);
  }
  void steps(int count, std::uint32_t digital) {
    for (int i = 0; i < count; ++i) step(digital);
  }
  void home() {
    for (int i = 0; i < 600 && supervisor.state() == LoopState::kUnhomed; ++i) step(kHomeBeam);
    ASSERT_EQ(supervisor.state(), LoopState::kHomed);
  }
  void activate() {
    home();
    step(kDeadman);
    ASSERT_EQ(supervisor.state(), LoopState::kActive);
  }
  void expect_fault(FaultCode code, int channel) {
    EXPECT_EQ(supervisor.state(), LoopState::kFault);
    EXPECT_EQ(supervisor.fault().code, code) << fault_name(supervisor.fault().code);
    EXPECT_EQ(supervisor.fault().channel, channel);
    EXPECT_FALSE(supervisor.armed());
    EXPECT_EQ(supervisor.ramp(), 0);
  }

  Supervisor supervisor{SafetyLimits{}, kMaxCounts, kPeriod};
  std::uint64_t tick = 0;
};

TEST_F(SupervisorTest, StartsUnhomedAndUnarmed) {
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  EXPECT_FALSE(supervisor.armed());
  EXPECT_FALSE(supervisor.fault());
}

TEST_F(SupervisorTest, HomesAfterHalfASecondOfStillness) {
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
  steps(2000, kDeadman);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
  EXPECT_FALSE(supervisor.armed());
}

TEST_F(SupervisorTest, DeadmanArmsAndItsReleaseDisarms) {
  activate();
  EXPECT_TRUE(supervisor.armed());
  step(0);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
  EXPECT_FALSE(supervisor.armed());
  step(kDeadman);
  EXPECT_EQ(supervisor.state(), LoopState::kActive) << "homing is kept";
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
  step(0);
  step(kDeadman);
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
  expect_fault(FaultCode::kLateLoop, -1);
}

TEST_F(SupervisorTest, AfterAResetADeadmanHeldAllAlongDoesNotArm) {
  activate();
  supervisor.raise(FaultCode::kOverspeed, 10, 1, 16);
  supervisor.reset_fault();
  steps(2000, kDeadman | kHomeBeam);
  EXPECT_EQ(supervisor.state(), LoopState::kHomed);
  step(kHomeBeam);
  step(kDeadman);
  EXPECT_TRUE(supervisor.armed());
}

TEST_F(SupervisorTest, RaisedFaultsOfEveryCodeDisarm) {
  for (const FaultCode code : {FaultCode::kNonFinite, FaultCode::kOverspeed, FaultCode::kSingular,
                               FaultCode::kEnergyDebt, FaultCode::kOverheat}) {
    supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
    activate();
    supervisor.raise(code, 77, 3, 1.5);
    expect_fault(code, 3);
    EXPECT_EQ(supervisor.fault().tick, 77u);
    EXPECT_EQ(supervisor.fault().value, 1.5);
  }
}

TEST_F(SupervisorTest, TheFirstFaultIsKept) {
  activate();
  supervisor.raise(FaultCode::kOverheat, 10, 1, 121);
  supervisor.raise(FaultCode::kSingular, 11, -1, 0.01);
  step(kDeadman | kHandFault);
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
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed) << "homing must be done again";
  EXPECT_FALSE(supervisor.fault());
  steps(3000, kDeadman);
  EXPECT_FALSE(supervisor.armed());
  steps(1, 0);
  activate();
}

TEST_F(SupervisorTest, RatesCountTheirOwnPeriods) {
  supervisor = Supervisor(SafetyLimits{}, kMaxCounts, 0.25e-3);
  int ticks = 0;
  while (supervisor.state() == LoopState::kUnhomed && ticks < 9000) {
    step(kHomeBeam);
    ++ticks;
  }
  EXPECT_NEAR(ticks, 2000, 2);
}

TEST(FaultNames, AreDistinctAndStable) {
  const FaultCode codes[] = {FaultCode::kNone,         FaultCode::kEncoderJump, FaultCode::kChannelInvalid,
                             FaultCode::kNonFinite,    FaultCode::kOverspeed,   FaultCode::kSingular,
                             FaultCode::kEnergyDebt,   FaultCode::kOverheat,    FaultCode::kLateLoop,
                             FaultCode::kHandNonFinite};
  for (const FaultCode a : codes) {
    EXPECT_STRNE(fault_name(a), "unknown");
    for (const FaultCode b : codes) EXPECT_TRUE(a == b || std::strcmp(fault_name(a), fault_name(b)) != 0);
  }
}

}  // namespace
}  // namespace trocar
