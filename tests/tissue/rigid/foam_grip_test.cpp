// Jaws and foam: grip, hold, slip, crush, set down and let go, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "haptics/control/pinch_channel.h"
#include "tissue/rigid/foam_grip.h"

namespace trocar::foam_grip_test {
namespace {

constexpr double kStep = 0.01;

/// Jaws above one block; the instrument points straight down, the pads close along y of T.
struct Rig {
  std::vector<RigidBody> bodies;
  std::vector<Foam> foams;
  FoamGrip grip;
  JawReading jaws;
  RigidMaterial board;

  explicit Rig(double yaw = 0) {
    FoamBlock spec;
    spec.size_m = Vec3(0.014, 0.014, 0.020);
    spec.mass_kg = 0.002;
    spec.stiffness_n_per_m = 300;
    spec.slip_below_n = 0.5;
    spec.crush_above_n = 1.5;
    RigidBody body;
    body.half = spec.size_m / 2;
    body.mass_kg = spec.mass_kg;
    body.X_TB = {Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, 0, 0.010)};
    bodies.push_back(body);
    foams.push_back({spec, spec.stiffness_n_per_m, false});
    jaws.X_TI.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    jaws.X_TI.p = Vec3(0, 0, 0.008);
    jaws.opening_m = 0.020;
  }
  /// One step with this opening; the grip force is what the pinch channel would feel.
  void step(double opening) {
    jaws.opening_m = opening;
    jaws.grip_n = grip_block(grip.block(bodies, foams, jaws.X_TI), opening).force_n;
    grip.update(jaws, board, 0, {}, kStep, bodies, foams);
  }
  /// Steps with the opening that squeezes with this force.
  void squeeze(double force) {
    const GripBlock block = grip.block(bodies, foams, jaws.X_TI);
    step(block.thickness_m - force / block.stiffness_n_per_m);
  }
  void lift(double height) {
    for (int i = 0; i < 20; ++i) {
      jaws.X_TI.p.z() += height / 20;
      squeeze(1.0);
    }
  }
  RigidBody& body() { return bodies[0]; }
};

TEST(FoamGrip, TakesABlockBetweenOpenPadsAndHoldsIt) {
  Rig rig;
  rig.step(0.020);
  EXPECT_EQ(rig.grip.state(), GripState::kAround);
  EXPECT_DOUBLE_EQ(rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI).thickness_m, 0.014);
  rig.squeeze(0.05);
  EXPECT_EQ(rig.grip.state(), GripState::kAround) << "lighter than 0.1 N is not yet a hold";
  rig.squeeze(0.2);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding);
  EXPECT_TRUE(rig.body().carried);
  rig.lift(0.030);
  EXPECT_NEAR(rig.body().X_TB.p.z(), 0.040, 1e-12);
}

TEST(FoamGrip, ClosedJawsBesideOrOnABlockDoNotTakeIt) {
  Rig closed;
  closed.step(0.002);
  EXPECT_EQ(closed.grip.state(), GripState::kEmpty);
  Rig beside;
  beside.jaws.X_TI.p.y() = 0.015;
  beside.step(0.020);
  EXPECT_EQ(beside.grip.state(), GripState::kEmpty);
  Rig above;
  above.jaws.X_TI.p.z() = 0.030;
  above.step(0.020);
  EXPECT_EQ(above.grip.state(), GripState::kEmpty);
  Rig askew(0.7);
  askew.step(0.028);
  EXPECT_EQ(askew.grip.state(), GripState::kEmpty) << "pads on its edges ride over it";
  Rig yawed(0.4);
  yawed.step(0.028);
  EXPECT_EQ(yawed.grip.state(), GripState::kAround);
}

TEST(FoamGrip, ClosingPadsCentreTheBlock) {
  Rig rig;
  rig.jaws.X_TI.p.y() = 0.0025;
  rig.step(0.020);
  EXPECT_EQ(rig.body().X_TB.p.y(), 0) << "3 mm of room on either side: not touched yet";
  rig.step(0.016);
  EXPECT_NEAR(rig.body().X_TB.p.y(), 0.0015, 1e-12);
  rig.step(0.0139);
  EXPECT_NEAR(rig.body().X_TB.p.y(), 0.0025, 1e-12);
}

