// Triangular rings and pegs: distances in closed form, how a ring comes to rest, and how it is carried past a peg.
#include <gtest/gtest.h>

#include <cmath>

#include "tissue/rigid/block_dynamics.h"
#include "tissue/rigid/body_contact.h"
#include "tissue/rigid/foam_grip.h"

namespace trocar::ring_on_peg_test {
namespace {

constexpr double kSide = 0.018, kHole = 0.0045, kHalfHeight = 0.005, kPeg = 0.0016, kPegHeight = 0.025;
const double kInside = kSide / (2 * std::sqrt(3.0));
const std::vector<PegPost> kOnePeg{{Vec3::Zero(), kPeg, kPegHeight}};

Mat3 turned(double angle, const Vec3& about) { return Eigen::AngleAxisd(angle, about).toRotationMatrix(); }

RigidBody ring_at(const Vec3& middle, const Mat3& R = Mat3::Identity()) {
  RigidBody ring;
  ring.half = Vec3(1.5 * kInside, 1.5 * kInside, kHalfHeight);
  ring.hole_radius_m = kHole;
  ring.mass_kg = 0.002;
  ring.X_TB = {R, middle};
  ring.wake();
  return ring;
}

RigidBody fallen(const Vec3& from, const Mat3& R = Mat3::Identity()) {
  std::vector<RigidBody> bodies{ring_at(from, R)};
  BlockDynamics dynamics({.pegs = kOnePeg});
  for (int i = 0; i < 100 && !bodies[0].asleep; ++i) dynamics.step(bodies, {}, 0.01);
  EXPECT_TRUE(bodies[0].asleep);
  return bodies[0];
}

double deepest(const RigidContacts& touch) {
  double depth = 0;
  for (int c = 0; c < touch.count; ++c) depth = std::max(depth, touch.at[static_cast<std::size_t>(c)].depth_m);
  return depth;
}

TEST(CapsuleRing, APegInTheHoleMeetsItsWallBeyondItsPlay) {
  const CapsuleShape peg = capsule_of(kOnePeg[0]);
  for (const double off : {0.0, 0.001, kHole - kPeg - 1e-6})
    EXPECT_EQ(capsule_ring(peg, ring_at(Vec3(off, 0, kHalfHeight)).ring()).count, 0) << off;
  const RigidContacts touch = capsule_ring(peg, ring_at(Vec3(kHole - kPeg + 0.0005, 0, kHalfHeight)).ring());
  ASSERT_EQ(touch.count, 2) << "over its whole height";
  EXPECT_NEAR(deepest(touch), 0.0005, 1e-9);
  EXPECT_NEAR(touch.at[0].normal_T.x(), 1, 1e-9) << "from the ring's wall to the peg";
}

TEST(CapsuleRing, SidesCornersAndFacesAreWhereTheTriangleHasThem) {
  const RingShape ring = ring_at(Vec3::Zero()).ring();
  const auto upright = [&](double x, double y) {
    return deepest(capsule_ring({Vec3(x, y, -0.02), Vec3(x, y, 0.02), 0.001}, ring));
  };
  EXPECT_NEAR(upright(0, -kInside - 0.0006), 0.0004, 1e-9) << "beside a side";
  EXPECT_NEAR(upright(0, 2 * kInside + 0.0006), 0.0004, 1e-9) << "before a corner";
  EXPECT_EQ(upright(0, -kInside - 0.0011), 0);
  const Vec3 end(0, 0.007, kHalfHeight + 0.0006);  // over the wall, between hole and corner
  const RigidContacts above = capsule_ring({end, end + Vec3(0, 0, 0.02), 0.001}, ring);
  ASSERT_EQ(above.count, 1);
  EXPECT_NEAR(above.at[0].depth_m, 0.0004, 1e-9);
  EXPECT_NEAR(above.at[0].normal_T.z(), 1, 1e-9);
}

TEST(RingOnPeg, ThatFallsNearItsMiddleComesToLieRoundIt) {
  for (const double off : {0.0, 0.0025}) {
    const RigidBody ring = fallen(Vec3(off, 0, 0.040));
    EXPECT_NEAR(ring.X_TB.p.x(), off, 2e-4) << "it meets nothing on its way";
    EXPECT_NEAR(ring.X_TB.p.z(), kHalfHeight, 1e-4);
  }
  const RigidBody askew = fallen(Vec3(0, 0, 0.035), turned(0.35, Vec3::UnitX()));
  EXPECT_NEAR(askew.X_TB.p.z(), kHalfHeight, 1e-4);
  EXPECT_LT(askew.X_TB.p.head<2>().norm(), kHole - kPeg + 1e-4);
}

TEST(RingOnPeg, ThatFallsOnItsTopTipsOffIt) {
  const RigidBody ring = fallen(Vec3(0.007, 0, 0.040));
  EXPECT_GT(ring.X_TB.p.head<2>().norm(), kInside + kPeg) << "beside the peg";
  EXPECT_LT(ring.X_TB.p.z(), 0.008);
}

TEST(RingOnPeg, ComesOffUpwardsOnly) {
  RigidBody ring = ring_at(Vec3(0, 0, kHalfHeight));
  for (int i = 0; i < 50; ++i) carry_past(kOnePeg, Vec3(0.02, 0.01, kHalfHeight), ring);
  EXPECT_LT(ring.X_TB.p.head<2>().norm(), kHole - kPeg + 1e-5) << "however often it is pulled aside";
  carry_past(kOnePeg, Vec3(0, 0, 0.034), ring);
  carry_past(kOnePeg, Vec3(0.02, 0, 0.034), ring);
  EXPECT_NEAR(ring.X_TB.p.x(), 0.02, 1e-9);
}

TEST(RingOnPeg, StaysOnTopOfAPegThatMeetsItsWall) {
  RigidBody ring = ring_at(Vec3(0, -0.007, 0.040));
  carry_past(kOnePeg, Vec3(0, -0.007, kHalfHeight), ring);
  EXPECT_GT(ring.X_TB.p.z(), kPegHeight + kHalfHeight - 0.001);
}

TEST(RingRing, TouchWhereACornerMeetsASide) {
  const RingShape a = ring_at(Vec3::Zero()).ring();
  const auto depth = [&](double y) { return deepest(ring_ring(a, ring_at(Vec3(0, y, 0)).ring(), 0)); };
  EXPECT_NEAR(depth(3 * kInside - 0.0003), 0.0003, 1e-5);
  EXPECT_EQ(depth(3 * kInside + 0.0003), 0);
}

/// Jaws round a ring on its peg: from above, the pads across x.
struct Jaws {
  std::vector<RigidBody> bodies{ring_at(Vec3(0, 0, kHalfHeight))};
  std::vector<Foam> foams;
  FoamGrip grip;
  JawReading jaws;
  RigidMaterial board;

