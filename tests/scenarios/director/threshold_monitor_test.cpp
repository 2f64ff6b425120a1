// Thresholds that fire once or repeat, and holds that forgive little.
#include "scenarios/director/threshold_monitor.h"

#include <gtest/gtest.h>

namespace trocar::threshold_monitor_test {
namespace {

TEST(HoldTimer, TappingInAndOutNeverCompletesAHold) {
  HoldTimer timer(1.0, 0.1);
  for (int i = 0; i < 12000; ++i) ASSERT_FALSE(timer.update(i % 12 == 0, 0.01)) << "10 ms inside of every 120 ms";
}

TEST(ThresholdMonitor, RepeatsForEachFurtherTimeAbove) {
  ThresholdMonitor monitor(1.5, 1.2, 0.2, 1.0);
  int fired = 0;
  for (int i = 0; i < 350; ++i) fired += monitor.update(2.0, 0.01) ? 1 : 0;
  EXPECT_EQ(fired, 4) << "on entry, and after each of three seconds";
}

TEST(HoldTimer, ReportsItsProgress) {
  HoldTimer timer(1.0, 0.1);
  EXPECT_FALSE(timer.update(true, 0.5));
  EXPECT_DOUBLE_EQ(timer.progress(), 0.5);
  EXPECT_TRUE(timer.update(true, 0.5));
  timer.reset();
  EXPECT_DOUBLE_EQ(timer.progress(), 0);
}

}  // namespace
}  // namespace trocar::threshold_monitor_test
