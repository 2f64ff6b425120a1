// Gravity by base parameters: the same torques as the weights they stand for, and a potential of its own.
#include <gtest/gtest.h>

#include "haptics/control/gravity.h"
#include "haptics/identification/base_parameters.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::identified_gravity_test {
namespace {

using test::Random;

DeviceModel with_parameters(const Eigen::Matrix<double, 9, 1>& p) {
  DeviceModel model;
  model.identified_gravity = gravity_of(p);
  return model;
}

TEST(IdentifiedGravity, OfTheNominalWeightsGivesTheNominalTorque) {
  Random random(1);
  const DeviceModel nominal, same = with_parameters(gravity_parameters({}));
  for (int k = 0; k < 200; ++k) {
    const ArmState arm = arm_state(test::random_joints(random, 2, 0.1));
    EXPECT_LT((gravity_torque(same, arm) - gravity_torque(nominal, arm)).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(gravity_potential(same, arm), gravity_potential(nominal, arm), 1e-13);
  }
}

TEST(IdentifiedGravity, AgreesWithTheRegressorForAnyParameters) {
  Random random(2);
  const BaseSet base = base_parameters();
  for (int k = 0; k < 100; ++k) {
    Eigen::Matrix<double, 9, 1> p;
    for (int i = 0; i < 9; ++i) p[i] = random.symmetric(0.5);
    const JointVector q = test::random_joints(random, 2, 0.2);
    const JointVector by_regressor =
        base.columns(torque_regressor(q, JointVector::Zero(), JointVector::Zero(), 1)).leftCols<9>() * p;
    EXPECT_LT((gravity_torque(with_parameters(p), arm_state(q)) - by_regressor).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(IdentifiedGravity, HoldingTorqueIsTheSlopeOfThePotential) {
  Random random(3);
  Eigen::Matrix<double, 9, 1> p;
  for (int i = 0; i < 9; ++i) p[i] = random.symmetric(0.5);
  const DeviceModel model = with_parameters(p);
  constexpr double h = 1e-4;
  for (int k = 0; k < 100; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.3);
    const JointVector torque = gravity_torque(model, arm_state(q));
    for (int i = 0; i < kArmJoints; ++i) {
      const auto V = [&](double s) { return gravity_potential(model, arm_state(q + s * h * Vec6::Unit(i))); };
      EXPECT_NEAR(torque[i], (V(-2) - V(2) + 8 * (V(1) - V(-1))) / (12 * h), 1e-9);
    }
  }
}

TEST(IdentifiedGravity, ParametersSurviveTheRoundTrip) {
  Eigen::Matrix<double, 9, 1> p;
  p << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(gravity_parameters(with_parameters(p)), p);
  // Nominal, by hand: stylus weight at the end of link 2.
  EXPECT_NEAR(gravity_parameters({})[3], 0.76 * 0.128, 1e-15);
}

}  // namespace
}  // namespace trocar::identified_gravity_test
