// Weight of the arm: holding torque against the potential, the published home value, limiting cases.
#include <gtest/gtest.h>

#include "haptics/control/gravity.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::gravity_test {
namespace {

using test::Random;

JointVector slope_of_potential(const DeviceModel& model, const JointVector& q) {
  constexpr double h = 1e-3;  // five points: h^4 = 1e-12, rounding 1e-16 / h = 1e-13
  JointVector slope;
  for (int i = 0; i < kArmJoints; ++i) {
    const auto at = [&](double offset) {
      JointVector moved = q;
      moved[i] += offset;
      return gravity_potential(model, arm_state(moved));
    };
    slope[i] = (at(-2 * h) - at(2 * h) + 8 * (at(h) - at(-h))) / (12 * h);
  }
  return slope;
}

TEST(Gravity, HoldingTorqueIsTheSlopeOfThePotential) {
  Random random(1);
  const DeviceModel model;
  for (int k = 0; k < 300; ++k) {
    // Away from the shoulder's singularity, where the fifth derivative of the pose is tame: 1e-9 as the reference asks.
    const JointVector q = test::random_joints(random, 5, 0.3);
    EXPECT_LT((gravity_torque(model, arm_state(q)) - slope_of_potential(model, q)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Gravity, HoldingTorqueAtHome) {
  const JointVector torque = gravity_torque({}, arm_state(home_angles()));
  const JointVector printed = (JointVector() << 0.0224, -0.0224, 0, -0.0144, 0, 0).finished();
  EXPECT_LT((torque - printed).cwiseAbs().maxCoeff(), 5e-5);  // four decimals printed
}

TEST(Gravity, WristJointsCarryNothing) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const JointVector torque = gravity_torque({}, arm_state(test::random_joints(random)));
    EXPECT_NEAR(torque[4], 0, 1e-15);  // the stylus weight sits where both wrist axes meet
    EXPECT_NEAR(torque[5], 0, 1e-15);
  }
}

TEST(Gravity, EachWeightPullsInProportion) {
  const ArmState arm = arm_state(test::degrees(50, 40, 45, -70, -90, 20));
  const JointVector all = gravity_torque({}, arm);
  JointVector sum = JointVector::Zero();
  for (std::size_t body = 0; body < 4; ++body) {
    DeviceModel one;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i != body) one.platform_weights[i].weight_n = 0;
    }
    if (body != 3) one.stylus_weight_n = 0;
    sum += gravity_torque(one, arm);
  }
  EXPECT_LT((all - sum).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Gravity, StylusWeightIsHeldByAnEqualForceAtTheStylus) {
  DeviceModel model;
  for (PlatformWeight& body : model.platform_weights) body.weight_n = 0;
  const ArmState arm = arm_state(test::degrees(50, 40, 45, -70, -90, 20));
  Vec6 up = Vec6::Zero();
  up[2] = model.stylus_weight_n;
  EXPECT_LT((gravity_torque(model, arm) - arm.J_WS.transpose() * up).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace trocar::gravity_test
