// The instrument through a port: velocity map against finite differences, wrench map its transpose, inversion, mirror.
#include <gtest/gtest.h>

#include "haptics/least_turn.h"
#include "haptics/mapping/instrument_map.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::fulcrum_test {
namespace {

using test::Random;

/// A map and a stylus pose with the handle at least 30 mm before the port and the shaft within a right angle of its
/// reference: what lies beyond is held (d) or behind the trainee.
struct Case {
  InstrumentMap map;
  Pose X_WS;
};

Case random_case(Random& random) {
  Case c;
  c.map.X_TW = random.pose(0.3);
  c.map.motion_scale = random.between(0.3, 3);
  c.map.force_scale = random.between(0.05, 1);
  c.map.registration = {random.vector(0.1), random.rotation()};
  Fulcrum f;
  f.port_T = random.vector(0.2);
  f.length_m = random.between(0.2, 0.4);
  f.R_TI_reference = random.rotation();
  const Eigen::AngleAxisd aside(random.symmetric(1.2), random.direction());
  const Vec3 u = aside * Vec3(f.R_TI_reference.col(2));
  const Vec3 handle_T = f.port_T - random.between(0.03, 0.4) * u;
  c.X_WS.p = c.map.X_TW.R.transpose() * (handle_T - c.map.registration.shift_T - c.map.X_TW.p) / c.map.motion_scale;
  c.X_WS.R = random.rotation();
  f.R_TS_reference = Eigen::AngleAxisd(random.symmetric(2), random.direction()) * (c.map.X_TW.R * c.X_WS.R);
  c.map.fulcrum = f;
  return c;
}

double power(const Wrench& F, const Twist& V) { return F.force.dot(V.linear) + F.moment.dot(V.angular); }

TEST(Fulcrum, RenderedPowerIsKappaTimesScenePower) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Case c = random_case(random);
    const Twist V{random.vector(1), random.vector(3)};
    const Wrench F{random.vector(5), random.vector(0.5)};
    // Virtual work, 1e-9: exact but for rounding of products of order 100.
    EXPECT_NEAR(power(c.map.stylus_wrench(c.X_WS, F), V),
                c.map.force_scale * power(F, c.map.instrument_twist(c.X_WS, V)), 1e-9);
  }
}

TEST(Fulcrum, TwistIsTheDerivativeOfThePose) {
  Random random(2);
  constexpr double h = 1e-6;  // central: h^2 times third derivatives of order 1/d^3, rounding 1e-16 / h
  for (int k = 0; k < 1000; ++k) {
    const Case c = random_case(random);
    const Twist V{random.vector(0.5), random.vector(2)};
    const auto moved = [&](double t) {
      const Eigen::AngleAxisd turn(V.angular.norm() * t, V.angular.normalized());
      return c.map.instrument_pose({turn * c.X_WS.R, c.X_WS.p + V.linear * t});
    };
    const Pose a = moved(-h), b = moved(h);
    const Twist mapped = c.map.instrument_twist(c.X_WS, V);
    EXPECT_LT(((b.p - a.p) / (2 * h) - mapped.linear).norm(), 1e-6);
    const Eigen::AngleAxisd turn(Mat3(b.R * a.R.transpose()));
    EXPECT_LT((turn.axis() * turn.angle() / (2 * h) - mapped.angular).norm(), 1e-6);
  }
}

TEST(Fulcrum, ItsEquationsAtTheReferenceSwing) {
  // Handle 100 mm over the port, stylus at its reference: v_t = A v_h and F_h = A^T F_t + (u x M_t)/d, M_h = (M_t.u)
  // Z6.
  Fulcrum f;
  f.port_T = Vec3::Zero();
  f.length_m = 0.3;
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  f.R_TS_reference = f.R_TI_reference;
  const Pose X_TS{f.R_TS_reference, Vec3(0, 0, 0.1)};
  const Twist V = f.instrument_twist(X_TS, {Vec3(0.1, 0.2, 0.3), Vec3(0, 0, 5)});
  EXPECT_LT((V.linear - Vec3(-0.2, -0.4, 0.3)).norm(), 1e-15) << "sideways inverted and doubled, along unchanged";
  // u = -z, so -(u x v)/d = z x v / d = (-2, 1, 0), and turning by +5 about z is a roll of -5 about u.
  EXPECT_LT((V.angular - Vec3(-2, 1, 5)).norm(), 1e-12);
  const Wrench F = f.handle_wrench(X_TS, {Vec3(1, 2, 3), Vec3(0.1, 0.2, 0.3)});
  EXPECT_LT((F.force - Vec3(-2 + 2, -4 - 1, 3)).norm(), 1e-12) << "A^T F plus (u x M)/d = (0.2, -0.1, 0)/0.1";
  EXPECT_LT((F.moment - Vec3(0, 0, 0.3)).norm(), 1e-15);
}

