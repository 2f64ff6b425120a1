// Thresholds and holds at their limits.
#include <gtest/gtest.h>

#include "scenarios/director/threshold_monitor.h"

namespace trocar::monitor_limits_test {
namespace {

TEST(ThresholdLimits, FiresAboveAndNotAtTheLevel) {
  ThresholdMonitor monitor(1.5, 1.2, 0.2);
  EXPECT_FALSE(monitor.update(1.5, 0.01));
  EXPECT_FALSE(monitor.above());
  EXPECT_TRUE(monitor.update(1.5001, 0.01));
  EXPECT_TRUE(monitor.above());
  EXPECT_FALSE(monitor.update(5, 0.01)) << "once an entry";
}

TEST(ThresholdLimits, RearmsOnlyAfterTheWholeTimeBelowWithoutABreak) {
  ThresholdMonitor monitor(1.5, 1.2, 0.2);
  monitor.update(2, 0.05);
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < 3; ++k) monitor.update(1.0, 0.05);
    monitor.update(1.3, 0.05);  // between both levels: the time begins anew
    ASSERT_TRUE(monitor.above());
  }
  for (int k = 0; k < 5; ++k) monitor.update(1.0, 0.05);
  EXPECT_FALSE(monitor.above());
  EXPECT_TRUE(monitor.update(2, 0.05));
}

TEST(ThresholdLimits, ATremblingForceCountsOnce) {
  ThresholdMonitor monitor(1.5, 1.2, 0.2);
  int fired = 0;
  for (int i = 0; i < 500; ++i) fired += monitor.update(i % 10 < 5 ? 1.6 : 1.0, 0.01) ? 1 : 0;
  EXPECT_EQ(fired, 1) << "0.05 s below are not 0.2 s";
}

TEST(HoldLimits, AShortExcursionPausesAndALongOneStartsAgain) {
  HoldTimer timer(1.0, 0.1);
  for (int i = 0; i < 50; ++i) timer.update(true, 0.01);
  for (int i = 0; i < 9; ++i) timer.update(false, 0.01);
  EXPECT_NEAR(timer.progress(), 0.5, 1e-9);
  for (int i = 0; i < 3; ++i) timer.update(false, 0.01);
  EXPECT_EQ(timer.progress(), 0);
}

TEST(HoldLimits, ForgivenTimeComesBackAtAFifthOfTheTimeInside) {
  for (const double inside_s : {0.30, 0.45}) {
    HoldTimer timer(2.0, 0.1);
    for (int i = 0; i < 50; ++i) timer.update(true, 0.01);
    for (int i = 0; i < 9; ++i) timer.update(false, 0.01);
    for (int i = 0; i < inside_s * 100 - 0.5; ++i) timer.update(true, 0.01);
    for (int i = 0; i < 9; ++i) timer.update(false, 0.01);
    // 90 ms used, 60 or 90 ms given back, 90 ms asked for again: 120 ms are too many.
    EXPECT_EQ(timer.progress() > 0, inside_s > 0.4) << inside_s;
  }
}

TEST(HoldLimits, ProgressStopsAtTheWholeAndStaysComplete) {
  HoldTimer timer(0.5, 0.1);
  bool complete = false;
  for (int i = 0; i < 80; ++i) complete = timer.update(true, 0.01);
  EXPECT_TRUE(complete);
  EXPECT_DOUBLE_EQ(timer.progress(), 1);
}

}  // namespace
}  // namespace trocar::monitor_limits_test
