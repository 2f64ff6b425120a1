// Forward kinematics: the shoulder's assembly modes, published poses, the Jacobian by finite differences.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/spherical_parallel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::kinematics_test {
namespace {

using test::degrees;
using test::Random;

// Chains of rotations of order 1: a few hundred roundings of 1e-16.
constexpr double kRounding = 1e-14;

Vec3 in_base(const JointVector& q) { return arm_state(q).X_WS.p * 1000; }

TEST(Kinematics, ExamplePoseOfTheThesisWithExactConstants) {
  const ArmState arm = arm_state(degrees(30, 20, 25, -60, -50, 120));
  // The reference prints four decimals of a millimetre.
  EXPECT_LT((arm.X_WS.p * 1000 - Vec3(40.6612, -132.1386, -193.0649)).cwiseAbs().maxCoeff(), 6e-5);
  const Mat3 R_WpS = rotation_W_Wprime() * arm.X_WS.R;
  const Mat3 printed =
      (Mat3() << -0.5333, 0.7824, -0.3215, 0.6800, 0.6226, 0.3872, 0.5031, -0.0121, -0.8641).finished();
  EXPECT_LT((R_WpS - printed).cwiseAbs().maxCoeff(), 6e-5);
  EXPECT_LT((rotation_W_Wprime() * arm.X_WS.p * 1000 - Vec3(86.2726, 219.3568, 28.7689)).cwiseAbs().maxCoeff(), 6e-5);
}

TEST(Kinematics, RecordedSamplesOfTable36) {
  EXPECT_LT((in_base(degrees(64.14, 59.65, 42.03, -28.74, -78.23, -42.37)) - Vec3(-96.0068, -84.5473, -232.6072))
                .cwiseAbs()
                .maxCoeff(),
            6e-5);
  EXPECT_LT((in_base(degrees(35.33, 27.64, 49.57, -59.6, -87.42, -95.41)) - Vec3(76.5527, -137.4529, -178.4934))
                .cwiseAbs()
                .maxCoeff(),
            6e-5);
}

TEST(Kinematics, HomeAnglesFollowFromTheJigPose) {
  const JointVector exact = degrees(42.24585581947, 47.75414418019, 45, -13.65214971959, -81.45969986039, 0);
  // Eleven decimals of a degree are 2e-13 rad, but the reference's th1 + th2 misses the 90 deg that the symmetry of
  // the jig asks for by 3.4e-10 deg = 6e-12 rad; th4 to th6 agree to the last digit.
  EXPECT_LT((home_angles() - exact).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((home_angles() - exact).tail<3>().cwiseAbs().maxCoeff(), 2e-13);
  EXPECT_NEAR(home_angles()[0] + home_angles()[1], 90 * kDegree, kRounding);
  const ArmState arm = arm_state(home_angles());
  EXPECT_LT((arm.X_WS.p - home_pose().p).norm(), kRounding);
  EXPECT_LT((arm.X_WS.R - home_pose().R).norm(), kRounding);
}

TEST(Kinematics, HomeIsAHealthyPlaceOfTheShoulder) {
  EXPECT_NEAR(arm_state(home_angles()).det_a, 0.704, 5e-4);  // reference prints three decimals
}

TEST(Kinematics, ConstantFramesAreRotations) {
  for (const Mat3& R : {rotation_W_Wprime(), rotation_P_Pprime()}) {
    EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), kRounding);
    EXPECT_NEAR(R.determinant(), 1, kRounding);
  }
}

TEST(Kinematics, DeterminantOfTheShoulderHasAClosedForm) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 th = random.vector(0.25 * std::numbers::pi) + Vec3::Constant(0.25 * std::numbers::pi);
    const double closed = th.array().sin().prod() + th.array().cos().prod();
    if (closed < 1e-3) continue;  // the working mode ends there
    EXPECT_NEAR(spherical_parallel(th).det_a, closed, kRounding);
  }
}

TEST(Kinematics, FourAssemblyModesCloseTheLoop) {
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const Vec3 th = test::random_joints(random).head<3>();
    for (int mode = 0; mode < 4; ++mode) {
      const Mat3 R = assembly_mode(th, mode);
      EXPECT_LT(loop_residual(th, R), kRounding) << "mode " << mode;
      EXPECT_NEAR(R.determinant(), 1, kRounding);
      for (int other = 0; other < mode; ++other) {
        EXPECT_GT((R - assembly_mode(th, other)).norm(), 1e-3) << mode << " equals " << other;
      }
    }
    EXPECT_LT((assembly_mode(th, 0) - spherical_parallel(th).R_WP).norm(), kRounding);
  }
}

TEST(Kinematics, TableOfEulerAnglesOfTheFourModes) {
  // Thesis table 2.5 prints three decimals of a radian: phi1 and phi2, phi3 of the four sets.
  const double printed[4][3] = {
      {0.524, 0.314, 0.339}, {0.524, 0.314, 3.480}, {0.524, 3.456, -0.339}, {0.524, 3.456, 2.803}};
  const Vec3 th = Vec3(30, 20, 25) * kDegree;
  for (int mode = 0; mode < 4; ++mode) {
    const Mat3 R =
        (Eigen::AngleAxisd(printed[mode][0], Vec3::UnitZ()) * Eigen::AngleAxisd(printed[mode][1], Vec3::UnitY()) *
         Eigen::AngleAxisd(printed[mode][2], Vec3::UnitX()))
            .toRotationMatrix();
    EXPECT_LT(test::turn_between(R, assembly_mode(th, mode)), 2e-3) << "mode " << mode;
  }
}

