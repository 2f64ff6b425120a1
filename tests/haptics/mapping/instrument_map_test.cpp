// The map between stylus and instrument: power conjugate, invertible, consistent with motion.
#include <gtest/gtest.h>

#include "haptics/mapping/instrument_map.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::instrument_map_test {
namespace {

using test::Random;

InstrumentMap random_map(Random& random) {
  InstrumentMap map;
  map.X_TW = random.pose(0.3);
  map.X_SI = random.pose(0.1);
  map.motion_scale = random.between(0.3, 3);
  map.force_scale = random.between(0.05, 1);
  return map;
}

double power(const Wrench& F, const Twist& V) { return F.force.dot(V.linear) + F.moment.dot(V.angular); }

TEST(InstrumentMap, RenderedPowerIsKappaTimesScenePower) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const InstrumentMap map = random_map(random);
    const Pose X_WS = random.pose(0.25);
    const Twist V{random.vector(1), random.vector(3)};
    const Wrench F{random.vector(5), random.vector(0.5)};
    // Virtual work, 1e-9: exact but for rounding of products of order 10.
    EXPECT_NEAR(power(map.stylus_wrench(X_WS, F), V), map.force_scale * power(F, map.instrument_twist(X_WS, V)), 1e-9);
  }
}

TEST(InstrumentMap, WrenchMapIsTheTransposeOfTheVelocityMapTimesKappa) {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const InstrumentMap map = random_map(random);
    const Pose X_WS = random.pose(0.25);
    Mat6 velocity, wrench;
    for (int i = 0; i < 6; ++i) {
      const Vec6 e = Vec6::Unit(i);
      const Twist V = map.instrument_twist(X_WS, {e.head<3>(), e.tail<3>()});
      const Wrench F = map.stylus_wrench(X_WS, {e.head<3>(), e.tail<3>()});
      velocity.col(i) << V.linear, V.angular;
      wrench.col(i) << F.force, F.moment;
    }
    EXPECT_LT((wrench - map.force_scale * velocity.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(InstrumentMap, StylusPoseInvertsInstrumentPose) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const InstrumentMap map = random_map(random);
    const Pose X_WS = random.pose(0.25), back = map.stylus_pose(map.instrument_pose(X_WS));
    EXPECT_LT((back.p - X_WS.p).norm(), 1e-14);
    EXPECT_LT((back.R - X_WS.R).norm(), 1e-13);
  }
}

TEST(InstrumentMap, TwistIsTheDerivativeOfThePose) {
  Random random(4);
  constexpr double h = 1e-6;  // central: h^2 = 1e-12, rounding 1e-16 / h = 1e-10
  for (int k = 0; k < 500; ++k) {
    const InstrumentMap map = random_map(random);
    const Pose X = random.pose(0.25);
    const Twist V{random.vector(1), random.vector(3)};
    const auto moved = [&](double t) {
      const double angle = V.angular.norm() * t;
      return map.instrument_pose({Eigen::AngleAxisd(angle, V.angular.normalized()) * X.R, X.p + V.linear * t});
    };
    const Pose a = moved(-h), b = moved(h);
    const Twist mapped = map.instrument_twist(X, V);
    EXPECT_LT(((b.p - a.p) / (2 * h) - mapped.linear).norm(), 1e-8);
    const Eigen::AngleAxisd turn(Mat3(b.R * a.R.transpose()));
    EXPECT_LT((turn.axis() * turn.angle() / (2 * h) - mapped.angular).norm(), 1e-8);
  }
}

TEST(InstrumentMap, PlainMapChangesNothing) {
  Random random(5);
  const InstrumentMap map;
  const Pose X = random.pose(0.2);
  const Wrench F{random.vector(2), random.vector(1)};
  EXPECT_EQ((map.instrument_pose(X).p - X.p).norm(), 0);
  EXPECT_LT((map.stylus_wrench(X, F).force - F.force).norm(), 1e-15);
  EXPECT_LT((map.stylus_wrench(X, F).moment - F.moment).norm(), 1e-15);
}

TEST(InstrumentMap, ScaleTwoMovesTwiceAsFarAndPushesTwiceAsHard) {
  InstrumentMap map;
  map.motion_scale = 2;
  const Pose X{Mat3::Identity(), Vec3(0.01, 0.02, 0.03)};
  EXPECT_LT((map.instrument_pose(X).p - Vec3(0.02, 0.04, 0.06)).norm(), 1e-16);
  EXPECT_LT((map.stylus_wrench(X, {Vec3(1, 0, 0), Vec3::Zero()}).force - Vec3(2, 0, 0)).norm(), 1e-15);
}

TEST(InstrumentMap, ForceOnALongTipTurnsTheHand) {
  InstrumentMap map;
  map.X_SI.p = Vec3(0, 0, 0.1);
  const Wrench F = map.stylus_wrench({}, {Vec3(1, 0, 0), Vec3::Zero()});
  EXPECT_LT((F.moment - Vec3(0, 0.1, 0)).norm(), 1e-15);  // r x F by hand
}

}  // namespace
}  // namespace trocar::instrument_map_test
