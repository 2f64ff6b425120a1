// Room behind the instrument's tip against formulas: a ball, a wall's edge, a port; every capsule is asked.
#include "scenarios/layout/shaft_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/least_turn.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::shaft_room_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Instrument whose shaft comes from `from_T`, seen from the tip.
Mat3 pointing_from(const Vec3& from_T) { return least_turn(Vec3::UnitZ(), -from_T).toRotationMatrix(); }

TEST(ShaftRoom, BesideABallTheGapFollowsTheLawOfCosines) {
  constexpr double kBall = 0.05;
  const TriangleSurface ball = test::sphere(Vec3::Zero(), kBall, 6);
  const ToolShape probe;
  for (int degrees = 0; degrees <= 85; degrees += 17) {
    const double angle = degrees * kPi / 180;  // between the normal and the shaft
    const ShaftRoom room(ball, probe, pointing_from(Vec3(std::sin(angle), 0, std::cos(angle))));
    const double tip = kBall + probe.radius_m, s = ShaftRoom::kNearTip;
    const double expected = std::sqrt(tip * tip + s * s + 2 * tip * s * std::cos(angle)) - tip;
    EXPECT_NEAR(room.gap_m(kBall * Vec3::UnitZ(), Vec3::UnitZ()), expected, 1e-4) << degrees << " degrees";
  }
}

TEST(ShaftRoom, TheEdgeOfAWallIsMetAtItsDistanceFromTheAxis) {
  const ToolShape probe;
  for (const double height : {0.010, 0.020, 0.030}) {
    const double away = 0.025, elevation = 50 * kPi / 180;
    const TriangleSurface wall = test::box(Vec3(away, -0.2, -0.01), Vec3(away + 0.2, 0.2, height));
    const ShaftRoom room(wall, probe, pointing_from(Vec3(std::cos(elevation), 0, std::sin(elevation))));
    const double axis_height = probe.radius_m + away * std::tan(elevation);  // of the axis above the edge's foot
    const double expected = (axis_height - height) * std::cos(elevation) - probe.radius_m;
    const double found = room.gap_m(Vec3::Zero(), Vec3::UnitZ());
    if (axis_height > height)
      EXPECT_NEAR(found, expected, 1e-9) << height;
    else
      EXPECT_NEAR(found, -probe.radius_m, 1e-9) << "it would pass through the wall";
    EXPECT_EQ(room.free(Vec3::Zero(), Vec3::UnitZ()), expected >= ShaftRoom::kLeastGap);
  }
}

TEST(ShaftRoom, FarAwayItIsAsFarAsIsTold) {
  const TriangleSurface ball = test::sphere(Vec3(1, 1, 1), 0.05, 2);
  EXPECT_EQ(ShaftRoom(ball, {}, Mat3::Identity()).gap_m(Vec3::Zero()), ShaftRoom::kFarthest);
}

TEST(ShaftRoom, OfAGrasperTheThinJawsAndTheThickShaftAreAsked) {
  const TriangleSurface ground = test::box(Vec3(-0.5, -0.5, -0.1), Vec3(0.5, 0.5, 0));
  ToolShape grasper;
  grasper.jaw_length_m = 0.020;
  const double elevation = 6 * kPi / 180, tip = 0.004;
  const ShaftRoom room(ground, grasper, pointing_from(Vec3(std::cos(elevation), 0, std::sin(elevation))));
  const double hinge = tip + grasper.jaw_length_m * std::sin(elevation) - grasper.radius_m;
  const double jaw = tip + ShaftRoom::kNearTip * std::sin(elevation) - 2 * grasper.jaw_radius_m;
  const double found = room.gap_m(Vec3(0, 0, tip));
  EXPECT_LE(found, hinge + 1e-9);
  EXPECT_GE(found, std::min(hinge, jaw) - 1e-9) << "no jaw lies lower than its diameter under the axis";
}

TEST(ShaftRoom, ThroughAPortTheShaftPassesIt) {
  InstrumentMap map;
  Fulcrum fulcrum;
  fulcrum.port_T = Vec3(0.05, -0.05, 0.12);
  fulcrum.R_TI_reference = pointing_from(fulcrum.port_T.normalized());
  map.fulcrum = fulcrum;
  const TriangleSurface wall = test::box(Vec3(0.010, -0.2, -0.01), Vec3(0.012, 0.2, 0.030));
  const ShaftRoom room(wall, {}, map);
  for (const Vec3& tip :
       {Vec3(0, 0, 0.004), Vec3(-0.02, 0.01, 0.01), Vec3(-0.03, -0.02, 0.002), Vec3(0.03, 0.02, 0.01)}) {
    const ShaftRoom straight(wall, {}, pointing_from((fulcrum.port_T - tip).normalized()));
    EXPECT_NEAR(room.gap_m(tip), straight.gap_m(tip), 1e-9);
  }
}

TEST(ShaftRoom, WithoutAPortTheInstrumentKeepsItsRest) {
  InstrumentMap map;
  map.X_TW.R = Eigen::AngleAxisd(0.7, Vec3(0.2, 0.5, 0.8).normalized()).toRotationMatrix();
  const TriangleSurface ball = test::sphere(Vec3(0.02, 0, 0), 0.03, 4);
  const ShaftRoom room(ball, {}, map), rest(ball, {}, map.instrument_pose(home_pose()).R);
  for (const Vec3& tip : {Vec3(0, 0.03, 0.02), Vec3(0.05, 0.04, -0.02), Vec3(-0.03, 0, 0.02)})
    EXPECT_EQ(room.gap_m(tip), rest.gap_m(tip));
}

}  // namespace
}  // namespace trocar::shaft_room_test