  Jaws() {
    FoamBlock spec;
    spec.size_m = 2 * bodies[0].half;
    spec.hole_radius_m = kHole;
    spec.stiffness_n_per_m = 600;
    spec.slip_below_n = 1.2;
    spec.crush_above_n = 3.5;
    spec.crushed_thickness = spec.crushed_stiffness = 1;
    foams.push_back({spec, 600, false});
    jaws.X_TI.R << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    jaws.X_TI.p = Vec3(0, 0, 0.004);
    jaws.opening_m = 0.020;
    step(0);
    step(2);
  }
  void step(double grip_n) {
    jaws.grip_n = grip_n;
    if (grip_n > 0) jaws.opening_m = 3 * kInside - grip_n / 600;
    grip.update(jaws, board, 0, kOnePeg, 0.01, bodies, foams);
  }
  void move(const Vec3& by, int steps, double grip_n = 2) {
    for (int i = 0; i < steps; ++i) {
      jaws.X_TI.p += by / steps;
      step(grip_n);
    }
  }
  Vec3 at() const { return bodies[0].X_TB.p; }
};

TEST(RingInJaws, IsAsThickAsItsTriangleIsHighHoweverItIsTurned) {
  for (const double turn : {0.0, 0.4, 0.9}) {
    Jaws rig;
    rig.bodies[0].X_TB.R = turned(turn, Vec3::UnitZ());
    EXPECT_NEAR(rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI).thickness_m, kSide * std::sqrt(3.0) / 2, 1e-12);
  }
}

TEST(RingInJaws, FeelsNothingOnTheWayUpAndThePegWhenPulledAside) {
  Jaws rig;
  ASSERT_EQ(rig.grip.state(), GripState::kHolding);
  rig.move(Vec3(0, 0, 0.010), 20);
  EXPECT_EQ(rig.grip.hold(rig.bodies, 250).stiffness_n_per_m, 0) << "it hangs free";
  rig.move(Vec3(0.006, 0, 0), 20);
  const GripHold hold = rig.grip.hold(rig.bodies, 250);
  ASSERT_EQ(hold.stiffness_n_per_m, 250);
  const Vec3 force = 250 * (hold.anchor_T - rig.jaws.X_TI * hold.point_I);
  EXPECT_NEAR(force.x(), -250 * (0.006 - (kHole - kPeg)), 0.01) << "back to the peg";
  EXPECT_NEAR(rig.at().x(), kHole - kPeg, 1e-5);
  rig.move(Vec3(0, 0, 0.030), 60);
  EXPECT_EQ(rig.grip.hold(rig.bodies, 250).stiffness_n_per_m, 0) << "off the peg it is free again";
}

TEST(RingInJaws, IsPushedThroughThePadsByWhatPressesHarderThanTheyHold) {
  Jaws rig;
  rig.move(Vec3(0, 0, 0.010), 20);
  rig.move(Vec3(0.030, 0, 0), 60);
  const GripHold hold = rig.grip.hold(rig.bodies, 250);
  EXPECT_NEAR(250 * (hold.anchor_T - rig.jaws.X_TI * hold.point_I).norm(), 2 * 0.83 * 2, 0.02);
}

TEST(RingInJaws, IsMarkedByATightGripAndSpringsBack) {
  Jaws rig;
  rig.step(4);
  EXPECT_TRUE(rig.foams[0].crushed);
  EXPECT_NEAR(2 * rig.bodies[0].half.x(), 3 * kInside, 1e-12);
  EXPECT_EQ(rig.foams[0].stiffness_n_per_m, 600);
}

}  // namespace
}  // namespace trocar::ring_on_peg_test
