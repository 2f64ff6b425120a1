// The force sensor task: compares with what was delivered when the measured force acted.
#include "app/session/lanes/force_sensor_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "haptics/device/transmission.h"
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

/// A real sensor that says what it is told, in its own axes, so many samples late.
class ToldSensor final : public ForceSensor {
 public:
  explicit ToldSensor(std::size_t delay = 0, double rate_hz = 40) : line_(delay + 1) { config_.rate_hz = rate_hz; }
  ForceSample sample(const Vec3&) override {
    line_[number_ % line_.size()] = told;
    const Wrench& then = line_[++number_ % line_.size()];
    return {.number = number_, .force = then.force, .valid = number_ >= line_.size(), .moment_nm = then.moment};
  }
  const ForceSensorConfig& config() const override { return config_; }
  std::size_t delay() const override { return line_.size() - 1; }
  Wrench told;

 private:
  ForceSensorConfig config_;
  std::vector<Wrench> line_;
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

/// What a sensor reads. @param on_hand_T of the device. @param a_W of the fixture's centre of mass.
Wrench reads(const SensorMount& sits, const JointVector& q, const Mat3& R_TW, const Vec3& on_hand_T,
             const Vec3& a_W = Vec3::Zero()) {
  const Mat3 R_WF = arm_state(q).X_WS.R * sits.R_SF();
  const Vec3 hung_F = R_WF.transpose() * (sits.fixture_kg * (Vec3(0, 0, -9.81) - a_W));
  const double sign = sits.body_on_device ? -1 : 1;
  return {sign * ((R_TW * R_WF).transpose() * on_hand_T) + hung_F + Vec3(3, -8, 20),  // and its own zero
          sits.fixture_com_F.cross(hung_F) + Vec3(0.1, 0, -0.2)};
}

const Mat3 kTheatre = Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();

/// Ten samples in the jig, then so many of contact in ever other poses, between which no period passes: nothing
/// accelerates.
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
    EXPECT_EQ(task.residual().count(), 98u) << "two wait for the pose after them";
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

/// A hand that swings the stylus, and the sensor that sees it.
struct Swing {
  double rate_hz = 40;
  std::size_t delay = 6;
  bool body_on_device = false;
  bool counted = true;    ///< q in whole counts of the encoders
  bool steady = true;     ///< else every fifth wake of the task is missed
  double size_rad = 0.1;  ///< of each joint, at 0.7 to 2 Hz
};

/// Still in the jig, swinging after 0.
JointVector swung(const Swing& swing, double t) {
  constexpr double kHz[] = {1, 0.8, 0.7, 1.1, 1.5, 2};
  JointVector q = home_angles();
  if (t <= 0) return q;
  for (int i = 0; i < kArmJoints; ++i)
    q[i] += swing.size_rad * (1 - std::exp(-t * t * t)) * std::sin(2 * std::numbers::pi * kHz[i] * t + i);
  return q;
}

JointVector in_counts(const JointVector& q) {
  const double size = count_size(Transmission{});
  return home_angles() + JointVector(((q - home_angles()) / size).array().floor() * size);
}

Vec3 acceleration(const SensorMount& sits, const Swing& swing, double t) {
  constexpr double kStep_s = 1e-4;
  const auto p = [&](double at) { return arm_state(swung(swing, at)).X_WS * (sits.R_SF() * sits.fixture_com_F); };
  return (p(t + kStep_s) - 2 * p(t) + p(t - kStep_s)) / (kStep_s * kStep_s);
}

/// What the task leaves of a known force, and the inertia that was on it.
struct Freed {
  VectorSpread residual, moment, inertia, inertia_moment;
};

Freed freed(const Swing& swing) {
  SensorMount sits = mount();
  sits.body_on_device = swing.body_on_device;
  DelayedChannel<StylusForces> forces(0);
  ToldSensor sensor(swing.delay, swing.rate_hz);
  ForceSensorTask task(forces, sensor, 1000, RealSensorPlace{sits, kTheatre});
  Freed out;
  for (std::uint64_t tick = 0, wake = 0; tick < 10000; tick += task.period(), ++wake) {
    if (!swing.steady && wake % 5 == 0) continue;
    const double t = 1e-3 * static_cast<double>(tick) - 1;
    const LoopState loop = t < -0.7 ? LoopState::kUnhomed : t < 0 ? LoopState::kHomed : LoopState::kActive;
    const Vec3 force_T = t < 0 ? Vec3(0, 0, 0) : Vec3(0.5, std::sin(2 * t), -1);
    const JointVector q = swung(swing, t);
    const Vec3 a_W = acceleration(sits, swing, t);
    sensor.told = reads(sits, q, kTheatre, force_T, a_W);
    forces.write(tick, {Vec3::Zero(), force_T, swing.counted ? in_counts(q) : q, loop, tick});
    task.run(tick);
    if (t < 0) continue;
    out.inertia.add(sits.fixture_kg * a_W);
    out.inertia_moment.add(sits.fixture_com_F.cross(reads(sits, q, kTheatre, Vec3::Zero(), a_W).force -
                                                    reads(sits, q, kTheatre, Vec3::Zero()).force));
  }
  out.residual = task.residual(), out.moment = task.measured_moment();
  return out;
}

TEST(ForceSensorTask, ARealOneIsFreedOfTheFixturesInertiaToAboutWhatTheEncodersCount) {
  for (const Swing& swing : {Swing{}, Swing{.delay = 0}, Swing{.body_on_device = true},
                             Swing{.rate_hz = 250, .delay = 38}, Swing{.rate_hz = 250, .delay = 1}}) {
    const Freed it = freed(swing);
    EXPECT_GT(it.residual.count(), 350u);
    EXPECT_GT(it.inertia.rms(), 0.09) << "N, what stayed otherwise";
    EXPECT_LT(it.residual.rms(), 0.012);
    EXPECT_LT(it.residual.largest(), 0.04);
    EXPECT_LT(it.moment.rms(), 0.2 * it.inertia_moment.rms());
  }
}

TEST(ForceSensorTask, ByPosesThatAreNotCountedAFiftiethOfTheInertiaStays) {
  const Freed it = freed({.counted = false});
  EXPECT_LT(it.residual.rms(), 0.02 * it.inertia.rms());
  EXPECT_LT(it.moment.rms(), 0.02 * it.inertia_moment.rms());
}

TEST(ForceSensorTask, InertiaGoesByThePeriodsThatPassedWhereWakesAreMissed) {
  const Freed it = freed({.steady = false});
  EXPECT_LT(it.residual.rms(), 0.012);
}

TEST(ForceSensorTask, AStillArmHasNoInertiaNorTheOneThatWasJustHomed) {
  DelayedChannel<StylusForces> forces(0);
  ToldSensor sensor(6);
  ForceSensorTask task(forces, sensor, 1000, RealSensorPlace{mount(), kTheatre});
  for (std::uint64_t k = 0; k < 100; ++k) {
    const LoopState loop = k < 20 ? LoopState::kUnhomed : k < 24 ? LoopState::kHomed : LoopState::kActive;
    const Vec3 force_T = k < 24 ? Vec3(0, 0, 0) : Vec3(0.5, 0.2, -1);
    sensor.told = reads(mount(), home_angles(), kTheatre, force_T);
    forces.write(25 * k, {Vec3::Zero(), force_T, k < 20 ? joints(3) : home_angles(), loop, 25 * k});
    task.run(25 * k);
  }
  EXPECT_EQ(task.zero_samples(), 4u);
  EXPECT_EQ(task.measured().count(), 76u);
  EXPECT_NEAR(task.measured().largest(), Vec3(0.5, 0.2, -1).norm(), 1e-12) << "the pose jumps when home is found";
  EXPECT_LT(task.residual().largest(), 1e-12);
}

}  // namespace
}  // namespace trocar::force_sensor_task_test
