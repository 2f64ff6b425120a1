// Counts to angles, torques to DAC codes and back.
#include <gtest/gtest.h>

#include <limits>

#include "haptics/device/transmission.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::transmission_test {
namespace {

using test::Random;
using Counts = std::array<std::int32_t, kChannels>;

TEST(Transmission, OneCountIsFourHundredthsOfADegree) {
  const DeviceModel model;
  EXPECT_NEAR(count_size(model.transmission[0]), 7.226e-4, 5e-8);  // reference, four digits
  EXPECT_NEAR(count_size(model.transmission[0]) / kDegree, 0.0414, 5e-6);
  EXPECT_NEAR(count_size(model.transmission[kPinchChannel]), 0.008 * 2 * std::numbers::pi / 2000, 1e-18);
}

TEST(Transmission, FullScaleIs100MillinewtonmetresAtTheMotor) {
  const DeviceModel model;
  const Transmission& t = model.transmission[0];
  EXPECT_NEAR(max_joint_torque(t) * t.ratio, 0.100, 1e-4);  // 0.431 A/V is printed to three digits
  EXPECT_NEAR(max_joint_torque(t), 0.4345, 5e-4);
  const Transmission& pinch = model.transmission[kPinchChannel];
  EXPECT_NEAR(max_joint_torque(pinch), 0.080 / 0.008, 1e-12) << "the small motor is limited below full scale";
}

TEST(Transmission, CountersWrapAt32BitsWithoutAJump) {
  Random random(1);
  CountAccumulator accumulator;
  Counts counter;
  for (int i = 0; i < kChannels; ++i)
    counter[i] =
        i % 2 == 0 ? std::numeric_limits<std::int32_t>::max() - 50 : std::numeric_limits<std::int32_t>::min() + 50;
  accumulator.reset(counter);
  std::array<std::int64_t, kChannels> truth{};
  for (int k = 0; k < 2000; ++k) {
    for (int i = 0; i < kChannels; ++i) {
      const int step = (i % 2 == 0 ? 1 : -1) * random.below(40) + random.below(11) - 5;
      counter[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(counter[i]) + static_cast<std::uint32_t>(step));
      truth[i] += step;
    }
    const Counts delta = accumulator.advance(counter);
    for (int i = 0; i < kChannels; ++i) {
      ASSERT_EQ(accumulator.total()[i], truth[i]);
      ASSERT_LE(std::abs(delta[i]), 45);
    }
  }
  EXPECT_LT(counter[0], 0) << "channel 0 has wrapped";
  EXPECT_GT(counter[1], 0) << "channel 1 has wrapped";
}

TEST(Transmission, TotalsOutgrow32Bits) {
  CountAccumulator accumulator;
  std::uint32_t counter = 0;
  Counts counts{};
  accumulator.reset(counts);
  for (int k = 0; k < 10; ++k) {
    counter += 1u << 30;
    counts.fill(static_cast<std::int32_t>(counter));
    accumulator.advance(counts);
  }
  EXPECT_EQ(accumulator.total()[0], std::int64_t{10} << 30);
}

TEST(Transmission, ResetTakesTheCountersAsZero) {
  CountAccumulator accumulator;
  Counts counts;
  counts.fill(1234);
  accumulator.reset(counts);
  EXPECT_EQ(accumulator.total()[3], 0);
  counts[3] = 1230;
  EXPECT_EQ(accumulator.advance(counts)[3], -4);
  EXPECT_EQ(accumulator.total()[3], -4);
}

TEST(Transmission, PositionsAreHomePlusCounts) {
  const DeviceModel model;
  const ChannelVector home = ChannelVector::LinSpaced(0.1, 0.7);
  std::array<std::int64_t, kChannels> counts{};
  counts[2] = 1000;
  counts[6] = -2000;
  const ChannelVector q = joint_positions(model, counts, home);
  EXPECT_DOUBLE_EQ(q[0], home[0]);
  EXPECT_NEAR(q[2] - home[2], 0.23 * std::numbers::pi, 1e-12);        // half a motor turn
  EXPECT_NEAR(q[6] - home[6], -0.008 * 2 * std::numbers::pi, 1e-12);  // one turn back
}

TEST(Transmission, TorquesReturnFromCodesWithinHalfAStep) {
  Random random(2);
  const DeviceModel model;
  for (const int bits : {12, 14, 16}) {
    const double full = std::ldexp(1.0, bits - 1) - 1;
    for (int k = 0; k < 500; ++k) {
      ChannelVector torque;
      for (int i = 0; i < kChannels; ++i) torque[i] = random.symmetric(max_joint_torque(model.transmission[i]));
      const ChannelVector back = torques_of(model, dac_codes(model, torque, bits), bits);
      for (int i = 0; i < kChannels; ++i) {
        const Transmission& t = model.transmission[i];
        const double step = t.amps_per_volt * t.torque_constant / t.ratio * t.full_scale_v / full;
        EXPECT_LE(std::abs(back[i] - torque[i]), 0.5 * step * (1 + 1e-9)) << bits << " bits, channel " << i;
      }
    }
  }
}

TEST(Transmission, WhatIsNoNumberIsNoTorque) {
  ChannelVector torque = ChannelVector::Constant(0.1);
  torque[2] = std::numeric_limits<double>::quiet_NaN();
  torque[4] = std::numeric_limits<double>::infinity();
  const DacFrame frame = dac_codes({}, torque, 16);
  EXPECT_EQ(frame.codes[2], 0);
  EXPECT_EQ(frame.codes[4], 32767) << "infinity is clamped";
  EXPECT_GT(frame.codes[1], 0);
}

TEST(Transmission, CodesAreClampedAtFullScaleAndSymmetric) {
  const DeviceModel model;
  const ChannelVector huge = ChannelVector::Constant(1e6);
  for (const int bits : {12, 16}) {
    const std::int32_t full = (1 << (bits - 1)) - 1;
    for (int i = 0; i < kChannels; ++i) {
      EXPECT_EQ(dac_codes(model, huge, bits).codes[i], full);
      EXPECT_EQ(dac_codes(model, -huge, bits).codes[i], -full);
      EXPECT_EQ(dac_codes(model, ChannelVector::Zero(), bits).codes[i], 0);
    }
  }
}

}  // namespace
}  // namespace trocar::transmission_test
