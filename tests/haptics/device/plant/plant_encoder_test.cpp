// Counters of the plant: floor, wrap, and what a flawed encoder misses.
#include "haptics/device/plant/plant_encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/device/simulated_daq.h"

namespace trocar::plant_encoder_test {
namespace {

/// Output of joint 1 at a motor angle of so many counts.
double at_counts(const PlantParameters& p, double counts) {
  return counts / p.counts_per_turn * 2 * std::numbers::pi * p.channel[0].ratio;
}

ChannelVector first(double output) {
  ChannelVector all = ChannelVector::Zero();
  all[0] = output;
  return all;
}

/// Turns joint 1 by `counts` in steps of dt and back to where it was; counts lost on the way there, and at the end.
std::pair<std::int64_t, std::int64_t> there_and_back(const PlantParameters& p, int counts, int per_step, double dt,
                                                     std::uint64_t seed = 1) {
  PlantEncoders encoders(p, first(at_counts(p, 0.5)), seed);
  int at = 0;
  const auto go = [&](int to) {
    while (at != to) {
      at += std::clamp(to - at, -per_step, per_step);
      encoders.follow(first(at_counts(p, at + 0.5)), dt);
    }
  };
  go(counts);
  const std::int64_t lost = encoders.lost(0);
  EXPECT_EQ(encoders.count(0, at_counts(p, counts + 0.5)), counts - lost);
  go(0);
  return {lost, encoders.lost(0)};
}

TEST(PlantEncoders, CountsTheMotorsTurns) {
  PlantParameters p = nominal_parameters();
  PlantEncoders encoders(p, ChannelVector::Zero(), 1);
  EXPECT_FALSE(encoders.watched());
  EXPECT_EQ(encoders.count(0, at_counts(p, 1999.5)), 1999);
  EXPECT_EQ(encoders.count(0, at_counts(p, -0.5)), -1) << "floor, not truncation";
  p.channel[0].encoder_offset_counts = 2147483647.5;
  const PlantEncoders at_the_end(p, ChannelVector::Zero(), 1);
  EXPECT_EQ(at_the_end.count(0, at_counts(p, 1)), INT32_MIN) << "wraps";
}

TEST(PlantEncoders, TellsWhenTheLastEdgePassed) {
  const PlantParameters p = nominal_parameters();
  PlantEncoders encoders(p, first(at_counts(p, 0.5)), 1, true);
  EXPECT_TRUE(encoders.watched());
  EXPECT_EQ(encoders.edge_age_us(0), 65535) << "none yet";
  encoders.follow(first(at_counts(p, 2.25)), 50e-6);  // 2 passed 0.25 of 1.75 before the end
  EXPECT_EQ(encoders.edge_age_us(0), std::ceil(50 * 0.25 / 1.75));
  encoders.follow(first(at_counts(p, 2.75)), 50e-6);
  EXPECT_EQ(encoders.edge_age_us(0), std::ceil(50 + 50 * 0.25 / 1.75));
  encoders.follow(first(at_counts(p, 1.75)), 50e-6);  // and back over 2
  EXPECT_EQ(encoders.edge_age_us(0), std::ceil(50 * 0.25));
  EXPECT_EQ(encoders.edge_age_us(1), 65535);
  EXPECT_EQ(PlantEncoders(p, ChannelVector::Zero(), 1).edge_age_us(0), 0) << "not asked to";
}

TEST(PlantEncoders, AnUnevenDiscMovesItsEdgesEveryLineAlike) {
  PlantParameters p = nominal_parameters();
  p.options.encoder.uneven_counts = 0.1;
  const PlantEncoders encoders(p, ChannelVector::Zero(), 1);
  for (const int line : {-8, 0, 4, 4000}) {
    EXPECT_EQ(encoders.count(0, at_counts(p, line + 0.09)), line - 1) << "the first edge of a line comes late";
    EXPECT_EQ(encoders.count(0, at_counts(p, line + 0.11)), line);
    EXPECT_EQ(encoders.count(0, at_counts(p, line + 0.94)), line + 1) << "the second early";
    EXPECT_EQ(encoders.count(0, at_counts(p, line + 2.5)), line + 2);
  }
}

TEST(PlantEncoders, MissedEdgesAreAsManyAsTheirChanceSays) {
  PlantParameters p = nominal_parameters();
  p.options.encoder.missed_per_edge = 1e-3;
  constexpr int kEdges = 1000000;
  const auto [lost, back] = there_and_back(p, kEdges, 10, 50e-6);
  EXPECT_NEAR(static_cast<double>(lost), 1e-3 * kEdges, 4 * std::sqrt(1e-3 * kEdges)) << "four standard deviations";
  // The way back misses as many in the other sense: the counter walks, it does not run away.
  EXPECT_LT(std::abs(back), 4 * std::sqrt(2e-3 * kEdges));
  EXPECT_NE(back, 0);
}

TEST(PlantEncoders, ASeedMissesTheSameEdges) {
  PlantParameters p = nominal_parameters();
  p.options.encoder.missed_per_edge = 0.01;
  EXPECT_EQ(there_and_back(p, 5000, 3, 50e-6, 7), there_and_back(p, 5000, 3, 50e-6, 7));
  EXPECT_NE(there_and_back(p, 5000, 3, 50e-6, 7), there_and_back(p, 5000, 3, 50e-6, 8));
}

TEST(PlantEncoders, LinesBeyondTheLimitAreLost) {
  PlantParameters p = nominal_parameters();
  p.options.encoder.limit_hz = 100e3;  // 20 edges in 50 us
  EXPECT_EQ(there_and_back(p, 20000, 20, 50e-6).first, 0) << "at the limit";
  const auto lost = static_cast<double>(there_and_back(p, 30000, 30, 50e-6).first);
  EXPECT_NEAR(lost, 10000, 2) << "a third of the edges at one and a half times the limit";
}

TEST(PlantEncoders, TheMotorAloneNeverReachesTheLimit) {
  // 9660 rpm on 500 lines: 80.5 kHz.
  EXPECT_LT(9660.0 / 60 * 500, 100e3);
}

TEST(PlantEncoders, ADeviceWithMissedCountsDriftsAndSaysSo) {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  config.plant->options.encoder.missed_per_edge = 0.02;
  config.hand.tremor_m = 0;
  SimulatedDaq daq(config);
  daq.arm(true);
  for (int k = 0; k < 100; ++k) daq.read();
  Pose goal = daq.sense().X_BS;
  DaqSample sample;
  for (int k = 0; k < 3000; ++k) {
    Pose now = goal;
    now.p.x() += 0.05 * std::sin(2 * std::numbers::pi * k / 500.0);
    now.p.z() += 0.02;
    daq.set_hand_intent(now, 0.02);
    sample = daq.read();
  }
  const PlantParameters& p = daq.plant().parameters();
  const ChannelVector outputs = daq.plant().outputs();
  std::int64_t lost = 0;
  for (int i = 0; i < kArmJoints; ++i) {
    const double turns = outputs[i] / p.channel[i].ratio / (2 * std::numbers::pi);
    const auto whole = static_cast<std::int64_t>(std::floor(turns * p.counts_per_turn));
    EXPECT_EQ(sample.counts[i], whole - daq.counts_lost(i)) << "joint " << i + 1;
    lost += std::abs(daq.counts_lost(i));
  }
  EXPECT_GT(lost, 0);
}

}  // namespace
}  // namespace trocar::plant_encoder_test
