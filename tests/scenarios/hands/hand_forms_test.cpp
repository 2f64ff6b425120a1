// The movements of a scripted hand against the formulas that they state.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/turn_plan.h"

namespace trocar::hand_forms_test {
namespace {

TEST(MinimumJerkForm, IsItsPolynomialAndHeldBeyondItsEnds) {
  EXPECT_EQ(minimum_jerk(-0.5), 0);
  EXPECT_EQ(minimum_jerk(1.5), 1);
  for (double s = 0; s <= 1; s += 0.05) {
    EXPECT_NEAR(minimum_jerk(s), 10 * std::pow(s, 3) - 15 * std::pow(s, 4) + 6 * std::pow(s, 5), 1e-12) << s;
    EXPECT_NEAR(minimum_jerk(s) + minimum_jerk(1 - s), 1, 1e-12) << "the same forwards and backwards";
  }
  constexpr double h = 1e-5;
  EXPECT_NEAR((minimum_jerk(0.5 + h) - minimum_jerk(0.5 - h)) / (2 * h), 1.875, 1e-8) << "its greatest speed";
}

TEST(ReachTimeForm, IsFittsLawWithItsTwoConstants) {
  EXPECT_NEAR(reach_time_s(0, 0.01, 1), 0.12, 1e-12);
  EXPECT_NEAR(reach_time_s(0.005, 0.01, 1), 0.23, 1e-12) << "one bit";
  EXPECT_NEAR(reach_time_s(0.035, 0.01, 1), 0.45, 1e-12) << "three bits";
  EXPECT_NEAR(reach_time_s(0.035, 0.01, 1.6), 1.6 * 0.45, 1e-12);
}

TEST(ReachPlanForm, WithoutALiftItIsOneMovementAlongTheLine) {
  ReachPlan::Shape shape;
  shape.travel_time_s = 0.8;
  const Vec3 from(0.01, 0.02, 0.03), to(0.05, -0.02, 0.04);
  const ReachPlan plan(from, to, shape);
  EXPECT_NEAR(plan.duration_s(), 0.8, 1e-12);
  for (double t = 0; t <= 0.8; t += 0.1)
    EXPECT_LT((plan.at(t) - (from + minimum_jerk(t / 0.8) * (to - from))).norm(), 1e-12) << t;
  EXPECT_LT((plan.at(5) - to).norm(), 1e-12);
}

TEST(ReachPlanForm, LiftIsUndoneAndTheBulgeIsGreatestHalfWay) {
  ReachPlan::Shape shape;
  shape.travel_time_s = 0.6;
  shape.lift_m = 0.02;
  shape.lift_time_s = 0.3;
  shape.bulge = Vec3(0, 0.01, 0);
  const ReachPlan plan(Vec3::Zero(), Vec3(0.1, 0, 0), shape);
  double highest = 0, widest = 0, where = 0;
  for (double t = 0; t <= plan.duration_s(); t += 1e-3) {
    const Vec3 p = plan.at(t);
    highest = std::max(highest, p.z());
    if (p.y() <= widest) continue;
    widest = p.y();
    where = p.x();
  }
  EXPECT_NEAR(highest, 0.02, 1e-4);
  EXPECT_NEAR(widest, 0.01, 1e-4);
  EXPECT_NEAR(where, 0.05, 2e-3);
  EXPECT_LT(plan.at(0).norm(), 1e-12);
  EXPECT_LT((plan.at(plan.duration_s()) - Vec3(0.1, 0, 0)).norm(), 1e-12);
}

TEST(TurnPlanForm, GoesByMinimumJerkAboutOneAxis) {
  const Mat3 from = Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()).toRotationMatrix();
  const Vec3 axis = Vec3(0.2, -0.5, 1).normalized();
  const Mat3 to = from * Eigen::AngleAxisd(1.2, axis).toRotationMatrix();
  const TurnPlan plan(from, to, 0.7);
  EXPECT_EQ(plan.duration_s(), 0.7);
  for (double t = 0; t <= 0.7; t += 0.1) {
    const Mat3 wanted = from * Eigen::AngleAxisd(1.2 * minimum_jerk(t / 0.7), axis).toRotationMatrix();
    EXPECT_LT((plan.at(t) - wanted).norm(), 1e-9) << t;
  }
}

TEST(RotationBy, IsTheIdentityAtZeroAndTurnsByItsLength) {
  EXPECT_LT((rotation_by(Vec3::Zero()) - Mat3::Identity()).norm(), 1e-15);
  const Mat3 quarter = rotation_by(Vec3(0, 0, std::numbers::pi / 2));
  EXPECT_LT((quarter * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  const Vec3 v(0.1, -0.2, 0.3);
  EXPECT_LT((rotation_by(v) * rotation_by(-v) - Mat3::Identity()).norm(), 1e-12);
  EXPECT_LT((rotation_by(v) * v - v).norm(), 1e-12) << "its own axis stays";
}

}  // namespace
}  // namespace trocar::hand_forms_test
