// A supervisor fed tick by tick with inputs and count differences, and the ways to bring it into a state.
#pragma once

#include <gtest/gtest.h>

#include "haptics/control/supervisor.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::test {

inline constexpr std::array<std::int32_t, kChannels> kMaxCounts{30, 30, 30, 30, 30, 30, 30};
inline constexpr double kPeriod = 1e-3;

class SupervisorTest : public ::testing::Test {
 public:
  using Delta = std::array<std::int32_t, kChannels>;

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
  void pass_self_test() {
    for (int i = 0; i < 200 && supervisor.state() != LoopState::kUnhomed; ++i) step(0);
    ASSERT_EQ(supervisor.state(), LoopState::kUnhomed);
  }
  void home() {
    pass_self_test();
    for (int i = 0; i < 600 && supervisor.state() == LoopState::kUnhomed; ++i) step(kHomeBeam);
    ASSERT_EQ(supervisor.state(), LoopState::kHomed);
  }
  /// Deadman open, then closed for the moment in which the codes stay zero.
  void close_deadman() {
    step(0);
    step(kDeadman);
    ASSERT_EQ(supervisor.state(), LoopState::kArmed);
    for (int i = 0; i < 30 && supervisor.state() == LoopState::kArmed; ++i) step(kDeadman);
    ASSERT_EQ(supervisor.state(), LoopState::kActive);
  }
  void activate() {
    home();
    close_deadman();
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

}  // namespace trocar::test
