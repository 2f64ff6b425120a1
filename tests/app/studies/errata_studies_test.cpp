// Errata of the thesis that the studies found or show, continued from
// tests/haptics/kinematics/errata_kinematics_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "app/device_bench/thesis_kinematics.h"
#include "app/studies/device/motor_study.h"
#include "app/studies/workspace/workspace_grid.h"
#include "app/studies/workspace/workspace_region.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar::errata_studies_test {
namespace {

/// Distance between printed position `i` and solution `j` of the example of section 2.5, m; both from 1 as in the
/// thesis.
double printed_against(std::size_t i, std::size_t j) {
  const Vec3 ours = rotation_W_Wprime() * forward_solutions(thesis::example())[j - 1].X_WS.p;
  return (thesis::example_positions_W()[i - 1] - ours).norm();
}

TEST(ThesisErrata, OfTheEightPrintedPositionsOnlyTheFirstAndTheSixthFollow) {
  for (const std::size_t right : {1u, 6u}) EXPECT_LT(printed_against(right, right), 1.5e-3) << "two digits, " << right;
  for (const std::size_t wrong : {2u, 3u, 4u, 5u, 7u, 8u}) EXPECT_GT(printed_against(wrong, wrong), 0.15) << wrong;
  EXPECT_EQ(thesis::example_positions_W()[3], thesis::example_positions_W()[5]) << "4 is a copy of 6";
  EXPECT_LT(printed_against(7, 4), 1.5e-3) << "7 shows what 4 should be";
  for (const std::size_t none : {2u, 3u, 5u, 8u}) {
    for (std::size_t j = 1; j <= 8; ++j) EXPECT_GT(printed_against(none, j), 0.045) << none << " against " << j;
  }
}

TEST(ThesisErrata, Eq238AndEq240AreNoFrameOfTheirOwnDefinition) {
  const Vec3 P6 = Vec3(40.49, -131.14, -192.93) * 1e-3;  // (2.37)
  const Vec3 N(-0.11, -0.97, 0.15);                      // (2.38)
  const Vec3 printed_X(-0.13, -0.57, -0.81), printed_Z(-0.56, 0.71, -0.40);
  EXPECT_GT(std::abs(N.dot(P6.normalized())), 0.35) << "N should stand at right angles to AO";
  EXPECT_GT((printed_X - (-P6.normalized())).norm(), 1.9) << "X_A should point from the stylus to O";
  EXPECT_GT((printed_Z - N).norm(), 1.5) << "Z_A should be N";
  const ArmState arm = arm_state(thesis::example());
  EXPECT_LT((arm.X_WS.p - P6).norm(), 1.5e-3) << "the position itself is right";
  const Vec3 ours_X = -arm.X_WS.p.normalized(), ours_N = ours_X.cross(arm.X_WS.R.col(2)).normalized();
  EXPECT_LT((ours_X - Vec3(-0.171, 0.556, 0.813)).norm(), 1e-3);
  EXPECT_NEAR(std::abs(ours_N.dot(arm.J_WS.col(3).tail<3>())), 1, 1e-12) << "N is the elbow's axis";
  EXPECT_NEAR(ours_N.dot(arm.elbow_W), 0, 1e-12) << "(2.15)";
}

TEST(ThesisErrata, Table21IsTheRegionOfALinkThatJustTouchesItsRing) {
  const SweptExtent swept = sweep_extent(60);
  EXPECT_NEAR(swept.ring.sizes().x(), 0.449, 0.003) << "l3, width";
  EXPECT_NEAR(swept.ring.sizes().z(), 0.318, 0.003) << "l6, height";
  EXPECT_LT(swept.clear.sizes().x(), 0.400) << "with link and legs as thick as they may be it is less";
  EXPECT_LT(swept.clear.sizes().z(), 0.300);
  EXPECT_GT(swept.limits.sizes().x(), 0.530) << "the limits of table 2.4 alone would give far more";
  // By hand: the link leans to the ring (acos 1/sqrt3 from its axis) with the arm stretched, half of the width.
  EXPECT_NEAR(swept.ring.sizes().x(), 2 * (kLink1 + kLink2) * std::sin(std::acos(1 / std::sqrt(3.0))), 0.004);
}

TEST(ThesisErrata, VolumeIsNotThatOfTheBoxOfTable21) {
  const WorkspaceGrid grid(0.016, 36);
  const double box = 0.449 * 0.449 * 0.318;
  EXPECT_LT(grid.volume_m3(ReachSet::kRing), 0.3 * box) << "the region is a shell";
  EXPECT_LT(grid.volume_m3(ReachSet::kLimitsClear), 0.381 * 0.191 * 0.267) << "less than the PHANTOM's box";
  EXPECT_GT(grid.volume_m3(ReachSet::kLimitsClear), 0.120 * 0.120 * 0.120) << "more than the Virtuose's";
  EXPECT_LT(grid.box_scale(ReachSet::kLimits, {0.449, 0.449, 0.318}), 0.5);
}

TEST(ThesisErrata, Section342TakesACommandForTheVoltageAtTheLeads) {
  // At stall nobody can tell the two apart; a turning motor shows it.
  EXPECT_NEAR(driven_motor(5, 0).torque_nm, driven_motor_at_leads(5, 0).torque_nm, 2e-5);
  const double speed = 1500 * 2 * std::numbers::pi / 60;
  EXPECT_NEAR(driven_motor(5, speed).torque_nm, 0.050, 1e-4);
  EXPECT_NEAR(driven_motor_at_leads(5, speed).torque_nm, (5 - 0.0232 * speed) / 2.32 * 0.0232, 1e-6);
  EXPECT_LT(driven_motor_at_leads(5, speed).torque_nm, 0.3 * driven_motor(5, speed).torque_nm);
  // The supply of 24 V ends it where 24 = R i + k w.
  const double current = 5 * 0.431, ends = (24 - 2.32 * current) / 0.0232;
  EXPECT_NEAR(driven_motor(5, ends - 1).current_a, current, 1e-6);
  EXPECT_LT(driven_motor(5, ends + 20).current_a, current - 0.1);
}

}  // namespace
}  // namespace trocar::errata_studies_test
