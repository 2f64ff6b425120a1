// A free box by hand, and the limits at which jaws take, keep, choose and lose a block.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissue/rigid/block_dynamics.h"
#include "tissue/rigid/foam_grip.h"

namespace trocar::foam_limits_test {
namespace {

constexpr double kStep = 0.01;

RigidBody box(const Vec3& size, double mass_kg, const Pose& X_TB) {
  RigidBody body;
  body.half = size / 2;
  body.mass_kg = mass_kg;
  body.X_TB = X_TB;
  return body;
}

TEST(RigidBody, InertiaIsThatOfABoxWhateverItsTurn) {
  const Vec3 size(0.010, 0.020, 0.030);
  const Mat3 R = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const RigidBody body = box(size, 0.004, {R, Vec3(0.1, 0.2, 0.3)});
  for (int i = 0; i < 3; ++i) {
    const double b = size[(i + 1) % 3], c = size[(i + 2) % 3];
    const Vec3 axis = R.col(i);
    EXPECT_NEAR(axis.dot(body.inverse_inertia() * axis) * 0.004 * (b * b + c * c) / 12, 1, 1e-12) << i;
    EXPECT_LT(axis.cross(body.inverse_inertia() * axis).norm() / body.inverse_inertia().norm(), 1e-12) << i;
  }
}

TEST(RigidBody, AnImpulseChangesMomentumAndSpinByItsLever) {
  RigidBody body = box(Vec3(0.02, 0.02, 0.02), 0.005, {Mat3::Identity(), Vec3(0.1, 0, 0)});
  const Vec3 impulse(0, 0.001, 0), point(0.11, 0, 0);
  body.apply(impulse, point);
  EXPECT_NEAR(body.velocity_T.y(), 0.2, 1e-12);
  const double inertia = 0.005 * (0.02 * 0.02 * 2) / 12;
  EXPECT_NEAR(body.spin_T.z(), 0.01 * 0.001 / inertia, 1e-9);
  EXPECT_NEAR(body.velocity_at(point).y(), 0.2 + body.spin_T.z() * 0.01, 1e-12);
  EXPECT_EQ(body.spin_T.head<2>().norm(), 0);
  body.apply(-impulse, point);
  EXPECT_LT(body.velocity_T.norm() + body.spin_T.norm(), 1e-15);
}

TEST(RigidBody, DriftTurnsByTheSpinAndStaysARotation) {
  RigidBody body = box(Vec3(0.02, 0.02, 0.02), 0.005, {});
  body.spin_T = Vec3(0, 0, std::numbers::pi);
  body.velocity_T = Vec3(0.1, 0, 0);
  for (int i = 0; i < 500; ++i) body.drift(1e-3);
  EXPECT_LT((body.X_TB.R.col(0) - Vec3::UnitY()).norm(), 1e-9) << "a quarter turn";
  EXPECT_NEAR(body.X_TB.p.x(), 0.05, 1e-12);
  EXPECT_LT((body.X_TB.R * body.X_TB.R.transpose() - Mat3::Identity()).norm(), 1e-13);
}

TEST(RigidBody, WakingForgetsTheTimeAtRestAndCarriedItDoesNotMove) {
  RigidBody body = box(Vec3(0.02, 0.02, 0.02), 0.005, {});
  body.quiet_s = 3;
  EXPECT_FALSE(body.moves()) << "asleep to begin with";
  body.wake();
  EXPECT_TRUE(body.moves());
  EXPECT_EQ(body.quiet_s, 0);
  body.carried = true;
  EXPECT_FALSE(body.moves());
}

TEST(BlockDynamics, SlidesOnABoardOfItsOwnHeightAndFriction) {
  std::vector<RigidBody> bodies{box(Vec3(0.02, 0.02, 0.008), 0.002, {Mat3::Identity(), Vec3(0, 0, 0.124)})};
  bodies[0].wake();
  bodies[0].velocity_T.x() = 0.2;
  BlockDynamics ice({.floor_z_m = 0.120, .friction = 0});
  for (int i = 0; i < 50; ++i) ice.step(bodies, {}, 0.01);
  EXPECT_NEAR(bodies[0].X_TB.p.x(), 0.1, 1e-9) << "without friction it slides on";
  EXPECT_NEAR(bodies[0].X_TB.p.z(), 0.124, 1e-4) << "on a board at 120 mm";
  EXPECT_FALSE(bodies[0].asleep);
}

TEST(BlockDynamics, APusherSparesTheBodyThatItIsToldToSpare) {
  for (const int spares : {-1, 0}) {
    std::vector<RigidBody> bodies{box(Vec3(0.02, 0.02, 0.02), 0.002, {Mat3::Identity(), Vec3(0, 0, 0.010)})};
    Pusher pusher;
    pusher.shape = {Vec3(-0.012, 0, 0.005), Vec3(-0.012, 0, 0.015), 0.0025};
    pusher.velocity_T = Vec3(0.05, 0, 0);
    pusher.spares = spares;
    BlockDynamics dynamics(BlockDynamicsSettings{});
    dynamics.step(bodies, {pusher}, 0.01);
    EXPECT_EQ(bodies[0].X_TB.p.x() > 1e-6, spares < 0);
    EXPECT_EQ(bodies[0].asleep, spares == 0);
  }
}

/// Jaws that point straight down between blocks on a board; the pads close along y of T.
struct Rig {
  std::vector<RigidBody> bodies;
  std::vector<Foam> foams;
  FoamGrip grip;
  JawReading jaws;
  RigidMaterial board;