TEST(FoamGrip, SlipsBelowItsThresholdAndNotAbove) {
  for (const double share : {0.98, 1.02}) {
    Rig rig;
    rig.step(0.020);
    rig.squeeze(1.0);
    rig.lift(0.030);
    for (int i = 0; i < 50; ++i) rig.squeeze(share * 0.5);
    EXPECT_EQ(rig.grip.state(), share < 1 ? GripState::kSlipping : GripState::kHolding);
    const double slid = 0.040 * (1 - std::min(1.0, share)) * 50 * kStep;
    EXPECT_NEAR(rig.grip.slipped_m(), slid, 1e-9) << "creep is 40 mm/s times the missing share";
    EXPECT_NEAR(rig.body().X_TB.p.z(), 0.040 - slid, 1e-9);
  }
}

TEST(FoamGrip, ASlippingBlockFallsOutAfterTheLengthOfThePads) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(1.0);
  rig.lift(0.030);
  const double middle = rig.body().X_TB.p.z() - rig.jaws.X_TI.p.z();  // 2 mm above the tips
  int steps = 0;
  while (rig.body().carried && steps < 500) {
    rig.squeeze(0.25);
    ++steps;
  }
  EXPECT_EQ(rig.grip.state(), GripState::kEmpty);
  EXPECT_NEAR(steps * kStep, (middle + 0.009) / (0.040 * 0.5), 2 * kStep);
  EXPECT_FALSE(rig.body().asleep);
}

TEST(FoamGrip, AStandingBlockDoesNotSlip) {
  Rig rig;
  rig.step(0.020);
  for (int i = 0; i < 50; ++i) rig.squeeze(0.2);
  EXPECT_EQ(rig.grip.state(), GripState::kHolding);
  EXPECT_EQ(rig.grip.slipped_m(), 0);
}

TEST(FoamGrip, IsCrushedOnceAboveItsLimitThinnerAndSofterForGood) {
  Rig rig;
  rig.step(0.020);
  for (int i = 0; i < 20; ++i) rig.squeeze(1.49);
  EXPECT_FALSE(rig.foams[0].crushed);
  rig.squeeze(1.51);
  EXPECT_TRUE(rig.foams[0].crushed);
  const GripBlock crushed = rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI);
  EXPECT_NEAR(crushed.thickness_m, 0.75 * 0.014, 1e-12);
  EXPECT_NEAR(crushed.stiffness_n_per_m, 150, 1e-9);
  EXPECT_NEAR(rig.body().half.x(), 0.007, 1e-12) << "only across the pads";
  rig.squeeze(1.6);
  rig.squeeze(1.6);
  EXPECT_NEAR(rig.grip.block(rig.bodies, rig.foams, rig.jaws.X_TI).thickness_m, 0.75 * 0.014, 1e-12) << "only once";
  rig.step(0.020);
  EXPECT_TRUE(rig.foams[0].crushed);
}

TEST(FoamGrip, ThrownItKeepsTheInstrumentsVelocity) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(1.0);
  rig.lift(0.030);
  rig.jaws.V_TI_T.linear = Vec3(0.3, 0, 0.1);
  rig.step(0.020);
  EXPECT_FALSE(rig.body().carried);
  EXPECT_EQ(rig.body().velocity_T, rig.jaws.V_TI_T.linear);
}

TEST(FoamGrip, TheBoardPushesAHeldBlockUpThroughThePadsAtTwiceMuTimesGrip) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(0.6);
  for (int i = 0; i < 100; ++i) {
    rig.jaws.X_TI.p.z() -= 0.0001;
    rig.squeeze(0.6);
  }
  EXPECT_NEAR(rig.grip.board_force_n(), 2 * 0.83 * 0.6, 1e-9);
  EXPECT_NEAR(rig.body().X_TB.p.z(), 0.010, 1e-9) << "shown standing on the board";
  const HeldObject held = rig.grip.held(rig.bodies);
  const double lowest = (rig.jaws.X_TI * held.to_I).z() < (rig.jaws.X_TI * held.from_I).z()
                            ? (rig.jaws.X_TI * held.to_I).z()
                            : (rig.jaws.X_TI * held.from_I).z();
  EXPECT_NEAR((held.radius_m - lowest) * rig.board.stiffness_n_per_m, rig.grip.board_force_n(), 1e-9)
      << "the capsule that the hand feels sinks as deep as the block pushes";
}

