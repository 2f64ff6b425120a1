// All eight forward solutions found again by brute force: Newton's method from random orientations, knowing nothing of
// the closed form. And the inverse against the forward model of every solution's own legs.
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/spherical_parallel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::forward_search_test {
namespace {

using test::degrees;
using test::Random;

Mat3 passive_axes(const Vec3& th) {
  Mat3 W;
  W.col(0) << std::sin(th[0]), -std::cos(th[0]), 0;
  W.col(1) << 0, std::sin(th[1]), -std::cos(th[1]);
  W.col(2) << -std::cos(th[2]), 0, std::sin(th[2]);
  return W;
}

Vec3 residuals(const Mat3& W, const Mat3& R) { return (W.cwiseProduct(R)).colwise().sum().transpose(); }

/// Newton on the rotation: R <- exp(w) R with (V_i x W_i) . w = -W_i . V_i. False when it does not settle.
bool settle(const Mat3& W, Mat3& R) {
  for (int step = 0; step < 60; ++step) {
    const Vec3 f = residuals(W, R);
    if (f.norm() < 1e-14) return true;
    Mat3 J;
    for (int i = 0; i < 3; ++i) J.row(i) = Vec3(R.col(i)).cross(Vec3(W.col(i))).transpose();
    if (std::abs(J.determinant()) < 1e-9) return false;
    Vec3 w = -J.inverse() * f;
    if (w.norm() > 0.5) w *= 0.5 / w.norm();
    R = Eigen::AngleAxisd(w.norm(), w.norm() > 0 ? Vec3(w.normalized()) : Vec3(Vec3::UnitX())).toRotationMatrix() * R;
  }
  return residuals(W, R).norm() < 1e-12;
}

TEST(ForwardSearch, FindsTheEightSolutionsAndNoNinth) {
  Random random(1);
  for (const JointVector& q :
       {degrees(30, 20, 25, -60, -50, 120), degrees(42, 48, 45, -14, -81, 0), degrees(70, 55, 62, -90, -40, 10)}) {
    const Mat3 W = passive_axes(q.head<3>());
    const auto all = forward_solutions(q);
    std::array<int, kForwardSolutions> found{};
    for (int n = 0; n < 600; ++n) {
      Mat3 R = random.rotation();
      if (!settle(W, R)) continue;
      int which = -1;
      for (int i = 0; i < kForwardSolutions; ++i) {
        if ((R - all[static_cast<std::size_t>(i)].R_WP).norm() < 1e-6) which = i;
      }
      ASSERT_GE(which, 0) << "a ninth solution:\n" << R;
      ++found[static_cast<std::size_t>(which)];
    }
    for (int i = 0; i < kForwardSolutions; ++i)
      EXPECT_GT(found[static_cast<std::size_t>(i)], 0) << "solution " << i + 1;
  }
}

TEST(ForwardSearch, OnlyTheWorkingModeGivesItsOwnAnglesBack) {
  Random random(2);
  for (int n = 0; n < 200; ++n) {
    const JointVector q = test::random_joints(random, 3, 0.1);
    const auto all = forward_solutions(q);
    for (int i = 0; i < 4; ++i) {
      const Vec3 back = active_angles(all[static_cast<std::size_t>(i)].R_WP);
      const double off = (back - q.head<3>()).cwiseAbs().maxCoeff();
      if (i == 0) {
        EXPECT_LT(off, 1e-12);
      } else {
        EXPECT_GT(off, 1.0) << "in the other modes at least one leg is turned by half a turn: (2.21) says pi more";
      }
    }
  }
}

TEST(ForwardSearch, RoomInTheRingDependsOnThePlatformAlone) {
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    JointVector q = test::random_joints(random);
    const auto one = forward_solutions(q);
    q.tail<3>() = random.vector(1);
    const auto other = forward_solutions(q);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].ring_room_m, other[i].ring_room_m);
      EXPECT_EQ(one[i].residual, other[i].residual);
      EXPECT_EQ(one[i].det_a, other[i].det_a);
    }
  }
}

TEST(ForwardSearch, DeterminantHasTheSameSizeInAllEight) {
  // det A = s1 s2 s3 + c1 c2 c3 in the assembly modes, minus that in the trivial solutions.
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    const JointVector q = test::random_joints(random);
    const double det = q.head<3>().array().sin().prod() + q.head<3>().array().cos().prod();
    for (const ForwardSolution& s : forward_solutions(q))
      EXPECT_NEAR(s.det_a, s.trivial ? -det : det, 1e-13) << s.meaning;
  }
}

TEST(ForwardSearch, TurnOfTheStylusLeavesItsPlaceAlone) {
  JointVector q = degrees(40, 50, 45, -50, -80, 0);
  const auto start = forward_solutions(q);
  for (const double turns : {0.25, 1.0, -3.5}) {
    q[5] = 2 * std::numbers::pi * turns;
    const auto turned = forward_solutions(q);
    for (std::size_t i = 0; i < start.size(); ++i) {
      EXPECT_LT((turned[i].X_WS.p - start[i].X_WS.p).norm(), 1e-15);
      EXPECT_LT((turned[i].X_WS.R.col(2) - start[i].X_WS.R.col(2)).norm(), 1e-15) << "Z6 is the axis of theta6";
      const bool whole = std::abs(turns - std::round(turns)) < 1e-9;
      EXPECT_EQ((turned[i].X_WS.R - start[i].X_WS.R).norm() < 1e-9, whole);
    }
  }
}

}  // namespace
}  // namespace trocar::forward_search_test