  explicit Rig(const std::vector<Vec3>& middles, const Vec3& size = Vec3(0.014, 0.014, 0.020)) {
    FoamBlock spec;
    spec.size_m = size;
    spec.mass_kg = 0.002;
    spec.stiffness_n_per_m = 300;
    spec.slip_below_n = 0.5;
    spec.crush_above_n = 1.5;
    for (const Vec3& middle : middles) {
      bodies.push_back(box(size, spec.mass_kg, {Mat3::Identity(), middle}));
      foams.push_back({spec, spec.stiffness_n_per_m, false});
    }
    jaws.X_TI.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    jaws.X_TI.p = Vec3(0, 0, 0.008);
    jaws.opening_m = size.y() + 0.006;
  }
  void step(double grip_n) {
    jaws.grip_n = grip_n;
    grip.update(jaws, board, 0, {}, kStep, bodies, foams);
  }
  void raise(double height) {
    for (int i = 0; i < 20; ++i) {
      jaws.X_TI.p.z() += height / 20;
      step(1.0);
    }
  }
};

TEST(FoamGrip, AHoldBeginsAtATenthOfANewtonAndEndsBelowHalfOfThat) {
  Rig rig({Vec3(0, 0, 0.010)});
  rig.step(0.099);
  EXPECT_EQ(rig.grip.state(), GripState::kAround);
  rig.step(0.101);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding);
  rig.step(0.051);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding) << "it may grow lighter";
  rig.step(0.049);
  EXPECT_EQ(rig.grip.state(), GripState::kAround);
  EXPECT_FALSE(rig.bodies[0].carried);
  EXPECT_EQ(rig.grip.object(), 0) << "still between the pads";
}

TEST(FoamGrip, OfTwoBlocksItTakesTheNearer) {
  Rig rig({Vec3(0.0075, 0, 0.010), Vec3(-0.0070, 0, 0.010)});
  rig.step(0);
  EXPECT_EQ(rig.grip.object(), 1);
  rig.jaws.X_TI.p.x() = 0.002;
  rig.step(0);
  EXPECT_EQ(rig.grip.object(), 0);
  rig.step(1.0);
  rig.jaws.X_TI.p.x() = -0.002;
  rig.step(1.0);
  EXPECT_EQ(rig.grip.object(), 0) << "once held, nearness does not matter";
  EXPECT_NEAR(rig.bodies[0].X_TB.p.x(), 0.0035, 1e-12);
  EXPECT_EQ(rig.bodies[1].X_TB.p.x(), -0.0070);
}

TEST(FoamGrip, CreepIsProportionalToWhatTheGripLacks) {
  for (const double force : {0.1, 0.25, 0.4}) {
    Rig rig({Vec3(0, 0, 0.010)});
    rig.step(1.0);
    rig.raise(0.030);
    for (int i = 0; i < 10; ++i) rig.step(force);
    EXPECT_EQ(rig.grip.state(), GripState::kSlipping);
    EXPECT_NEAR(rig.grip.slipped_m(), 0.040 * (1 - force / 0.5) * 10 * kStep, 1e-12) << force;
    rig.step(0.6);
    EXPECT_EQ(rig.grip.state(), GripState::kHolding) << "caught again";
    const double height = rig.bodies[0].X_TB.p.z();
    rig.step(0.6);
    EXPECT_EQ(rig.bodies[0].X_TB.p.z(), height);
  }
}

TEST(FoamGrip, SlipIsCountedAnewFromEachGrasp) {
  Rig rig({Vec3(0, 0, 0.010)});
  rig.step(1.0);
  rig.raise(0.030);
  for (int i = 0; i < 5; ++i) rig.step(0.25);
  ASSERT_GT(rig.grip.slipped_m(), 5e-4);
  rig.step(0);
  rig.step(1.0);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding);
  EXPECT_EQ(rig.grip.slipped_m(), 0);
}

