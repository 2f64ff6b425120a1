// Where the identifier sends the arm: allowed, spread out, the same for a seed, and better than chance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "haptics/control/gravity.h"
#include "haptics/identification/excitation.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::excitation_test {
namespace {

TEST(Excitation, PosesAreAllowedAndSpreadOverTheWorkspace) {
  const auto poses = draw_static_poses(7, 60, 1, {});
  ASSERT_EQ(poses.size(), 60u);
  JointVector low = poses[0].q, high = poses[0].q, signs = JointVector::Zero();
  for (const StaticPose& pose : poses) {
    EXPECT_TRUE(pose_allowed(pose.q, {}));
    EXPECT_GT(joint_limit_margin(pose.q), 0.17);
    EXPECT_GT(arm_state(pose.q).det_a, 0.3);
    EXPECT_LT(gravity_torque({}, arm_state(pose.q)).cwiseAbs().maxCoeff(), 0.28);
    low = low.cwiseMin(pose.q), high = high.cwiseMax(pose.q), signs += pose.sign;
  }
  for (int i = 0; i < 5; ++i) {
    EXPECT_GT(high[i] - low[i], 0.5 * (kJointRange[i].high - kJointRange[i].low)) << "joint " << i + 1;
    EXPECT_LT(std::abs(signs[i]), 40) << "both signs are drawn";
  }
}

TEST(Excitation, SpanShrinksTheSpread) {
  for (const StaticPose& pose : draw_static_poses(7, 20, 0.1, {})) {
    EXPECT_LT(std::abs(pose.q[0] - 45 * kDegree), 0.1 * 35 * kDegree + 1e-12);
  }
}

TEST(Excitation, SameSeedSamePosesAndPaths) {
  const BaseSet base = base_parameters();
  EXPECT_EQ(draw_static_poses(3, 5, 1, {})[4].q, draw_static_poses(3, 5, 1, {})[4].q);
  EXPECT_NE(draw_static_poses(3, 5, 1, {})[4].q, draw_static_poses(4, 5, 1, {})[4].q);
  EXPECT_EQ(search_excitation(3, 2, 1, {}, base).sine, search_excitation(3, 2, 1, {}, base).sine);
}

TEST(Excitation, PathRatesAreTheDerivativesOfItsAngles) {
  const FourierPath path = search_excitation(1, 1, 1, {}, base_parameters());
  constexpr double h = 1e-4;
  for (double t = 0.05; t < 10; t += 0.7) {
    const FourierPath::Point p = path.at(t);
    EXPECT_LT(((path.at(t + h).q - path.at(t - h).q) / (2 * h) - p.qd).norm(), 1e-5);
    EXPECT_LT(((path.at(t + h).qd - path.at(t - h).qd) / (2 * h) - p.qdd).norm(), 1e-5);
  }
  EXPECT_LT((path.at(0).q - path.at(path.period_s()).q).norm(), 1e-12);
}

TEST(Excitation, SearchStaysInsideAndLowersTheConditionNumber) {
  const BaseSet base = base_parameters();
  const FourierPath one = search_excitation(5, 1, 1, {}, base), best = search_excitation(5, 15, 1, {}, base);
  EXPECT_LT(best.condition, one.condition);
  EXPECT_LT(best.condition, 30);
  for (int k = 0; k < 60; ++k) EXPECT_TRUE(pose_allowed(best.at(k * best.period_s() / 60).q, {}));
}

TEST(Excitation, EveryJointOfAChosenPathMovesFastEnoughToCount) {
  const BaseSet base = base_parameters();
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const FourierPath path = search_excitation(seed, 5, 1, {}, base);
    EXPECT_TRUE(std::isfinite(path.condition)) << seed;
    JointVector fastest = JointVector::Zero();
    for (int k = 0; k < 500; ++k) fastest = fastest.cwiseMax(path.at(0.02 * k).qd.cwiseAbs());
    EXPECT_GT(fastest.minCoeff(), 2 * kSlow) << seed;
    EXPECT_LT(fastest.head<5>().maxCoeff(), 4.2) << seed;
    EXPECT_LT(fastest[5], 8.4) << seed;
  }
}

TEST(Excitation, SpanScalesTheAmplitude) {
  const BaseSet base = base_parameters();
  const FourierPath timid = search_excitation(1, 1, 0.1, {}, base);
  double most = 0;
  for (int k = 0; k < 100; ++k)
    most = std::max(most, (timid.at(0.1 * k).q - timid.centre).head<5>().cwiseAbs().maxCoeff());
  EXPECT_LT(most, 0.15) << "a tenth of at most 80 deg";
  EXPECT_GT(timid.condition, 30);
}

TEST(Excitation, PosesNearLimitsAndSingularitiesAreNotAllowed) {
  EXPECT_TRUE(pose_allowed(test::degrees(45, 45, 45, -60, -75, 0), {}));
  EXPECT_FALSE(pose_allowed(test::degrees(45, 45, 45, -5, -75, 0), {})) << "elbow nearly straight";
  EXPECT_FALSE(pose_allowed(test::degrees(12, 78, 45, -60, -75, 0), {})) << "det A";
  DeviceModel heavy;
  heavy.platform_weights[2].weight_n = 8;
  EXPECT_FALSE(pose_allowed(test::degrees(20, 60, 45, -60, -75, 0), heavy)) << "weight";
}

TEST(ConditionNumber, OfKnownMatrices) {
  Eigen::MatrixXd Y = Eigen::MatrixXd::Identity(5, 3);
  EXPECT_NEAR(condition_number(Y), 1, 1e-12);
  Y.col(1) *= 1e6;
  EXPECT_NEAR(condition_number(Y), 1, 1e-12) << "columns are scaled";
  // Two unit columns at angle a: sqrt((1 + cos a)/(1 - cos a)).
  Eigen::MatrixXd two(2, 2);
  const double a = 0.1;
  two << 1, std::cos(a), 0, std::sin(a);
  EXPECT_NEAR(condition_number(two), std::sqrt((1 + std::cos(a)) / (1 - std::cos(a))), 1e-9);
  Y.col(2).setZero();
  EXPECT_EQ(condition_number(Y), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace trocar::excitation_test
