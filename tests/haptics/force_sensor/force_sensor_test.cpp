// The simulated force sensor: delay, noise, drift, refusals.
#include "haptics/force_sensor/simulated_force_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trocar::force_sensor_test {
namespace {

ForceSensorConfig quiet() {
  ForceSensorConfig config;
  config.noise_n = config.drift_n_per_h = 0;
  return config;
}

TEST(SimulatedForceSensor, ShowsAForceAfterItsLag) {
  SimulatedForceSensor sensor(quiet(), 1);
  EXPECT_EQ(sensor.delay(), 6u) << "0.15 s at 40 Hz";
  for (int i = 1; i <= 40; ++i) {
    const ForceSample sample = sensor.sample(Vec3(i, 0, -i));
    EXPECT_EQ(sample.number, static_cast<std::uint64_t>(i));
    EXPECT_EQ(sample.valid, i > 6);
    if (!sample.valid) continue;
    EXPECT_EQ(sample.force, Vec3(i - 6, 0, -(i - 6)));
  }
}

TEST(SimulatedForceSensor, WithoutLagItShowsTheForceOfNow) {
  ForceSensorConfig config = quiet();
  config.lag_s = 0;
  SimulatedForceSensor sensor(config, 1);
  const ForceSample sample = sensor.sample(Vec3(1, 2, 3));
  EXPECT_TRUE(sample.valid);
  EXPECT_EQ(sample.force, Vec3(1, 2, 3));
}

TEST(SimulatedForceSensor, NoiseHasItsSizeOnEachAxis) {
  ForceSensorConfig config;
  config.drift_n_per_h = 0;
  SimulatedForceSensor sensor(config, 7);
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples + 6; ++i) {
    const ForceSample sample = sensor.sample(Vec3::Zero());
    if (!sample.valid) continue;
    sum += sample.force;
    squares += sample.force.cwiseAbs2();
  }
  for (int axis = 0; axis < 3; ++axis) {
    // Four standard errors: of the mean sd/sqrt(n), of the SD sd/sqrt(2n).
    EXPECT_NEAR(sum[axis] / kSamples, 0, 4 * 0.020 / std::sqrt(kSamples));
    EXPECT_NEAR(std::sqrt(squares[axis] / kSamples), 0.020, 4 * 0.020 / std::sqrt(2.0 * kSamples));
  }
}

TEST(SimulatedForceSensor, TheZeroDriftsByItsRate) {
  ForceSensorConfig config = quiet();
  config.drift_n_per_h = 3.6;
  SimulatedForceSensor sensor(config, 2);
  ForceSample sample;
  for (int i = 0; i < 4000; ++i) sample = sensor.sample(Vec3::Zero());
  EXPECT_NEAR(sample.force.norm(), 0.1, 1e-9) << "100 s of 3.6 N an hour";
}

TEST(SimulatedForceSensor, ASeedMeansTheSameNoise) {
  SimulatedForceSensor a({}, 5), b({}, 5), c({}, 6);
  double differs = 0;
  for (int i = 0; i < 50; ++i) {
    const Vec3 force = a.sample(Vec3::Ones()).force;
    EXPECT_EQ(force, b.sample(Vec3::Ones()).force);
    differs += (force - c.sample(Vec3::Ones()).force).norm();
  }
  EXPECT_GT(differs, 0.1);
}

TEST(SimulatedForceSensor, NonsenseIsRefused) {
  for (const auto& spoil : {+[](ForceSensorConfig& c) { c.rate_hz = 0; }, +[](ForceSensorConfig& c) { c.lag_s = -1; },
                            +[](ForceSensorConfig& c) { c.lag_s = 11; }, +[](ForceSensorConfig& c) { c.noise_n = NAN; },
                            +[](ForceSensorConfig& c) { c.drift_n_per_h = INFINITY; }}) {
    ForceSensorConfig config;
    spoil(config);
    EXPECT_THROW(SimulatedForceSensor(config, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace trocar::force_sensor_test