TEST(FoamGrip, ABlockOnAnotherIsCarriedByItAndDoesNotSlip) {
  Rig rig({Vec3(0, 0, 0.030), Vec3(0, 0, 0.010)});
  rig.jaws.X_TI.p.z() = 0.028;
  for (int i = 0; i < 20; ++i) rig.step(0.2);
  EXPECT_EQ(rig.grip.object(), 0);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding);
  EXPECT_EQ(rig.grip.slipped_m(), 0);
  rig.jaws.X_TI.p.z() += 0.005;
  rig.step(0.2);
  rig.step(0.2);
  EXPECT_EQ(rig.grip.state(), GripState::kSlipping) << "lifted off it";
}

TEST(FoamGrip, CrushingTakesTheAxisAcrossThePadsAndItsOwnShares) {
  Rig rig({Vec3(0, 0, 0.010)}, Vec3(0.018, 0.012, 0.020));
  rig.foams[0].spec.crushed_thickness = 0.6;
  rig.foams[0].spec.crushed_stiffness = 0.3;
  rig.step(1.5);
  EXPECT_FALSE(rig.foams[0].crushed) << "at its limit it still springs back";
  rig.step(1.5001);
  EXPECT_TRUE(rig.foams[0].crushed);
  EXPECT_LT((2 * rig.bodies[0].half - Vec3(0.018, 0.6 * 0.012, 0.020)).norm(), 1e-12);
  const GripBlock between = rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI);
  EXPECT_NEAR(between.thickness_m, 0.0072, 1e-12);
  EXPECT_NEAR(between.stiffness_n_per_m, 90, 1e-9);
}

TEST(FoamGrip, TheBlockTurnsWithTheInstrumentAndLeavesWithItsVelocity) {
  Rig rig({Vec3(0, 0, 0.010)});
  rig.step(1.0);
  rig.raise(0.040);
  const Mat3 quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
  rig.jaws.X_TI.R = quarter * rig.jaws.X_TI.R;
  rig.step(1.0);
  const Vec3 lever = rig.bodies[0].X_TB.p - rig.jaws.X_TI.p;
  EXPECT_LT((lever - quarter * Vec3(0, 0, 0.002)).norm(), 1e-12) << "its middle was 2 mm above the tips";
  EXPECT_LT((rig.bodies[0].X_TB.R - quarter).norm(), 1e-12);
  rig.jaws.V_TI_T = {Vec3(0.1, 0, 0), Vec3(0, 0, 4)};
  rig.step(1.0);
  EXPECT_LT((rig.bodies[0].velocity_T - (Vec3(0.1, 0, 0) + Vec3(0, 0, 4).cross(lever))).norm(), 1e-12);
  rig.step(0);
  EXPECT_EQ(rig.bodies[0].spin_T, Vec3(0, 0, 4));
}

TEST(FoamGrip, WithNothingBetweenThePadsThereIsNothingToFeelOrHold) {
  Rig rig({Vec3(0.1, 0, 0.010)});
  rig.step(1.0);
  EXPECT_EQ(rig.grip.state(), GripState::kEmpty);
  EXPECT_EQ(rig.grip.object(), -1);
  EXPECT_EQ(rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI).stiffness_n_per_m, 0);
  EXPECT_EQ(rig.grip.held(rig.bodies).radius_m, 0);
  EXPECT_EQ(rig.bodies[0].X_TB.p.x(), 0.1);
}

TEST(FoamGrip, TheHeldCapsuleLiesWithinTheBlockAlongItsLongestEdge) {
  Rig rig({Vec3(0, 0, 0.010)}, Vec3(0.016, 0.012, 0.020));
  rig.step(1.0);
  const HeldObject held = rig.grip.held(rig.bodies);
  EXPECT_NEAR(held.radius_m, 0.006, 1e-12) << "half the shortest edge";
  EXPECT_NEAR((held.from_I - held.to_I).norm(), 2 * (0.010 - 0.006), 1e-12) << "its round ends reach the block's ends";
  const Vec3 middle = rig.jaws.X_TI * Vec3((held.from_I + held.to_I) / 2);
  EXPECT_LT((middle - rig.bodies[0].X_TB.p).norm(), 1e-12);
  EXPECT_NEAR(std::abs((held.from_I - held.to_I).normalized().z()), 1, 1e-12);
}

}  // namespace
}  // namespace trocar::foam_limits_test
