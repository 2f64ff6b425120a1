// The self-test: what it waits for, what it calls a failure, how one starts again.
#include "tests/haptics/control/supervisor_fixture.h"

namespace trocar::self_test_test {
namespace {

using test::kMaxCounts;
using test::kPeriod;
using test::SupervisorTest;
using Delta = SupervisorTest::Delta;

/// Ticks until the self-test gives up; checks that it names what failed.
class SelfTest : public SupervisorTest {
 protected:
  void expect_failure(SelfTestCheck check, std::uint32_t digital, const Delta& delta, std::uint32_t elapsed = 1) {
    SafetyLimits limits;
    limits.max_missed_share = 1;  // else a bad pace would be a late loop first
    limits.max_missed_in_a_row = 1000000;
    supervisor = Supervisor(limits, kMaxCounts, kPeriod);
    int ticks = 0;
    for (; ticks < 11000 && supervisor.state() != LoopState::kFault; ++ticks) {
      step(digital, delta, ticks % 50 == 0 ? elapsed : 1);
      ASSERT_FALSE(supervisor.armed());
    }
    EXPECT_NEAR(ticks, 10000, 60);
    expect_fault(FaultCode::kSelfTest, -1);
    EXPECT_EQ(static_cast<std::uint32_t>(supervisor.fault().value) & check, check);
  }
};

TEST_F(SelfTest, FailsOnAnEncoderThatCountsWithTorqueOff) { expect_failure(kCheckStill, 0, {0, 1, 0, 0, 0, 0, 0}); }
TEST_F(SelfTest, FailsOnADeadmanThatNeverOpens) { expect_failure(kCheckDeadman, kDeadman, {}); }
TEST_F(SelfTest, FailsWherePeriodsAreMissed) {
  // One tick of fifty: at the moment the limit passes nothing may fail, but 0.1 s on end never came.
  expect_failure(SelfTestCheck{}, 0, {}, 2);
}

TEST_F(SelfTest, BeginsAnewAfterEachFailedCheck) {
  for (int i = 0; i < 5; ++i) {
    steps(90, 0);
    step(0, {0, 0, 0, 0, 0, 1, 0});
  }
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest);
  steps(102, 0);
  EXPECT_EQ(supervisor.state(), LoopState::kUnhomed);
}

TEST_F(SelfTest, AFailureMayBeResetAndPassThen) {
  for (int i = 0; i < 10100; ++i) step(kDeadman);
  expect_fault(FaultCode::kSelfTest, -1);
  supervisor.reset_fault();
  EXPECT_EQ(supervisor.state(), LoopState::kSelfTest);
  activate();
}

}  // namespace
}  // namespace trocar::self_test_test
