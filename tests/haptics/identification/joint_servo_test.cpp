// The servo on the seam: follows, measures what it asks, and refuses a device that misbehaves.
#include <gtest/gtest.h>

#include "haptics/control/gravity.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/identification/joint_servo.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::joint_servo_test {
namespace {

SimulatedDaqConfig nominal() {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  return config;
}

TEST(JointServo, GoesWhereItIsSent) {
  SimulatedDaq daq(nominal());
  JointServo servo(daq, {});
  const JointVector there = test::degrees(40, 55, 50, -70, -60, 80);
  servo.move_to(there);
  servo.follow([&](double) { return PathPoint{there, JointVector::Zero()}; }, 0.3);
  // Friction holds the light wrist joints back: c / (M w^2) of some 1e-4 kg m2.
  EXPECT_LT((daq.plant().angles() - there).head<4>().cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((daq.plant().angles() - there).cwiseAbs().maxCoeff(), 0.08);
  EXPECT_LT(servo.worst_error(), 0.1);
}

TEST(JointServo, MeasuresWeightAndFrictionOfAPassWithTheSignOfTheMotion) {
  SimulatedDaq daq(nominal());
  JointServo servo(daq, {});
  const JointVector q = test::degrees(40, 55, 50, -70, -60, 0), rate = JointVector::Constant(0.15);
  JointVector torque[2];
  for (const int way : {0, 1}) {
    const double sign = way == 0 ? 1 : -1;
    servo.move_to(q - 0.5 * sign * rate);
    servo.follow([&](double t) { return PathPoint{q + (t - 0.5) * sign * rate, sign * rate}; }, 0.2);
    const MotionTrace trace = servo.follow(
        [&](double t) {
          return PathPoint{q + (t - 0.3) * sign * rate, sign * rate};
        },
        0.6);
    torque[way].setZero();
    for (const JointVector& tau : trace.tau) torque[way] += tau / static_cast<double>(trace.tau.size());
  }
  const JointVector weight = 0.5 * (torque[0] + torque[1]), friction = 0.5 * (torque[0] - torque[1]);
  EXPECT_LT((weight - gravity_torque({}, arm_state(q))).cwiseAbs().maxCoeff(), 2e-3);
  const JointVector expected = DeviceModel{}.coulomb + 0.15 * DeviceModel{}.viscous;
  EXPECT_LT((friction - expected).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(JointServo, FollowsThroughElasticCables) {
  for (const double stiffness : {50.0, 200.0}) {
    SimulatedDaqConfig config = nominal();
    config.plant->options.cable.fill({stiffness});
    SimulatedDaq daq(config);
    JointServo servo(daq, {});
    const JointVector there = test::degrees(25, 60, 40, -90, -50, 40);
    servo.move_to(there);
    servo.move_to(home_angles());
    servo.move_to(there);
    EXPECT_LT((daq.plant().angles() - there).cwiseAbs().maxCoeff(), 0.08) << stiffness;
    EXPECT_LT(servo.worst_error(), 0.15) << stiffness;
  }
}

TEST(JointServo, TraceHasOneEntryASyncAndStartsWithoutAJump) {
  SimulatedDaq daq(nominal());
  JointServo servo(daq, {});
  const double before = servo.time_s();
  const MotionTrace trace = servo.follow([](double) { return PathPoint{home_angles(), JointVector::Zero()}; }, 0.25);
  EXPECT_EQ(trace.q.size(), 250u);
  EXPECT_EQ(trace.tau.size(), 250u);
  EXPECT_NEAR(servo.time_s() - before, 0.25, 1e-9);
  EXPECT_LT((trace.q.front() - home_angles()).cwiseAbs().maxCoeff(), 0.01);
}

TEST(JointServo, LeavesTheAmplifiersOff) {
  SimulatedDaq daq(nominal());
  { JointServo servo(daq, {}); }
  EXPECT_FALSE(daq.plant().amplifiers_enabled());
}

TEST(JointServo, RefusesADeviceThatMisbehaves) {
  const auto with = [](InjectedFaultKind kind, int channel, double at_s) {
    SimulatedDaqConfig config = nominal();
    InjectedFault fault;
    fault.kind = kind;
    fault.channel = channel;
    fault.at_s = at_s;
    fault.value = 500;
    config.faults.push_back(fault);
    return config;
  };
  const auto run = [](const SimulatedDaqConfig& config) {
    SimulatedDaq daq(config);
    JointServo servo(daq, {});
    servo.move_to(test::degrees(40, 55, 50, -70, -60, 80));
  };
  EXPECT_THROW(run(with(InjectedFaultKind::kEncoderJump, 2, 0.1)), EnvironmentError) << "in the jig";
  EXPECT_THROW(run(with(InjectedFaultKind::kEncoderJump, 2, 0.9)), EnvironmentError);
  EXPECT_THROW(run(with(InjectedFaultKind::kChannelInvalid, 4, 0.9)), EnvironmentError);
  EXPECT_THROW(run(with(InjectedFaultKind::kEmergencyStop, 0, 0.9)), EnvironmentError);
  EXPECT_THROW(run(with(InjectedFaultKind::kEncoderStuck, 3, 0.8)), EnvironmentError);
  EXPECT_NO_THROW(run(nominal()));
}

TEST(JointServo, RestsTheArmWhileAMotorIsHot) {
  SimulatedDaq daq(nominal());
  ServoGains gains;
  gains.hot_c = 26, gains.cool_c = 25.5;  // a degree of warming is hot here
  JointServo servo(daq, {}, gains);
  const JointVector far = test::degrees(25, 65, 45, -40, -60, 0);
  servo.move_to(far);
  servo.follow([&](double) { return PathPoint{far, JointVector::Zero()}; }, 3);
  ASSERT_GT(servo.hottest_c(), 26);
  const double before = servo.time_s();
  servo.move_to(far + JointVector::Constant(0.01));
  EXPECT_GT(servo.time_s() - before, 5) << "went home, waited, came back";
  EXPECT_LT((servo.reference() - far).norm(), 0.03);
}

TEST(ServoMasses, GiveTheNominalWeight) {
  const Eigen::VectorXd pi = servo_masses({});
  test::Random random(1);
  for (int k = 0; k < 20; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.2);
    const JointVector tau = torque_regressor(q, JointVector::Zero(), JointVector::Zero()) * pi;
    EXPECT_LT((tau - gravity_torque({}, arm_state(q))).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(JointServo, RefusesADeviceThatIsNotInItsJig) {
  SimulatedDaq daq(nominal());
  daq.read();
  daq.arm(true);
  for (int k = 0; k < 100; ++k) daq.write({}), daq.read();
  EXPECT_THROW(JointServo(daq, {}), EnvironmentError);
}

}  // namespace
}  // namespace trocar::joint_servo_test
