// Inverse kinematics: round trips, both arm planes, reach, limits.
#include <gtest/gtest.h>

#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/least_turn.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::inverse_kinematics_test {
namespace {

using test::degrees;
using test::Random;

double joint_distance(const JointVector& a, const JointVector& b) {
  double largest = 0;
  for (int i = 0; i < kArmJoints; ++i)
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  return largest;
}

/// sin of the angle between Z6 and OA: the arm plane is undefined where it is 0.
double plane_quality(const ArmState& arm) { return arm.X_WS.p.normalized().cross(arm.X_WS.R.col(2)).norm(); }

TEST(InverseKinematics, RoundTripOverTheWholeJointBox) {
  Random random(1);
  int second_plane = 0;
  for (int k = 0; k < 3000; ++k) {
    const JointVector q = test::random_joints(random);
    const ArmState arm = arm_state(q);
    if (plane_quality(arm) < 0.02) continue;
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    ASSERT_EQ(all.count, 2);
    EXPECT_EQ(all.missed_by_m, 0);
    double best = 1;
    for (int i = 0; i < 2; ++i) {
      const double off = joint_distance(all.candidate[i].q, q);
      if (off < best) best = off;
      if (off < 1e-9) {
        EXPECT_TRUE(all.candidate[i].in_limits);
        second_plane += i;
      }
    }
    // Requirement of the reference: 1e-9 rad. The elbow near straight amplifies rounding by 1 / sin(2 deg) = 30, the
    // plane by 1 / 0.02.
    EXPECT_LT(best, 1e-10);
  }
  EXPECT_GT(second_plane, 30) << "the far side of the surface Z6 || AO lies inside the limits";
}

TEST(InverseKinematics, EveryCandidateReachesThePose) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const ArmState arm = arm_state(test::random_joints(random));
    if (plane_quality(arm) < 0.02) continue;
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    for (int i = 0; i < all.count; ++i) {
      if (!all.candidate[i].in_limits) continue;  // outside, another assembly mode may hold the platform
      const ArmState again = arm_state(all.candidate[i].q);
      EXPECT_LT((again.X_WS.p - arm.X_WS.p).norm(), 1e-11);
      EXPECT_LT((again.X_WS.R - arm.X_WS.R).norm(), 1e-10);
    }
  }
}

TEST(InverseKinematics, ForwardOfInverseOfForwardIsForward) {
  Random random(3);
  JointVector near = home_angles();
  for (int k = 0; k < 2000; ++k) {
    const ArmState arm = arm_state(test::random_joints(random));
    if (plane_quality(arm) < 0.02) continue;
    const auto q = inverse_within_limits(arm.X_WS, near);
    ASSERT_TRUE(q.has_value());
    const ArmState again = arm_state(*q);
    EXPECT_LT((again.X_WS.p - arm.X_WS.p).norm(), 1e-11);
    EXPECT_LT(test::turn_between(again.X_WS.R, arm.X_WS.R), 1e-9);
    EXPECT_GE(joint_limit_margin(*q), 0);
  }
}

TEST(InverseKinematics, SixthAngleIsReportedWithinOneTurn) {
  Random random(4);
  for (int k = 0; k < 500; ++k) {
    const InverseSolutions all = inverse_kinematics(arm_state(test::random_joints(random)).X_WS);
    for (int i = 0; i < all.count; ++i) {
      EXPECT_GE(all.candidate[i].q[5], 0);
      EXPECT_LT(all.candidate[i].q[5], 2 * std::numbers::pi);
    }
  }
}

TEST(InverseKinematics, SixthAngleFollowsTheNearAngleOverSeveralTurns) {
  const JointVector q = degrees(40, 45, 50, -60, -80, 30);
  JointVector near = q;
  near[5] += 5 * 2 * std::numbers::pi - 0.2;
  const auto found = inverse_within_limits(arm_state(q).X_WS, near);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found)[5], q[5] + 5 * 2 * std::numbers::pi, 1e-9);
}

TEST(InverseKinematics, OfTwoCandidatesInsideTheLimitsTheNearerIsTaken) {
  // "Almost no pose has both inside": look for such poses and ask from both sides.
  Random random(5);
  int both = 0;
  for (int k = 0; k < 20000; ++k) {
    const ArmState arm = arm_state(test::random_joints(random, 0.5));
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    if (all.count < 2 || !all.candidate[0].in_limits || !all.candidate[1].in_limits) continue;
    ++both;
    for (int i = 0; i < 2; ++i) {
      const auto found = inverse_within_limits(arm.X_WS, all.candidate[i].q);
      ASSERT_TRUE(found.has_value());
      EXPECT_LT((*found - all.candidate[i].q).norm(), 1e-9);
    }
  }
  RecordProperty("poses_with_both", both);
  EXPECT_LT(both, 1000) << "the reference says that almost none has";
}

TEST(InverseKinematics, TooFarSaysByHowMuch) {
  for (const double extra : {1e-6, 0.001, 0.1}) {
    Pose X = home_pose();
    X.p *= (kLink1 + kLink2 + extra) / X.p.norm();
    const InverseSolutions all = inverse_kinematics(X);
    EXPECT_EQ(all.count, 0);
    EXPECT_NEAR(all.missed_by_m, extra, 1e-15);
    EXPECT_FALSE(inverse_within_limits(X, home_angles()).has_value());
  }
}

TEST(InverseKinematics, TooNearSaysByHowMuch) {
  Pose X = home_pose();
  X.p *= 0.010 / X.p.norm();
  const InverseSolutions all = inverse_kinematics(X);
  EXPECT_EQ(all.count, 0);
  EXPECT_NEAR(all.missed_by_m, (kLink1 - kLink2) - 0.010, 1e-15);
}

TEST(InverseKinematics, FullyStretchedIsStillReachable) {
  Pose X = home_pose();
  X.p *= (kLink1 + kLink2) / X.p.norm();
  const InverseSolutions all = inverse_kinematics(X);
  ASSERT_EQ(all.count, 2);
  EXPECT_NEAR(all.candidate[0].q[3], 0, 1e-6);  // acos loses half the digits at a straight arm
}

TEST(InverseKinematics, RollAxisThroughTheCentreHasNoAnswer) {
  Pose X = home_pose();
  X.R = least_turn(Vec3::UnitZ(), X.p).toRotationMatrix();
  const InverseSolutions all = inverse_kinematics(X);
  EXPECT_EQ(all.count, 0);
  EXPECT_EQ(all.missed_by_m, 0) << "it is in reach, only the plane is undefined";
}

TEST(InverseKinematics, LimitFlagTellsTheElbowBentTooFar) {
  const JointVector q = degrees(40, 45, 50, -125, -80, 30);
  const InverseSolutions all = inverse_kinematics(arm_state(q).X_WS);
  ASSERT_EQ(all.count, 2);
  EXPECT_FALSE(all.candidate[0].in_limits);
  EXPECT_FALSE(all.candidate[1].in_limits);
  EXPECT_FALSE(inverse_within_limits(arm_state(q).X_WS, q).has_value());
}

}  // namespace
}  // namespace trocar::inverse_kinematics_test
