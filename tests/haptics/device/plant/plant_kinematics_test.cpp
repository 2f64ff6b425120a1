#include "haptics/device/plant/plant_kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_kinematics_test {
namespace {

using test::kDegree;

PlantKinematics at(const JointVector& q) { return evaluate_kinematics(configuration_at(q), 0.146, 0.128); }
Pose pose_at(const JointVector& q) { return stylus_pose(at(q)); }

TEST(PlantKinematics, HomePoseIsThePrintedOne) {
  const Pose X = pose_at(home_joint_angles(0.146, 0.128));
  EXPECT_LT((X.p - Vec3(0, -0.006, -0.272)).norm(), 1e-14);
  const Mat3 R = (Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  EXPECT_LT((X.R - R).norm(), 1e-13);
}

TEST(PlantKinematics, HomeAnglesAgreeWithTheExactRoots) {
  JointVector exact;
  exact << 42.24585581981, 47.75414418019, 45, -13.65214971959, -81.45969986039, 0;
  EXPECT_LT((home_joint_angles(0.146, 0.128) / kDegree - exact).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PlantKinematics, ExampleOfTheThesisWithExactConstants) {
  JointVector q;
  q << 30, 20, 25, -60, -50, 120;
  const PlantKinematics k = at(q * kDegree);
  // Position in W, mm, 4 printed digits: half a unit of the last one.
  EXPECT_LT((k.p6 * 1e3 - Vec3(86.2726, 219.3568, 28.7689)).cwiseAbs().maxCoeff(), 6e-5);
  EXPECT_LT((k.p6 * 1e3 - Vec3(85.63, 218.69, 27.87)).cwiseAbs().maxCoeff(), 1.0);  // thesis, two-digit constants
  EXPECT_LT((stylus_pose(k).p * 1e3 - Vec3(40.6612, -132.1386, -193.0649)).cwiseAbs().maxCoeff(), 6e-5);
  const Mat3 R = (Mat3() << -0.5333, 0.7824, -0.3215, 0.6800, 0.6226, 0.3872, 0.5031, -0.0121, -0.8641).finished();
  EXPECT_LT((k.R_W6 - R).cwiseAbs().maxCoeff(), 6e-5);
}

TEST(PlantKinematics, ShoulderAnglesComeBackFromTheOrientation) {
  PlantRandom random(11);
  for (int n = 0; n < 500; ++n) {
    const JointVector q = test::random_joints(random, 1.0);
    const PlantConfiguration c = configuration_at(q);
    const PlantKinematics k = evaluate_kinematics(c, 0.146, 0.128);
    EXPECT_LT((joint_angles(c, k) - q).cwiseAbs().maxCoeff(), 1e-12);
    for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(k.W.col(i).dot(k.R_WP.col(i))), 1e-14) << "loop " << i << " open";
  }
}

TEST(PlantKinematics, FacesOfTheJointBoxKeepTheLoopsClosed) {
  for (int axis = 0; axis < 3; ++axis) {
    JointVector q = JointVector::Constant(40 * kDegree);
    q[axis] = 90 * kDegree;
    const PlantKinematics k = at(q);
    for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(k.W.col(i).dot(k.R_WP.col(i))), 1e-14);
    EXPECT_NEAR(k.shoulder[axis], 90 * kDegree, 1e-12);
  }
}

TEST(PlantKinematics, DeterminantOfTheShoulderIsTheKnownClosedForm) {
  PlantRandom random(12);
  for (int n = 0; n < 200; ++n) {
    const JointVector q = test::random_joints(random, 2.0);
    const PlantKinematics k = at(q);
    Mat3 A;
    for (int i = 0; i < 3; ++i) A.row(i) = k.W.col(i).cross(k.R_WP.col(i)).transpose();
    const double closed =
        std::sin(q[0]) * std::sin(q[1]) * std::sin(q[2]) + std::cos(q[0]) * std::cos(q[1]) * std::cos(q[2]);
    EXPECT_NEAR(A.determinant(), closed, 1e-13);
  }
}

TEST(PlantKinematics, JointJacobianAgreesWithDifferencesOfThePose) {
  PlantRandom random(13);
  DevicePlant plant(nominal_parameters());
  for (int n = 0; n < 50; ++n) {
    const JointVector q = test::random_joints(random);
    plant.place(q, 0.02);
    const Mat6 J = plant.joint_jacobian();
    const Mat3 R = pose_at(q).R;
    for (int i = 0; i < kArmJoints; ++i) {
      const Vec3 v = test::derivative([](const JointVector& x) { return pose_at(x).p; }, q, i);
      const Mat3 R_dot = test::derivative([](const JointVector& x) { return pose_at(x).R; }, q, i);
      const Mat3 spin = R_dot * R.transpose();
      EXPECT_LT((J.col(i).head<3>() - v).norm(), 1e-10);
      EXPECT_LT((J.col(i).tail<3>() - Vec3(spin(2, 1), spin(0, 2), spin(1, 0))).norm(), 1e-9);
    }
  }
}

TEST(PlantKinematics, ShoulderBiasIsTheRateOfTheShoulderMap) {
  PlantRandom random(14);
  for (int n = 0; n < 50; ++n) {
    const PlantConfiguration c = configuration_at(test::random_joints(random));
    const Vec3 omega = test::random_vector(random, 5.0);
    const auto map_at = [&](double t) {
      PlantConfiguration moved = c;
      const double angle = omega.norm() * t;
      moved.q_WP = Eigen::AngleAxisd(angle, omega.normalized()) * c.q_WP;
      return Vec3(evaluate_kinematics(moved, 0.146, 0.128).Sp * omega);
    };
    const double h = 1e-4;
    const Vec3 rate = (map_at(-2 * h) - map_at(2 * h) + 8.0 * (map_at(h) - map_at(-h))) / (12.0 * h);
    const Vec3 bias = shoulder_bias(evaluate_kinematics(c, 0.146, 0.128), omega);
    EXPECT_LT((bias - rate).norm(), 1e-8 * (1.0 + rate.norm()));
  }
}

}  // namespace
}  // namespace trocar::plant_kinematics_test
