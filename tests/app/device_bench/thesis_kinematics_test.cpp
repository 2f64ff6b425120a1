// The thesis' kinematics as printed: it must fail where the errata say it fails and be right where it is right, and all
// eight forward solutions must close the loops.
#include "app/device_bench/thesis_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/spherical_parallel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::thesis_kinematics_test {
namespace {

using test::degrees;
using test::Random;

double largest_turn(const JointVector& a, const JointVector& b) {
  double largest = 0;
  for (int i = 0; i < kArmJoints; ++i) {
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  }
  return largest;
}

TEST(ThesisKinematics, ForwardOnExactFramesIsOurs) {
  Random random(1);
  for (int k = 0; k < 300; ++k) {
    const JointVector q = test::random_joints(random);
    const Pose theirs = thesis::forward(q, thesis::exact_frames());
    const ArmState ours = arm_state(q);
    EXPECT_LT((theirs.p - ours.X_WS.p).norm(), 1e-13);
    EXPECT_LT((theirs.R - ours.X_WS.R).norm(), 1e-12);
  }
}

TEST(ThesisKinematics, PrintedFramesAreNoRotations) {
  const thesis::Frames printed = thesis::printed_frames(), exact = thesis::exact_frames();
  for (const auto& [p, e] :
       {std::pair(printed.R_WWprime, exact.R_WWprime), std::pair(printed.R_PPprime, exact.R_PPprime)}) {
    EXPECT_GT((p.transpose() * p - Mat3::Identity()).norm(), 5e-3);
    EXPECT_LT((p - e).cwiseAbs().maxCoeff(), 0.0101) << "two digits: 1/sqrt 3 = 0.577 is printed as 0.57";
    EXPECT_LT((e.transpose() * e - Mat3::Identity()).norm(), 1e-15);
  }
}

TEST(ThesisKinematics, PrintedFramesGiveThePrintedSamplesToAMillimetre) {
  for (const thesis::Sample& s : thesis::samples()) {
    const Vec3 theirs = thesis::forward(s.q, thesis::printed_frames()).p;
    EXPECT_LT((theirs - s.printed.p).norm(), 0.8e-3) << s.name << ": two digits, but not always the same two";
  }
}

TEST(ThesisKinematics, InverseIsRightOnItsSideAndWrongBeyond) {
  Random random(2);
  int right = 0, wrong = 0;
  for (int k = 0; k < 2000; ++k) {
    const JointVector q = test::random_joints(random);
    const ArmState arm = arm_state(q);
    const Vec3 normal = (-arm.X_WS.p.normalized()).cross(arm.X_WS.R.col(2));
    if (normal.norm() < 0.02) continue;
    const bool beyond = normal.dot(arm.J_WS.col(3).tail<3>()) < 0;
    const bool same = largest_turn(thesis::inverse(arm.X_WS, thesis::exact_frames()), q) < 1e-9;
    EXPECT_EQ(same, !beyond) << "pose " << k;
    (same ? right : wrong) += 1;
  }
  EXPECT_GT(right, 1000);
  EXPECT_GT(wrong, 50);
}

TEST(ThesisKinematics, PrintedFramesCostTheInverseADegree) {
  double worst = 0;
  for (const thesis::Sample& s : thesis::samples()) {
    const thesis::Frames printed = thesis::printed_frames();
    worst = std::max(worst, largest_turn(thesis::inverse(thesis::forward(s.q, printed), printed), s.q));
  }
  EXPECT_GT(worst, 0.5 * kDegree);  // table 3.7 is off by up to 1.20 deg
  EXPECT_LT(worst, 2.0 * kDegree);
}

TEST(ThesisKinematics, OutOfReachIsNotANumber) {
  Pose far = home_pose();
  far.p *= 2;
  EXPECT_TRUE(thesis::inverse(far, thesis::exact_frames()).hasNaN());
}

TEST(ForwardSolutions, AllEightCloseTheLoopsAndAreRotations) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const JointVector q = test::random_joints(random);
    const auto all = forward_solutions(q);
    for (const ForwardSolution& s : all) {
      EXPECT_LT(s.residual, 2e-15) << s.meaning;  // a sum of three roundings
      EXPECT_NEAR(s.R_WP.determinant(), 1, 1e-14) << s.meaning;
      EXPECT_NEAR(s.X_WS.p.norm(), all[0].X_WS.p.norm(), 1e-14) << "the serial part is the same rigid body";
    }
    EXPECT_LT((all[0].X_WS.p - arm_state(q).X_WS.p).norm(), 1e-14);
    EXPECT_NEAR(all[0].det_a, arm_state(q).det_a, 1e-14);
  }
}

TEST(ForwardSolutions, AreEightDifferentPoses) {
  const auto all = forward_solutions(thesis::example());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j)
      EXPECT_GT((all[i].R_WP - all[j].R_WP).norm(), 0.5) << i << ' ' << j;
  }
}

TEST(ForwardSolutions, TheExampleOfTheThesisIsThePublishedPose) {
  const auto all = forward_solutions(thesis::example());
  const Vec3 exact_W(86.2726, 219.3568, 28.7689);  // device reference, mm
  EXPECT_LT((rotation_W_Wprime() * all[0].X_WS.p * 1e3 - exact_W).norm(), 1e-4);
  // The second R printed by the thesis: diag signs of table 2.5, set 2.
  const Mat3 R2 = (Mat3() << 0.82, 0.38, -0.42, 0.48, -0.87, 0.14, -0.31, -0.32, -0.90).finished();
  const Mat3 R3 = (Mat3() << -0.82, -0.38, -0.42, -0.48, 0.87, 0.14, 0.31, 0.32, -0.90).finished();
  EXPECT_LT((all[1].R_WP - R2).cwiseAbs().maxCoeff(), 0.0101);
  EXPECT_LT((all[2].R_WP - R3).cwiseAbs().maxCoeff(), 0.0101);
}

TEST(ForwardSolutions, TrivialOnesHoldTheirLegsOnTheMotorAxes) {
  const auto all = forward_solutions(degrees(20, 70, 33, -40, -80, 10));
  const Vec3 U[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int leg = 0; leg < 3; ++leg) {
      const double along = std::abs(all[i].R_WP.col(leg).dot(U[leg]));
      EXPECT_EQ(along > 0.999, all[i].trivial) << i << ": there the leg turns about its motor's axis alone";
    }
    EXPECT_EQ(all[i].trivial, i >= 4);
  }
  EXPECT_STREQ(all[7].meaning, "trivial, V = (U1, U2, U3): the legs turn freely");
  EXPECT_GT(all[7].R_WP(2, 0), 0.99);
  EXPECT_GT(all[5].R_WP(0, 1), 0.99) << "V2 = +U2";
  EXPECT_LT(all[5].R_WP(1, 2), -0.99) << "V3 = -U3";
}

}  // namespace
}  // namespace trocar::thesis_kinematics_test
