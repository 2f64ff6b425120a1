// The simulated force/torque sensor: lag, the fixture's weight and lever, noise of both, refusals.
#include "haptics/force_sensor/simulated_wrench_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trocar::wrench_sensor_test {
namespace {

WrenchSensorConfig quiet() {
  WrenchSensorConfig c;
  c.force.noise_n = c.force.drift_n_per_h = c.noise_nm = c.drift_nm_per_h = 0;
  return c;
}

TEST(SimulatedWrenchSensor, ReadsForceAndMomentInStylusAxesAfterItsLag) {
  SimulatedWrenchSensor sensor(quiet(), 1);
  const Mat3 R(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (int i = 1; i <= 20; ++i) {
    const WrenchSample s = sensor.sample(R, {Vec3(i, 0, 0), Vec3(0, 0.1 * i, 0)});
    EXPECT_EQ(s.valid, i > 6) << "0.15 s at 40 Hz";
    if (!s.valid) continue;
    EXPECT_LT((s.read.force - R.transpose() * Vec3(i - 6, 0, 0)).norm(), 1e-12);
    EXPECT_LT((s.read.moment - R.transpose() * Vec3(0, 0.1 * (i - 6), 0)).norm(), 1e-12);
  }
}

TEST(SimulatedWrenchSensor, TheFixtureHangsDownWhateverWayTheStylusIsHeld) {
  WrenchSensorConfig config = quiet();
  config.fixture_kg = 0.08;
  config.fixture_com = {0, 0, 0.03};
  SimulatedWrenchSensor sensor(config, 1);
  const double weight = 0.08 * 9.81;
  // X6 up: the weight along -X6 as in figure 3.49, its lever of 30 mm along Z6 turns about -Y6.
  const Mat3 x_up = (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished();
  WrenchSample s;
  for (int i = 0; i < 7; ++i) s = sensor.sample(x_up, {});
  EXPECT_LT((s.read.force - Vec3(-weight, 0, 0)).norm(), 1e-12);
  EXPECT_LT((s.read.moment - Vec3(0, -0.03 * weight, 0)).norm(), 1e-12);
}

TEST(SimulatedWrenchSensor, TakesTheFixtureOffAsItHungThen) {
  WrenchSensorConfig config = quiet();
  config.fixture_kg = 0.1;
  config.fixture_com = {0.01, -0.02, 0.03};
  SimulatedWrenchSensor sensor(config, 1);
  const Wrench truth{{0.4, -0.2, 0.7}, {0.01, 0.02, -0.03}};
  std::vector<Mat3> turned;
  for (int i = 0; i < 40; ++i) {
    turned.emplace_back(Eigen::AngleAxisd(0.2 * i, Vec3(1, -1, 2).normalized()));
    const WrenchSample s = sensor.sample(turned.back(), truth);
    if (!s.valid) continue;
    const Mat3 then = turned[static_cast<std::size_t>(i) - sensor.delay()].transpose();
    EXPECT_LT((s.without_fixture.force - then * truth.force).norm(), 1e-12);
    EXPECT_LT((s.without_fixture.moment - then * truth.moment).norm(), 1e-12);
  }
}

TEST(SimulatedWrenchSensor, NoiseAndDriftAreThoseOfTheReference) {
  SimulatedWrenchSensor sensor({}, 7);
  constexpr int kSamples = 4000;  // 100 s: a drift of 3 mN and 0.07 mN m
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (int i = 0; i < kSamples + 6; ++i) {
    const WrenchSample s = sensor.sample(Mat3::Identity(), {});
    if (!s.valid) continue;
    force += s.read.force.cwiseAbs2();
    moment += s.read.moment.cwiseAbs2();
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(force[axis] / kSamples), 0.020, 4 * 0.020 / std::sqrt(2.0 * kSamples) + 2e-4);
    EXPECT_NEAR(std::sqrt(moment[axis] / kSamples), 0.5e-3, 4 * 0.5e-3 / std::sqrt(2.0 * kSamples) + 5e-6);
  }
}

TEST(SimulatedWrenchSensor, NonsenseIsRefused) {
  for (const auto& spoil :
       {+[](WrenchSensorConfig& c) { c.force.rate_hz = 0; }, +[](WrenchSensorConfig& c) { c.noise_nm = NAN; },
        +[](WrenchSensorConfig& c) { c.fixture_kg = -1; },
        +[](WrenchSensorConfig& c) { c.fixture_com[0] = INFINITY; }}) {
    WrenchSensorConfig config;
    spoil(config);
    EXPECT_THROW(SimulatedWrenchSensor(config, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace trocar::wrench_sensor_test