TEST(Kinematics, FourTrivialOrientationsCloseTheLoopForAnyAngles) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Vec3 th = random.vector(std::numbers::pi);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT(loop_residual(th, trivial_assembly(i)), kRounding);
      EXPECT_NEAR(trivial_assembly(i).determinant(), 1, kRounding);
    }
  }
}

TEST(Kinematics, TheFacesOfTheJointBoxAreRegular) {
  Random random(4);
  for (int face = 0; face < 3; ++face) {
    for (int k = 0; k < 200; ++k) {
      JointVector q = test::random_joints(random);
      q[face] = 90 * kDegree;
      const ArmState arm = arm_state(q);
      if (arm.det_a < 0.05) continue;
      EXPECT_LT(loop_residual(q.head<3>(), spherical_parallel(q.head<3>()).R_WP), 1e-15 * 10) << "face " << face;
      JointVector inside = q;
      inside[face] -= 1e-9;
      // A regular map moves by rate x 1e-9; the largest rate here is 1 / 0.05.
      EXPECT_LT((arm.X_WS.p - arm_state(inside).X_WS.p).norm(), 1e-8);
      EXPECT_TRUE(arm.J_WS.allFinite());
    }
  }
}

TEST(Kinematics, ActiveAnglesInvertTheShoulder) {
  Random random(5);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 th = test::random_joints(random).head<3>();
    // Rounding of 1e-16 divided by the smallest axis component, 1e-2 two degrees inside the box.
    EXPECT_LT((active_angles(spherical_parallel(th).R_WP) - th).cwiseAbs().maxCoeff(), 1e-13);
  }
}

Vec6 twist_by_differences(const JointVector& q, int joint) {
  constexpr double h = 1e-5;  // central difference: h^2 = 1e-10 against rounding 1e-16 / h = 1e-11
  JointVector forward = q, back = q;
  forward[joint] += h;
  back[joint] -= h;
  const Pose a = arm_state(back).X_WS, b = arm_state(forward).X_WS;
  const Eigen::AngleAxisd turn(Mat3(b.R * a.R.transpose()));
  Vec6 twist;
  twist << (b.p - a.p) / (2 * h), turn.axis() * (turn.angle() / (2 * h));
  return twist;
}

TEST(Kinematics, JacobianEqualsCentralDifferences) {
  Random random(6);
  for (int k = 0; k < 300; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.1);
    const Mat6 J = arm_state(q).J_WS;
    for (int i = 0; i < kArmJoints; ++i) {
      // Third derivatives grow with 1 / det^3 = 1e3 at most.
      EXPECT_LT((J.col(i) - twist_by_differences(q, i)).cwiseAbs().maxCoeff(), 1e-6) << "joint " << i;
    }
  }
}

TEST(Kinematics, TorqueTimesJointRateIsWrenchTimesTwist) {
  Random random(7);
  for (int k = 0; k < 500; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.1);
    Vec6 qd, wrench;
    for (int i = 0; i < 6; ++i) {
      qd[i] = random.symmetric(2);
      wrench[i] = random.symmetric(i < 3 ? 2 : 0.2);
    }
    // The twist by differences along the path, not by the matrix under test.
    Vec6 twist = Vec6::Zero();
    for (int i = 0; i < 6; ++i) twist += qd[i] * twist_by_differences(q, i);
    const JointVector torque = arm_state(q).J_WS.transpose() * wrench;
    EXPECT_NEAR(torque.dot(qd), wrench.dot(twist), 1e-5);  // six columns of 1e-6
  }
}

TEST(Kinematics, SixthAngleMayTurnForEver) {
  const JointVector q = degrees(40, 45, 50, -60, -80, 10);
  JointVector turned = q;
  turned[5] += 3 * 2 * std::numbers::pi;
  EXPECT_LT((arm_state(q).X_WS.R - arm_state(turned).X_WS.R).norm(), kRounding);
  EXPECT_DOUBLE_EQ(joint_limit_margin(q), joint_limit_margin(turned));
}

TEST(Kinematics, LimitMarginIsTheDistanceToTheNearestLimit) {
  EXPECT_NEAR(joint_limit_margin(degrees(40, 45, 50, -60, -80, 10)), 40 * kDegree, kRounding);
  EXPECT_NEAR(joint_limit_margin(degrees(3, 45, 50, -60, -80, 10)), 3 * kDegree, kRounding);
  EXPECT_NEAR(joint_limit_margin(degrees(40, 45, 50, -121, -80, 10)), -1 * kDegree, kRounding);
  EXPECT_NEAR(joint_limit_margin(degrees(40, 45, 50, -60, 2, 10)), -2 * kDegree, kRounding);
}

TEST(Kinematics, StraightElbowLosesARank) {
  JointVector q = degrees(40, 45, 50, -60, -80, 10);
  const double bent = smallest_singular_value(arm_state(q).J_WS, 0.2);
  q[3] = 0;
  EXPECT_GT(bent, 0.1);
  EXPECT_LT(smallest_singular_value(arm_state(q).J_WS, 0.2), 1e-12);
}

}  // namespace
}  // namespace trocar::kinematics_test
