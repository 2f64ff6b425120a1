// Jitter between write and DAC: late by 0 to n periods, never out of order, nothing lost.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "haptics/device/simulated_daq.h"

namespace trocar::plant_jitter_test {
namespace {

SimulatedDaqConfig jittery(int most, int extra = 0, std::uint64_t seed = 1) {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  config.plant->options.jitter_periods = most;
  config.extra_delay_periods = extra;
  config.seed = seed;
  return config;
}

/// Writes 1, 2, 3, ... and lists what acts after each SYNC.
std::vector<int> in_force(const SimulatedDaqConfig& config, int periods) {
  SimulatedDaq daq(config);
  daq.arm(true);
  std::vector<int> codes;
  for (int k = 1; k <= periods; ++k) {
    DacFrame frame;
    frame.codes.fill(k);
    daq.write(frame);
    daq.read();
    codes.push_back(daq.codes_in_force().codes[0]);
  }
  return codes;
}

TEST(PlantJitter, WithoutItEveryCodeActsOneSyncAfterTheOther) {
  const std::vector<int> codes = in_force(jittery(0), 50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(codes[static_cast<std::size_t>(k)], k + 1);
}

TEST(PlantJitter, CodesComeLateByAtMostSoManyPeriodsAndNeverOutOfOrder) {
  for (const int extra : {0, 3}) {
    const std::vector<int> codes = in_force(jittery(2, extra), 5000);
    std::array<int, 3> late{};
    int last = 0;
    for (int k = 10; k < 5000; ++k) {
      const int code = codes[static_cast<std::size_t>(k)], by = k + 1 - code - extra;
      ASSERT_GE(by, 0);
      ASSERT_LE(by, 2);
      ASSERT_GE(code, last) << "an older code after a newer one";
      last = code;
      ++late[static_cast<std::size_t>(by)];
    }
    // Uniform draws, of which the newest arrival counts: d = min(draw, last d + 1). Stationary shares 1/3, 4/9, 2/9.
    EXPECT_NEAR(late[0] / 4990.0, 1.0 / 3, 0.03);
    EXPECT_NEAR(late[1] / 4990.0, 4.0 / 9, 0.03);
    EXPECT_NEAR(late[2] / 4990.0, 2.0 / 9, 0.03);
  }
}

TEST(PlantJitter, EveryCodeReachesTheDac) {
  // What has not acted itself has come together with a newer one: at rest the last code acts.
  SimulatedDaq daq(jittery(2));
  daq.arm(true);
  for (int k = 1; k <= 1000; ++k) {
    DacFrame frame;
    frame.codes.fill(k);
    for (int held = 0; held < 3; ++held) {
      daq.write(frame);
      daq.read();
    }
    EXPECT_EQ(daq.codes_in_force().codes[3], k) << "a code that is held for as long as the jitter lasts must act";
  }
}

TEST(PlantJitter, ASeedIsLateInTheSameWay) {
  EXPECT_EQ(in_force(jittery(2, 0, 5), 300), in_force(jittery(2, 0, 5), 300));
  EXPECT_NE(in_force(jittery(2, 0, 5), 300), in_force(jittery(2, 0, 6), 300));
}

TEST(PlantJitter, WhatIsWrittenBeforeDisarmingIsForgotten) {
  SimulatedDaq daq(jittery(3));
  daq.arm(true);
  DacFrame frame;
  frame.codes.fill(99);
  for (int k = 0; k < 10; ++k) {
    daq.write(frame);
    daq.read();
  }
  daq.arm(false);
  for (int k = 0; k < 10; ++k) {
    daq.read();
    EXPECT_EQ(daq.codes_in_force().codes[0], 0);
  }
}

TEST(PlantJitter, TooMuchIsRefused) {
  EXPECT_THROW(SimulatedDaq(jittery(64)), std::invalid_argument);
  EXPECT_THROW(SimulatedDaq(jittery(-1)), std::invalid_argument);
  EXPECT_THROW(SimulatedDaq(jittery(10, 60)), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::plant_jitter_test
