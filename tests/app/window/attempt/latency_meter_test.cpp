#include "app/window/attempt/latency_meter.h"

#include <gtest/gtest.h>

namespace trocar::latency_meter_test {
namespace {

TEST(LatencyMeter, AnEventIsShownByTheFirstPictureThatIncludesItsIntent) {
  LatencyMeter meter;
  meter.steered(1, 10.0);
  meter.drawn(0);
  meter.shown(10.1);
  EXPECT_TRUE(meter.sorted().empty()) << "that picture did not have it";
  meter.drawn(1);
  meter.steered(2, 10.15);
  meter.shown(10.2);
  ASSERT_EQ(meter.sorted().size(), 1u);
  EXPECT_NEAR(meter.sorted()[0], 0.2, 1e-12);
  meter.drawn(1);
  meter.shown(10.3);
  EXPECT_EQ(meter.sorted().size(), 1u) << "once";
  meter.drawn(5);
  meter.shown(10.4);
  ASSERT_EQ(meter.sorted().size(), 2u);
  EXPECT_NEAR(meter.sorted()[1], 0.25, 1e-12) << "sorted, longest last";
}

TEST(LatencyMeter, OnePictureMayShowSeveralAndANewAttemptForgets) {
  LatencyMeter meter;
  meter.steered(1, 0);
  meter.steered(2, 1);
  meter.drawn(7);
  meter.shown(3);
  EXPECT_EQ(meter.sorted(), (std::vector<double>{2, 3}));
  meter.steered(8, 4);
  meter.forget();
  meter.drawn(9);
  meter.shown(5);
  EXPECT_TRUE(meter.sorted().empty());
}

}  // namespace
}  // namespace trocar::latency_meter_test
