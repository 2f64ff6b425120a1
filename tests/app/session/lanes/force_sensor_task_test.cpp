// The force sensor task: compares with what was delivered when the measured force acted.
#include "app/session/lanes/force_sensor_task.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "haptics/force_sensor/simulated_force_sensor.h"
#include "haptics/kinematics/inverse_kinematics.h"

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

/// A real sensor without lag: says what it is told, in its own axes.
class ToldSensor final : public ForceSensor {
 public:
  ForceSample sample(const Vec3&) override {
    return {.number = ++number_, .force = told.force, .valid = true, .moment_nm = told.moment};
  }
  const ForceSensorConfig& config() const override { return config_; }
  std::size_t delay() const override { return 0; }
  Wrench told;

 private:
  ForceSensorConfig config_;
  std::uint64_t number_ = 0;
};

SensorMount mount() {
  SensorMount out;
  out.rpy_rad = Vec3(0.3, -0.7, 1.9);
  out.fixture_kg = 0.08;
  out.fixture_com_F = Vec3(0.002, 0, -0.02);
  return out;
}

/// Joints that turn the stylus about all axes.
JointVector joints(int k) {
  JointVector q = home_angles();
  for (int i = 0; i < kArmJoints; ++i) q[i] += 0.3 * std::sin(0.4 * k + i);
  return q;
}

/// What a sensor reads whose body the hand holds. @param on_hand_T of the device.
Wrench reads(const SensorMount& sits, const JointVector& q, const Mat3& R_TW, const Vec3& on_hand_T) {
  const Mat3 R_WF = arm_state(q).X_WS.R * sits.R_SF();
  const Vec3 weight_F = R_WF.transpose() * Vec3(0, 0, -9.81 * sits.fixture_kg);
  const double sign = sits.body_on_device ? -1 : 1;
  return {sign * ((R_TW * R_WF).transpose() * on_hand_T) + weight_F + Vec3(3, -8, 20),  // and its own zero
          sits.fixture_com_F.cross(weight_F) + Vec3(0.1, 0, -0.2)};
}

const Mat3 kTheatre = Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();

/// Ten samples in the jig, then so many of contact in ever other poses.
void run_attempt_of(ForceSensorTask& task, ToldSensor& sensor, DelayedChannel<StylusForces>& forces,
                    const SensorMount& sits, int contact = 100) {
  std::uint64_t tick = 0;
  const auto sample = [&](const JointVector& q, LoopState loop, const Vec3& force_T) {
    sensor.told = reads(sits, q, kTheatre, force_T);
    forces.write(tick, {Vec3::Zero(), force_T, q, loop});
    task.run(tick);
    tick += 25;
  };
  for (int k = 0; k < 4; ++k) sample(JointVector::Zero(), LoopState::kUnhomed, Vec3::Zero());
  for (int k = 0; k < 10; ++k) sample(home_angles(), k < 8 ? LoopState::kHomed : LoopState::kArmed, Vec3::Zero());
  for (int k = 0; k < contact; ++k) sample(joints(k), LoopState::kActive, Vec3(0.5, std::sin(0.1 * k), -1));
}

TEST(ForceSensorTask, ARealOneIsFreedOfZeroAndFixtureAndTurnedIntoTheTheatreHoweverTheStylusTurns) {
  for (const bool body_on_device : {false, true}) {
    SensorMount sits = mount();
    sits.body_on_device = body_on_device;
    DelayedChannel<StylusForces> forces(0);
    ToldSensor sensor;
    ForceSensorTask task(forces, sensor, 1000, RealSensorPlace{sits, kTheatre});
    run_attempt_of(task, sensor, forces, sits);
    EXPECT_EQ(task.samples(), 114u);
    EXPECT_EQ(task.zero_samples(), 10u);
    EXPECT_EQ(task.residual().count(), 100u);
    EXPECT_LT(task.residual().largest(), 1e-9) << "one frame, one zero, no weight";
    EXPECT_LT(task.measured_moment().largest(), 1e-9);
    ASSERT_TRUE(task.zero());
    EXPECT_LT((task.zero()->force - Vec3(3, -8, 20)).norm(), 1e-9) << "without the weight in the jig";
  }
}

TEST(ForceSensorTask, ARealOneWhoseAxesNobodyToldIsMeasuredAndComparedWithNothing) {
  for (const std::optional<SensorMount>& told : {std::optional<SensorMount>(), std::optional<SensorMount>({})}) {
    DelayedChannel<StylusForces> forces(0);
    ToldSensor sensor;
    ForceSensorTask task(forces, sensor, 1000, RealSensorPlace{told, kTheatre});
    run_attempt_of(task, sensor, forces, mount());
    EXPECT_FALSE(task.compares());
    EXPECT_EQ(task.residual().count(), 0u);
    EXPECT_EQ(task.measured().count(), 100u);
  }
}

TEST(ForceSensorTask, ARealOneWithoutAZeroMeasuresNothing) {
  DelayedChannel<StylusForces> forces(0);
  ToldSensor sensor;
  ForceSensorTask task(forces, sensor, 1000, RealSensorPlace{mount(), kTheatre});
  for (std::uint64_t k = 0; k < 50; ++k) {
    forces.write(25 * k, {Vec3::Zero(), Vec3::UnitX(), home_angles(), LoopState::kActive});
    task.run(25 * k);
  }
  EXPECT_EQ(task.samples(), 50u);
  EXPECT_FALSE(task.zero());
  EXPECT_EQ(task.measured().count() + task.residual().count(), 0u);
}

}  // namespace
}  // namespace trocar::force_sensor_task_test
