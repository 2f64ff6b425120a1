// Gamepad and SpaceMouse: curve, directions, rates, who moved the hand last.
#include <cmath>

#include "app/window/input/stick_curve.h"
#include "tests/app/window/input/steered.h"

namespace trocar::steering_sticks_test {
namespace {

using Kind = InputEvent::Kind;

TEST(StickCurve, NothingWithinTheDeadZoneAndGentleBeyond) {
  EXPECT_EQ(shaped_axis(0.119), 0);
  EXPECT_EQ(shaped_axis(-0.119), 0);
  EXPECT_GT(shaped_axis(0.13), 0);
  EXPECT_LT(shaped_axis(0.13), 0.001);  // no step at the edge
  EXPECT_DOUBLE_EQ(shaped_axis(1), 1);
  EXPECT_DOUBLE_EQ(shaped_axis(-1), -1);
  EXPECT_NEAR(shaped_axis(0.56), std::pow(0.5, 1.8), 1e-12);
  double before = 0;
  for (double value = 0; value <= 1; value += 0.01) {
    EXPECT_GE(shaped_axis(value), before);
    before = shaped_axis(value);
  }
}

TEST(StickCurve, IsRound) {
  EXPECT_TRUE(shaped_stick(0.08, 0.08).isZero());
  const Eigen::Vector2d corner = shaped_stick(1, 1);  // a square gate
  EXPECT_NEAR(corner.norm(), 1, 1e-12);
  EXPECT_DOUBLE_EQ(corner.x(), corner.y());
  EXPECT_TRUE(shaped_stick(std::nan(""), 0).isZero());
}

TEST(SteeringPad, LeftStickMovesThePlane) {
  Steered s;
  s.sticks(Kind::kPad, {0, -1, 0, 0, 0, 0});  // away from the person
  s.run(0.2);
  EXPECT_NEAR(s.tip().dot(axes_of(s.camera).up), 0.020, 1e-9);
  EXPECT_EQ(s.steering.kind(), InputKind::kPad);
  s.sticks(Kind::kPad, {1, 0, 0, 0, 0, 0});
  s.run(0.2);
  EXPECT_NEAR(s.tip().dot(axes_of(s.camera).right), 0.020, 1e-9);
}

TEST(SteeringPad, WithinTheDeadZoneAPadIsNobody) {
  Steered s;
  s.move(650, 360);
  s.sticks(Kind::kPad, {0.08, 0.08, -0.1, 0, 0, 0});
  const Vec3 before = s.run(0.5).X_TI.p;
  s.run(1);
  EXPECT_EQ(s.tip(), before);
  EXPECT_EQ(s.steering.kind(), InputKind::kMouse);
}

TEST(SteeringPad, BumpersWristTriggersAndScope) {
  Steered s;
  const Axes axes = axes_of(s.camera);
  s.sticks(Kind::kPad, {}, kPadRightBumper);
  s.run(0.5);
  EXPECT_NEAR(s.tip().dot(axes.away), 0.020, 1e-9);
  const Vec3 before = s.far();
  s.sticks(Kind::kPad, {0, 0, 1, -1, 0, 0});
  s.run(0.3);
  EXPECT_GT((s.far() - before).dot(axes.right), 0.05);
  EXPECT_GT((s.far() - before).dot(axes.up), 0.05);
  s.sticks(Kind::kPad, {0, 0, 0, 0, 0, 0.5});
  EXPECT_NEAR(s.run(0.25).jaw_opening_m, 0.010, 1e-9);  // a trigger that is pulled is held
  s.sticks(Kind::kPad, {}, kPadX);
  const Vec3 tip = s.run(0.1).X_TI.p;
  s.sticks(Kind::kPad, {1, 0, 0, 0, 0, 0}, kPadX);
  s.run(0.5);
  EXPECT_EQ(s.tip(), tip);
  EXPECT_GT(s.steering.scope().yaw_rad, 0.1);
  s.sticks(Kind::kPad, {}, kPadUp);
  s.run(0.5);
  EXPECT_GT(s.steering.scope().post_rad, 0.1);
}

TEST(SteeringPad, ActLetOffAndClutchAreButtons) {
  Steered s;
  s.sticks(Kind::kPad, {}, kPadA);
  s.sticks(Kind::kPad, {}, kPadA);  // still held
  EXPECT_NEAR(s.run(0.25).jaw_opening_m, 0.010, 1e-9);
  s.sticks(Kind::kPad, {}, kPadY);
  EXPECT_DOUBLE_EQ(s.run(0.5).jaw_opening_m, 0.02);
  s.sticks(Kind::kPad, {}, kPadB);
  EXPECT_TRUE(s.run(kStep_s).clutch);
  s.sticks(Kind::kPad, {}, 0);
  EXPECT_FALSE(s.run(kStep_s).clutch);
}

TEST(SteeringPad, InTissueTheTriggersAreJawsAndPedal) {
  Steered s;
  s.around.jaws = false;
  s.around.in_tissue = s.around.jaws_apart = true;
  s.sticks(Kind::kPad, {0, 0, 0, 0, 1, 0});
  EXPECT_TRUE(s.run(0.1).pedal);
  EXPECT_DOUBLE_EQ(s.steering.intent().jaw_opening_m, 0.02) << "the pedal is no act";
  const Vec3 tip = s.tip();
  s.sticks(Kind::kPad, {0, 0, 0, 0, 0, 1});
  EXPECT_NEAR(s.run(0.4).jaw_opening_m, 0, 1e-9);
  EXPECT_FALSE(s.steering.intent().pedal);
  EXPECT_EQ(s.tip(), tip) << "closing presses nothing";
  s.sticks(Kind::kPad, {}, kPadRightThumb);
  EXPECT_TRUE(s.run(kStep_s).exchange);
  s.sticks(Kind::kPad, {});
  EXPECT_FALSE(s.run(kStep_s).exchange);
}

TEST(SteeringSpaceMouse, SixAxesAreRatesOfTheTarget) {
  const Axes axes = axes_of(front_camera());
  const auto tip = [](const std::array<double, 6>& axis) {
    Steered s;
    s.sticks(Kind::kSpaceMouse, axis);
    s.run(0.2);
    return s.tip();
  };
  EXPECT_NEAR(tip({1, 0, 0, 0, 0, 0}).dot(axes.right), 0.020, 1e-9);
  EXPECT_NEAR(tip({0, 1, 0, 0, 0, 0}).dot(axes.up), 0.020, 1e-9);
  EXPECT_NEAR(tip({0, 0, -1, 0, 0, 0}).dot(axes.away), 0.020, 1e-9);
  Steered s;
  Vec3 before = s.far();
  s.sticks(Kind::kSpaceMouse, {0, 0, 0, -1, 0, 0});  // tilted away
  s.run(0.3);
  EXPECT_GT((s.far() - before).dot(axes.up), 0.05);
  before = s.far();
  s.sticks(Kind::kSpaceMouse, {0, 0, 0, 0, 0, -1});  // leant to the right
  s.run(0.3);
  EXPECT_GT((s.far() - before).dot(axes.right), 0.05);
  const Mat3 R = s.steering.intent().X_TI.R;
  s.sticks(Kind::kSpaceMouse, {0, 0, 0, 0, -1, 0});  // turned clockwise as seen from above
  s.run(0.2);
  EXPECT_GT(Eigen::AngleAxisd(R.transpose() * s.steering.intent().X_TI.R).axis().z(), 0.99);
  EXPECT_EQ(s.steering.kind(), InputKind::kSpaceMouse);
}

TEST(SteeringSpaceMouse, ButtonsActAndLetOff) {
  Steered s;
  s.sticks(Kind::kSpaceMouse, {}, 1);
  EXPECT_NEAR(s.run(0.25).jaw_opening_m, 0.010, 1e-9);
  s.sticks(Kind::kSpaceMouse, {}, 0);
  EXPECT_NEAR(s.run(1).jaw_opening_m, 0.010, 1e-9);
  s.sticks(Kind::kSpaceMouse, {}, 2);
  EXPECT_DOUBLE_EQ(s.run(0.5).jaw_opening_m, 0.02);
}

TEST(SteeringKind, IsWhatMovedTheHandLast) {
  Steered s;
  EXPECT_EQ(s.steering.kind(), InputKind::kMouse);
  s.press(kKeySpace);  // a mouse user's other hand
  EXPECT_EQ(s.steering.kind(), InputKind::kMouse);
  s.press(kKeyUp);
  EXPECT_EQ(s.steering.kind(), InputKind::kKeyboard);
  s.move(700, 360);
  EXPECT_EQ(s.steering.kind(), InputKind::kMouse);
}

}  // namespace
}  // namespace trocar::steering_sticks_test