TEST(FoamGrip, LettingGoAndLeavingTheSceneFreeTheBlock) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(1.0);
  EXPECT_GT(rig.grip.held(rig.bodies).radius_m, 0);
  rig.grip.reset(rig.bodies);
  EXPECT_EQ(rig.grip.state(), GripState::kEmpty);
  EXPECT_FALSE(rig.body().carried);
  EXPECT_EQ(rig.grip.held(rig.bodies).radius_m, 0);
}

/// A block held in a tilted instrument, its middle this far over the board.
Rig tilted(double tilt, double height) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(1.0);
  rig.lift(0.030);
  rig.jaws.X_TI.R = Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix() * rig.jaws.X_TI.R;
  rig.squeeze(1.0);
  rig.jaws.X_TI.p.z() += height - rig.body().X_TB.p.z();
  rig.squeeze(1.0);
  return rig;
}

double lean(const RigidBody& body) { return std::acos(std::min(1.0, body.X_TB.R.row(2).cwiseAbs().maxCoeff())); }

TEST(FoamGrip, TheBoardTurnsATiltedBlockToWhereFoamAndBoardBalance) {
  const double tilt = 0.4, corner = 0.010 * std::cos(tilt) + 0.007 * std::sin(tilt);
  const double turn_n_m = 300 * 0.014 * 0.014 / 12;
  for (const double pressed : {0.0002, 0.0005, 0.001}) {
    Rig rig = tilted(tilt, corner - pressed);
    const double left = lean(rig.body());
    const double reach = 0.010 * std::cos(left) + 0.007 * std::sin(left);  // of the lowest edge under the middle
    const double lever = 0.007 * std::cos(left) - 0.010 * std::sin(left);  // how fast turning raises it
    const double force = rig.board.stiffness_n_per_m * (reach - (corner - pressed));
    EXPECT_NEAR(rig.grip.board_force_n(), force, 1e-6);
    EXPECT_NEAR(force * lever, turn_n_m * (tilt - left), 1e-5) << pressed;
    EXPECT_GT(tilt - left, 0.01);
  }
}

TEST(FoamGrip, PressedOnItLiesFlatAndSpringsBackWhenLifted) {
  Rig rig = tilted(0.4, 0.009);
  EXPECT_LT(lean(rig.body()), 0.02) << "a millimetre of press lays it flat";
  const Mat3 R_flat = rig.body().X_TB.R;
  rig.jaws.X_TI.p.z() += 0.030;
  rig.squeeze(1.0);
  EXPECT_NEAR(lean(rig.body()), 0.4, 1e-9);
  rig.jaws.X_TI.p.z() -= 0.030;
  rig.squeeze(1.0);
  EXPECT_TRUE(rig.body().X_TB.R.isApprox(R_flat, 1e-9));
  const Vec3 middle = rig.body().X_TB.p;
  rig.step(0.020);
  EXPECT_EQ(rig.grip.state(), GripState::kAround);
  EXPECT_LT(lean(rig.body()), 0.02) << "let go as it lies";
  EXPECT_LT((rig.body().X_TB.p - middle).norm(), 1e-3);
}

TEST(FoamGrip, ABlockHeldUprightIsNotTurnedByTheBoard) {
  Rig rig;
  rig.step(0.020);
  rig.squeeze(1.0);
  rig.jaws.X_TI.p.z() -= 0.001;
  rig.squeeze(1.0);
  EXPECT_LT(lean(rig.body()), 1e-9);
  EXPECT_NEAR(rig.grip.board_force_n(), 0.001 * rig.board.stiffness_n_per_m, 1e-9);
}

}  // namespace
}  // namespace trocar::foam_grip_test
