// The force sensor task: compares with what was delivered when the measured force acted.
#include "app/session/lanes/force_sensor_task.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/force_sensor/simulated_force_sensor.h"

namespace trocar::force_sensor_task_test {
namespace {

TEST(VectorSpread, KnowsRootMeanSquareAndLargest) {
  VectorSpread spread;
  EXPECT_EQ(spread.rms(), 0);
  spread.add(Vec3(3, 0, 0));
  spread.add(Vec3(0, 0, -4));
  EXPECT_DOUBLE_EQ(spread.rms(), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(spread.largest(), 4);
  EXPECT_EQ(spread.count(), 2u);
}

TEST(ForceSensorTask, RunsAtItsRateWhateverTheLoops) {
  DelayedChannel<StylusForces> forces(0);
  SimulatedForceSensor sensor({}, 1);
  EXPECT_EQ(ForceSensorTask(forces, sensor, 1000).period(), 25u);
  EXPECT_EQ(ForceSensorTask(forces, sensor, 4000).period(), 100u);
}

TEST(ForceSensorTask, AForceThatArrivesAsDeliveredLeavesNoResidualHoweverLate) {
  ForceSensorConfig config;
  config.noise_n = config.drift_n_per_h = 0;
  DelayedChannel<StylusForces> forces(0);
  SimulatedForceSensor sensor(config, 1);
  ForceSensorTask task(forces, sensor, 1000);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Vec3 force(std::sin(0.3 * static_cast<double>(i)), 1, 0);
    forces.write(25 * i, {force, force});
    task.run(25 * i);
  }
  EXPECT_EQ(task.residual().count(), 194u);
  EXPECT_EQ(task.residual().largest(), 0) << "both are as old";
  EXPECT_GT(task.measured().rms(), 1);
}

TEST(ForceSensorTask, WhatIsMissingOnTheWayIsTheResidual) {
  ForceSensorConfig config;
  config.drift_n_per_h = 0;
  DelayedChannel<StylusForces> forces(0);
  SimulatedForceSensor sensor(config, 1);
  ForceSensorTask task(forces, sensor, 1000);
  for (std::uint64_t i = 0; i < 4006; ++i) {
    const Vec3 delivered(0, 0, i % 2 == 0 ? 1 : 0);  // every other sample nothing is delivered: not compared
    forces.write(25 * i, {delivered + Vec3(0.03, 0, 0), delivered});
    task.run(25 * i);
  }
  EXPECT_EQ(task.residual().count(), 2000u);
  // 30 mN of friction and 20 mN of noise on each axis; four standard errors of an RMS of 2000 samples are under 2 mN.
  EXPECT_NEAR(task.residual().rms(), std::sqrt(0.03 * 0.03 + 3 * 0.02 * 0.02), 2e-3);
}

}  // namespace
}  // namespace trocar::force_sensor_task_test