TEST(Fulcrum, TheTipMovesAgainstTheHandAndTheShaftStaysInThePort) {
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const Case c = random_case(random);
    const Fulcrum& f = *c.map.fulcrum;
    const Vec3 handle_T = c.map.mapped_stylus(c.X_WS).p;
    const Pose X_TI = c.map.instrument_pose(c.X_WS);
    const Vec3 shaft = X_TI.R * c.map.registration.turn.transpose().col(2);
    EXPECT_LT((handle_T + f.distance_m(handle_T) * shaft - f.port_T).norm(), 1e-12);
    EXPECT_NEAR((X_TI.p - handle_T).norm(), f.length_m, 1e-12);
    const Vec3 aside = shaft.unitOrthogonal();
    const Twist V = c.map.instrument_twist(c.X_WS, {c.map.X_TW.R.transpose() * aside, Vec3::Zero()});
    const double depth = f.length_m - f.distance_m(handle_T);
    if (depth > 1e-3) {
      EXPECT_LT(V.linear.dot(aside), 0);
    }
  }
}

TEST(Fulcrum, StylusPosePutsTheTipAndItsRollWhereTheyAreWanted) {
  Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const Case c = random_case(random);
    const Pose wanted = c.map.instrument_pose(c.X_WS);
    const Pose X_WS = c.map.stylus_pose(wanted);
    const Pose back = c.map.instrument_pose(X_WS);
    EXPECT_LT((X_WS.p - c.X_WS.p).norm(), 1e-12) << "the handle follows from tip and port alone";
    EXPECT_LT((back.p - wanted.p).norm(), 1e-12);
    EXPECT_LT((back.R - wanted.R).norm(), 1e-7);  // the twist comes from atan2 near its ends
    const Vec3 z6 = c.map.X_TW.R * X_WS.R.col(2);
    EXPECT_LT((z6 - c.map.fulcrum->R_TS_reference.col(2)).norm(), 1e-12) << "the stylus keeps its reference swing";
  }
}

TEST(Fulcrum, AClosedWayOfTheHandBringsTheInstrumentBackWithoutATwist) {
  Fulcrum f;
  f.port_T = Vec3(0, 0, 0.12);
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  const Pose start = f.instrument_pose({Mat3::Identity(), Vec3(0.08, 0, 0.27)});
  constexpr int kSteps = 20000;
  Mat3 carried = start.R;  // what roll' = omega_S . Z6 alone would give: carried along without any twist
  double turned = 0;
  for (int k = 1; k <= kSteps; ++k) {
    const double a = 2 * std::numbers::pi * k / kSteps;
    const Pose X{Mat3::Identity(), Vec3(0.08 * std::cos(a), 0.08 * std::sin(a), 0.27)};
    const Vec3 u = f.instrument_pose(X).R.col(2);
    carried = least_turn(carried.col(2), u).toRotationMatrix() * carried;
  }
  turned = test::turn_between(start.R, carried);
  const double half_angle = std::atan2(0.08, 0.15), solid_angle = 2 * std::numbers::pi * (1 - std::cos(half_angle));
  EXPECT_NEAR(turned, solid_angle, 1e-4) << "the twist that was avoided, 42 degrees on this circle";
  EXPECT_LT((f.instrument_pose({Mat3::Identity(), Vec3(0.08, 0, 0.27)}).R - start.R).norm(), 1e-15);
}

TEST(Fulcrum, SeenInAMirrorTheMapIsTheMirroredMap) {
  Random random(5);
  const Mat3 M = Vec3(-1, 1, 1).asDiagonal();
  const auto mirror = [&](const Pose& X) { return Pose{M * X.R * M, M * X.p}; };
  for (int k = 0; k < 500; ++k) {
    Case c = random_case(random);
    if (k % 2 == 0) {
      c.map.fulcrum.reset();
      c.map.X_SI = random.pose(0.1);
    }
    const InstrumentMap left = mirrored(c.map);
    const Pose a = mirror(c.map.instrument_pose(c.X_WS)), b = left.instrument_pose(mirror(c.X_WS));
    EXPECT_LT((a.p - b.p).norm(), 1e-12);
    EXPECT_LT((a.R - b.R).norm(), 1e-9);
    const Wrench F{random.vector(5), random.vector(0.5)};
    const Wrench at = c.map.stylus_wrench(c.X_WS, F);
    const Wrench seen = left.stylus_wrench(mirror(c.X_WS), {M * F.force, -(M * F.moment)});  // moments are axial
    EXPECT_LT((M * at.force - seen.force).norm(), 1e-9);
    EXPECT_LT((-(M * at.moment) - seen.moment).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace trocar::fulcrum_test
