// Faults of every kind through the real drivers: how fast the torque goes, on every back-end; and that a board whose
// answer is too slow is found out.
#include "app/device_bench/fault_trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/backends/simulated_board.h"

namespace trocar::fault_trials_test {
namespace {

class FaultTrials : public testing::TestWithParam<std::string> {};

TEST_P(FaultTrials, TorqueGoesInTimeAndTheFirstCauseStays) {
  const std::vector<FaultTrial> trials = try_faults(GetParam(), {});
  std::set<std::string> names;
  for (const FaultTrial& t : trials) {
    EXPECT_EQ(t.failure, "") << t.fault;
    EXPECT_LE(t.off_ticks, t.limit_ticks) << t.fault;
    names.insert(t.fault);
    std::printf("%-16s %-20s %-9s %-16s seen %5d, zero torque %5d of %5d ticks\n", GetParam().c_str(), t.fault.c_str(),
                t.reaction.c_str(), t.cause.c_str(), t.seen_ticks, t.off_ticks, t.limit_ticks);
  }
  EXPECT_EQ(names.size(), trials.size()) << "one line a fault";
  for (const char* asked :
       {"encoder-jump", "encoder-stuck", "dead-channel", "sensor-silent", "patch-not-a-number", "stale-patch",
        "late-loop", "overspeed", "overheat", "emergency-stop", "deadman-open", "watchdog", "drive-fault", "drive-hot"})
    EXPECT_TRUE(names.contains(asked)) << asked;
  if (GetParam() != kSimulatedBackend) {
    EXPECT_TRUE(names.contains("board-gone"));
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, FaultTrials, testing::ValuesIn(simulated_board_names()), [](const auto& backend) {
  std::string name = backend.param;
  std::erase(name, '-');
  return name;
});

TEST(FaultTrial, AWatchdogThatSleepsTooLongIsFoundOut) {
  SimulatedDaqConfig slow;
  slow.watchdog_s = 0.1;
  const std::vector<FaultTrial> trials = try_faults(kSimulatedBackend, slow);
  for (const FaultTrial& t : trials) EXPECT_EQ(t.failure.empty(), t.fault != "watchdog") << t.fault << t.failure;
}

}  // namespace
}  // namespace trocar::fault_trials_test
