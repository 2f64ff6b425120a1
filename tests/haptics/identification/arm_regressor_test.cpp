// The identifier's rigid-body model against the simulated plant's, which was written apart from it.
#include <gtest/gtest.h>

#include "haptics/control/gravity.h"
#include "haptics/device/plant/device_plant.h"
#include "haptics/identification/arm_regressor.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::arm_regressor_test {
namespace {

using test::Random;

/// Every mass parameter of the plant, in the identifier's words.
Eigen::VectorXd parameters_of(const PlantParameters& p) {
  Eigen::VectorXd pi = Eigen::VectorXd::Zero(kMassParameters);
  const auto add = [&](int body, double mass, const Vec3& r, const Mat3& inertia_about_com) {
    const Mat3 I = inertia_about_com + mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    pi[body_parameter(body, 0)] += mass;
    for (int k = 0; k < 3; ++k) pi[body_parameter(body, 1 + k)] += mass * r[k];
    int item = 4;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) pi[body_parameter(body, item++)] += I(i, j);
    }
  };
  const Mat3 R_Pp_Wp = arm_state(home_angles()).R_WPprime.transpose();
  for (const PlatformMass& m : p.platform_masses) add(0, m.mass, R_Pp_Wp * m.position_home, Mat3::Zero());
  add(0, 0, Vec3::Zero(), p.platform_inertia * Mat3::Identity());
  add(3, p.stylus_mass, p.stylus_com, p.stylus_inertia.asDiagonal());
  for (int i = 0; i < kArmJoints; ++i) {
    pi[rotor_parameter(i)] = p.channel[i].rotor_inertia / (p.channel[i].ratio * p.channel[i].ratio);
  }
  return pi;
}

PlantParameters smooth(std::uint64_t seed) {
  PlantParameters p = draw_parameters(seed);
  p.stylus_com = Vec3(0.004, -0.003, 0.006);  // far enough off for every term to count
  return p;
}

TEST(ArmRegressor, HoldingTorqueIsThePlants) {
  Random random(1);
  const PlantParameters p = smooth(3);
  const Eigen::VectorXd pi = parameters_of(p);
  DevicePlant plant(p);
  for (int k = 0; k < 100; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.2);
    plant.place(q, 0.02);
    const JointVector tau = torque_regressor(q, JointVector::Zero(), JointVector::Zero()) * pi;
    EXPECT_LT((tau - plant.holding_torque()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(ArmRegressor, InertiaMatrixIsThePlantsInJointCoordinates) {
  Random random(2);
  const PlantParameters p = smooth(4);
  const Eigen::VectorXd pi = parameters_of(p);
  DevicePlant plant(p);
  for (int k = 0; k < 50; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.2);
    plant.place(q, 0.02);
    // q' = S nu: M_q = S^-T M_nu S^-1. The plant's S column by column from its rates.
    Mat6 S_inverse = Mat6::Identity();
    S_inverse.topLeftCorner<3, 3>() =
        rotation_W_Wprime() * arm_state(q).J_WS.block<3, 3>(3, 0);  // omega in W from shoulder rates
    const Mat6 expected = S_inverse.transpose() * plant.mass_matrix() * S_inverse;
    EXPECT_LT((inertia_matrix(q, pi) - expected).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// Energy of the plant along q + qd t + qdd t^2 / 2.
double energy_at(DevicePlant& plant, const JointVector& q, const JointVector& qd, const JointVector& qdd, double t) {
  plant.place(q + qd * t + 0.5 * qdd * t * t, 0.02);
  plant.set_joint_rates(qd + qdd * t);
  return plant.energy();
}

TEST(ArmRegressor, PowerIsTheRateOfThePlantsEnergy) {
  Random random(5);
  const PlantParameters p = smooth(6);
  const Eigen::VectorXd pi = parameters_of(p);
  DevicePlant plant(p);
  constexpr double h = 1e-4;
  for (int k = 0; k < 100; ++k) {
    const JointVector q = test::random_joints(random, 10, 0.35);
    JointVector qd, qdd;
    for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(2), qdd[i] = random.symmetric(10);
    const auto E = [&](double t) { return energy_at(plant, q, qd, qdd, t); };
    const double power = (E(-2 * h) - E(2 * h) + 8 * (E(h) - E(-h))) / (12 * h);
    const double ours = qd.dot(torque_regressor(q, qd, qdd) * pi);
    EXPECT_NEAR(ours, power, 1e-7 * (1 + std::abs(power))) << k;  // h^4 of a fast motion and rounding over h
  }
}

/// Power alone leaves forces across the motion free: they follow from Lagrange's equations on the plant's energy.
TEST(ArmRegressor, TorquesFollowFromLagrangesEquationsOfThePlant) {
  Random random(7);
  const PlantParameters p = smooth(8);
  const Eigen::VectorXd pi = parameters_of(p);
  for (int k = 0; k < 20; ++k) {
    const JointVector q = test::random_joints(random, 10, 0.35);
    JointVector qd;
    for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(2);
    const auto kinetic = [&](const JointVector& at) { return 0.5 * qd.dot(inertia_matrix(at, pi) * qd); };
    constexpr double h = 1e-5;
    const Mat6 M_dot = (inertia_matrix(q + h * qd, pi) - inertia_matrix(q - h * qd, pi)) / (2 * h);
    JointVector expected = M_dot * qd + torque_regressor(q, JointVector::Zero(), JointVector::Zero()) * pi;
    for (int i = 0; i < kArmJoints; ++i) {
      expected[i] -= (kinetic(q + h * Vec6::Unit(i)) - kinetic(q - h * Vec6::Unit(i))) / (2 * h);
    }
    const JointVector tau = torque_regressor(q, qd, JointVector::Zero()) * pi;
    EXPECT_LT((tau - expected).cwiseAbs().maxCoeff(), 1e-8) << k;
  }
}

TEST(ArmRegressor, NamesAndUnits) {
  EXPECT_EQ(mass_parameter_name(body_parameter(0, 1)), "P.mx");
  EXPECT_EQ(mass_parameter_name(body_parameter(3, 9)), "6.Izz");
  EXPECT_EQ(mass_parameter_name(rotor_parameter(5)), "rotor 6");
  EXPECT_EQ(mass_parameter_unit(body_parameter(1, 0)), "kg");
  EXPECT_EQ(mass_parameter_unit(body_parameter(1, 3)), "kg m");
  EXPECT_EQ(mass_parameter_unit(rotor_parameter(0)), "kg m2");
}

}  // namespace
}  // namespace trocar::arm_regressor_test
