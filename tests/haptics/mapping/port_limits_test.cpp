// The port's lever at chosen depths, its friction by hand, mirrored maps, and clutch and hold together.
#include <gtest/gtest.h>

#include "haptics/mapping/instrument_coupling.h"
#include "haptics/mapping/port_forces.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::port_limits_test {
namespace {

using test::Random;

constexpr double kTick = 1e-3;
const Vec3 kPort(0, 0, 0.12);

Fulcrum upright() {
  Fulcrum f;
  f.port_T = kPort;
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  return f;
}

InstrumentMap port_map() {
  InstrumentMap map;
  map.fulcrum = upright();
  return map;
}

Pose stylus_above(double distance_m) { return {Mat3::Identity(), kPort + Vec3(0, 0, distance_m)}; }

TEST(FulcrumLever, TheTipIsAsFarBelowThePortAsTheRestOfTheShaft) {
  const Fulcrum f = upright();
  for (const double d : {0.02, 0.1, 0.15, 0.29}) {
    const Pose X = f.instrument_pose(stylus_above(d));
    EXPECT_NEAR(f.distance_m(stylus_above(d).p), d, 1e-15);
    EXPECT_LT((X.p - (kPort - Vec3(0, 0, f.length_m - d))).norm(), 1e-15) << d;
    EXPECT_LT((X.R - f.R_TI_reference).norm(), 1e-15);
  }
}

TEST(FulcrumLever, SidewaysSpeedAndForceAreThoseOfALever) {
  const Fulcrum f = upright();
  for (const double d : {0.05, 0.15, 0.25}) {
    const double ratio = (f.length_m - d) / d;
    const Twist tip = f.instrument_twist(stylus_above(d), {Vec3(0.01, -0.02, 0.03), Vec3::Zero()});
    EXPECT_LT((tip.linear - Vec3(-0.01 * ratio, 0.02 * ratio, 0.03)).norm(), 1e-15) << d;
    EXPECT_LT((tip.angular - Vec3(0.02, 0.01, 0) / d).norm(), 1e-12) << "the handle goes round the port";
    const Wrench hand = f.handle_wrench(stylus_above(d), {Vec3(1, 2, 3), Vec3::Zero()});
    EXPECT_LT((hand.force - Vec3(-ratio, -2 * ratio, 3)).norm(), 1e-12);
    EXPECT_EQ(hand.moment.norm(), 0);
  }
}

TEST(FulcrumLever, AtThePortItselfTheTipFeelsNothingSideways) {
  const Fulcrum f = upright();
  const Pose X = stylus_above(f.length_m);
  EXPECT_LT((f.instrument_pose(X).p - kPort).norm(), 1e-15);
  EXPECT_LT(f.instrument_twist(X, {Vec3(0.1, 0.2, 0), Vec3::Zero()}).linear.norm(), 1e-15);
  EXPECT_LT(f.handle_wrench(X, {Vec3(1, 2, 0), Vec3::Zero()}).force.norm(), 1e-15);
}

TEST(FulcrumLever, OnlyTheRollOfTheStylusTurnsTheInstrument) {
  const Fulcrum f = upright();
  const auto turned = [&](double angle, const Vec3& axis) {
    return f.instrument_pose({Eigen::AngleAxisd(angle, axis).toRotationMatrix(), stylus_above(0.15).p}).R;
  };
  EXPECT_LT((turned(0.6, Vec3::UnitX()) - f.R_TI_reference).norm(), 1e-15) << "a swing does nothing";
  const Mat3 rolled = turned(0.6, Vec3::UnitZ());
  EXPECT_NEAR(test::turn_between(f.R_TI_reference, rolled), 0.6, 1e-12);
  EXPECT_LT((rolled.col(2) - Vec3(0, 0, -1)).norm(), 1e-15) << "about its own shaft";
}

TEST(FulcrumLever, ATipDrawnBackOutOfThePortIsReachedFromOutside) {
  const Fulcrum f = upright();
  const Vec3 outside = kPort + Vec3(0.002, 0.001, 0.03);
  const Pose X_TS = f.mapped_stylus({f.R_TI_reference, outside});
  EXPECT_GT(f.distance_m(X_TS.p), f.length_m);
  EXPECT_LT((f.instrument_pose(X_TS).p - outside).norm(), 1e-12);
}

TEST(PortFrictionByHand, FirstCallAndResetTakeTheDepthAsItIs) {
  PortForces port({});
  const Vec3 u(0, 0, -1);
  EXPECT_EQ(port.friction(0.3, 2.0, u).force.norm(), 0);
  EXPECT_EQ(port.stored_j(), 0);
  port.friction(0.4, 1.0, u);
  EXPECT_GT(port.stored_j(), 0);
  port.reset();
  const Wrench after = port.friction(0.1, 1.0, u);
  EXPECT_EQ(after.force.norm() + after.moment.norm(), 0) << "the 300 mm between were no slide";
  EXPECT_EQ(port.stored_j(), 0);
}

TEST(PortFrictionByHand, ForceAndMomentLieAlongTheShaftWithLimitsOfTheirOwn) {
  Random random(4);
  PortParameters parameters;
  parameters.axial_friction_n = 1.2;
  parameters.roll_friction_n_m = 3e-3;
  parameters.axial_stiffness_n_per_m = 600;
  parameters.roll_stiffness_n_m_per_rad = 0.05;
  for (int k = 0; k < 100; ++k) {
    PortForces port(parameters);
    const Vec3 u = random.direction();
    port.friction(0.1, 0, u);
    const Wrench stuck = port.friction(0.101, -0.02, u);
    EXPECT_LT((stuck.force + 0.6 * u).norm(), 1e-12);
    EXPECT_LT((stuck.moment - 1e-3 * u).norm(), 1e-15);
    EXPECT_NEAR(port.stored_j(), 0.5 * 600 * 1e-6 + 0.5 * 0.05 * 4e-4, 1e-15);
    const Wrench slid = port.friction(0.15, 0, u);
    EXPECT_LT((slid.force + 1.2 * u).norm(), 1e-12);
    EXPECT_LT((slid.moment - 1e-3 * u).norm(), 1e-15) << "the slide does not loosen the roll";
    EXPECT_LT((port.friction(0.15, -3, u).moment - 3e-3 * u).norm(), 1e-15);
  }
}

TEST(AlignmentSpring, IsNotScaledByTheForceScaleAndIsOffWithoutAPort) {
  InstrumentMap map = port_map();
  const Pose X_WS{Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix(), Vec3(0.02, 0.01, 0.27)};
  const Wrench full = alignment_wrench(map, X_WS, 0.3);
  ASSERT_GT(full.moment.norm(), 0.01);
  map.force_scale = 0.25;
  const Wrench scaled = alignment_wrench(map, X_WS, 0.3);
  EXPECT_EQ(scaled.force, full.force);
  EXPECT_EQ(scaled.moment, full.moment);
  EXPECT_LT((alignment_wrench(map, X_WS, 0.6).moment - 2 * full.moment).norm(), 1e-15);
  map.fulcrum.reset();
  EXPECT_EQ(alignment_wrench(map, X_WS, 0.3).moment.norm(), 0);
  EXPECT_EQ(alignment_energy_j(map, X_WS, 0.3), 0);
}

TEST(AlignmentSpring, StraightAboveThePortItsEnergyIsThatOfTheTilt) {
  const InstrumentMap map = port_map();
  for (const double tilt : {0.0, 0.2, 0.7}) {
    const Pose X_WS{Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix(), stylus_above(0.15).p};
    EXPECT_NEAR(alignment_energy_j(map, X_WS, 0.5), 0.5 * (1 - std::cos(tilt)), 1e-15);
    EXPECT_NEAR(alignment_wrench(map, X_WS, 0.5).moment.y(), -0.5 * std::sin(tilt), 1e-15) << "turns it back";
  }
}

InstrumentMap lopsided(Random& random, bool port) {
  InstrumentMap map;
  map.X_TW = random.pose(0.2);
  map.X_SI = random.pose(0.1);
  map.motion_scale = random.between(0.5, 2);
  map.force_scale = random.between(0.1, 1);
  map.registration = {random.vector(0.1), random.rotation()};
  if (!port) return map;
  map.fulcrum = Fulcrum{random.vector(0.1), 0.35, random.rotation(), random.rotation()};
  return map;
}

TEST(MirroredMap, TwiceItIsTheMapAgainAndScalesStay) {
  Random random(6);
  for (int k = 0; k < 200; ++k) {
    const InstrumentMap map = lopsided(random, k % 2 == 0), once = mirrored(map), twice = mirrored(once);
    EXPECT_EQ(once.motion_scale, map.motion_scale);
    EXPECT_EQ(once.force_scale, map.force_scale);
    EXPECT_EQ(once.X_TW.p, Vec3(-map.X_TW.p.x(), map.X_TW.p.y(), map.X_TW.p.z()));
    EXPECT_NEAR(once.X_TW.R.determinant(), 1, 1e-12) << "a rotation, not a reflection";
    EXPECT_LT((twice.X_TW.R - map.X_TW.R).norm() + (twice.X_SI.p - map.X_SI.p).norm(), 1e-12);
    EXPECT_LT((twice.registration.turn - map.registration.turn).norm(), 1e-12);
    ASSERT_EQ(once.fulcrum.has_value(), map.fulcrum.has_value());
    if (!map.fulcrum) continue;
    EXPECT_EQ(once.fulcrum->length_m, 0.35);
    EXPECT_EQ(once.fulcrum->port_T.x(), -map.fulcrum->port_T.x());
    EXPECT_LT((twice.fulcrum->R_TI_reference - map.fulcrum->R_TI_reference).norm(), 1e-12);
  }
}

TEST(MirroredMap, TheTipGoesRightWhereTheOtherGoesLeft) {
  Random random(8);
  const Mat3 M = Vec3(-1, 1, 1).asDiagonal();
  for (int k = 0; k < 200; ++k) {
    const InstrumentMap map = lopsided(random, false), left = mirrored(map);
    const Pose X = random.pose(0.1), seen{M * X.R * M, M * X.p};
    const Twist V{random.vector(1), random.vector(3)};
    const Twist a = map.instrument_twist(X, V), b = left.instrument_twist(seen, {M * V.linear, -(M * V.angular)});
    EXPECT_LT((M * a.linear - b.linear).norm(), 1e-12);
    EXPECT_LT((-(M * a.angular) - b.angular).norm(), 1e-12) << "a spin is axial";
  }
}

TEST(ClutchStates, ResetForgetsWhatClutchingHasAdded) {
  InstrumentCoupling coupling(port_map());
  coupling.update(stylus_above(0.15), {}, false, kTick);
  const Pose first = coupling.X_TI();
  for (int k = 0; k < 3; ++k) coupling.update(stylus_above(0.10), {}, true, kTick);
  coupling.update(stylus_above(0.10), {}, false, kTick);
  EXPECT_LT((coupling.map().registration.shift_T - Vec3(0, 0, 0.05)).norm(), 1e-12);
  EXPECT_LT(coupling.share(), 1);
  coupling.reset();
  EXPECT_EQ(coupling.share(), 1);
  coupling.update(stylus_above(0.15), {}, false, kTick);
  EXPECT_EQ(coupling.X_TI().p, first.p);
  EXPECT_EQ(coupling.map().registration.shift_T.norm(), 0);
}

TEST(ClutchStates, RepeatedStrokesAddUp) {
  InstrumentCoupling coupling(port_map());
  coupling.update(stylus_above(0.20), {}, false, kTick);
  const double start = coupling.X_TI().p.z();
  for (int stroke = 1; stroke <= 4; ++stroke) {
    coupling.update(stylus_above(0.16), {}, false, kTick);
    EXPECT_NEAR(coupling.X_TI().p.z(), start - 0.04 * stroke, 1e-12);
    coupling.update(stylus_above(0.20), {}, true, kTick);
    coupling.update(stylus_above(0.20), {}, false, kTick);
  }
  EXPECT_NEAR(coupling.map().registration.shift_T.z(), -0.16, 1e-12);
}

TEST(ClutchStates, AHoldFadesTheForceLikeTheClutchAndIsNotOne) {
  InstrumentCoupling coupling(port_map());
  coupling.update(stylus_above(0.05), {}, false, kTick);
  for (int k = 1; k <= 25; ++k) coupling.update(stylus_above(0.019), {Vec3(0, 0, -1), Vec3::Zero()}, false, kTick);
  EXPECT_TRUE(coupling.held() && coupling.frozen());
  EXPECT_FALSE(coupling.clutched());
  EXPECT_NEAR(coupling.share(), 0.5, 1e-12);
  EXPECT_EQ(coupling.V_TI_T().linear.norm(), 0);
  for (int k = 1; k <= 40; ++k) coupling.update(stylus_above(0.019), {}, false, kTick);
  EXPECT_EQ(coupling.share(), 0);
}

TEST(ClutchStates, TheClutchFreesAHeldInstrumentFromThePort) {
  InstrumentCoupling coupling(port_map());
  coupling.update(stylus_above(0.021), {}, false, kTick);
  const Vec3 deepest = coupling.X_TI().p;
  coupling.update(stylus_above(0.010), {}, false, kTick);
  ASSERT_TRUE(coupling.held());
  coupling.update(stylus_above(0.010), {}, true, kTick);
  EXPECT_TRUE(coupling.clutched());
  EXPECT_FALSE(coupling.held()) << "one reason at a time";
  coupling.update(stylus_above(0.100), {}, true, kTick);
  coupling.update(stylus_above(0.100), {}, false, kTick);
  EXPECT_FALSE(coupling.frozen());
  EXPECT_LT((coupling.X_TI().p - deepest).norm(), 1e-12);
  EXPECT_LT((coupling.map().mapped_stylus(stylus_above(0.100)).p - stylus_above(0.021).p).norm(), 1e-12);
}

}  // namespace
}  // namespace trocar::port_limits_test
