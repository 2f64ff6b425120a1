// Wrist, port, jaws, scope, clutch, options; what is no steering; a window that loses the focus.
#include <cmath>
#include <numbers>

#include "app/picture/scene/scope_optics.h"
#include "haptics/least_turn.h"
#include "tests/app/window/input/steered.h"

namespace trocar::steering_rules_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Roll of the instrument against its begin, about its own shaft (shaft not leant).
double roll_of(const Steered& s) {
  const Mat3 turn = Steered::resting().transpose() * s.steering.intent().X_TI.R;
  return std::atan2(turn(1, 0), turn(0, 0));
}

TEST(SteeringWrist, DragLeansAboutTheTipAndTheWheelRolls) {
  Steered s;
  const Axes axes = axes_of(s.camera);
  s.button(MouseButton::kRight, true);
  Vec3 before = s.far();
  s.move(640, 360 - 60);  // a twelfth of the height: 10 degrees
  s.run(0.5);
  EXPECT_NEAR(std::acos(before.dot(s.far())), 10 * kDegree, 1e-9);
  EXPECT_GT((s.far() - before).dot(axes.up), 0);
  before = s.far();
  s.move(640 - 60, 360 - 60);
  s.run(0.5);
  EXPECT_LT((s.far() - before).dot(axes.right), -0.1);
  EXPECT_EQ(s.tip(), Vec3(Vec3::Zero()));
  Steered rolled;
  rolled.button(MouseButton::kRight, true);
  rolled.wheel(5);
  rolled.run(0.5);
  EXPECT_NEAR(roll_of(rolled), 20 * kDegree, 1e-9);
  EXPECT_EQ(rolled.tip(), Vec3(Vec3::Zero()));
}

TEST(SteeringWrist, KeysTurnWhereTheySay) {
  const Axes axes = axes_of(front_camera());
  const auto lean = [](std::int32_t key) {
    Steered s;
    const Vec3 before = s.far();
    s.press(key);
    s.run(0.3);
    return Vec3(s.far() - before);
  };
  EXPECT_GT(lean('Z').dot(axes.up), 0.05);
  EXPECT_LT(lean('C').dot(axes.up), -0.05);
  EXPECT_LT(lean(kKeyHome).dot(axes.right), -0.05);
  EXPECT_GT(lean(kKeyEnd).dot(axes.right), 0.05);
  for (const auto& [key, sign] : {std::pair{'Q', -1}, std::pair{'E', 1}}) {
    Steered s;
    s.press(key);
    s.run(0.3);
    EXPECT_NEAR(roll_of(s), sign * 27 * kDegree, 1e-6);
    EXPECT_LT((s.far() + Steered::resting().col(2)).norm(), 1e-12);  // the shaft itself stands still
  }
}

TEST(SteeringWrist, AShaftUprightInThePictureLeansAway) {
  Steered s;
  const Axes axes = axes_of(s.camera);
  const Mat3 R = least_turn(Vec3::UnitZ(), -axes.up).toRotationMatrix();
  s.steering.begin({R, Vec3::Zero()}, 0.02, Vec3::Zero(), wide_reach());
  s.press('Z');
  s.run(0.3);
  EXPECT_GT(s.far().dot(axes.away), 0.1);
}

TEST(SteeringWrist, StaysWithinItsLimitsAndARotation) {
  Steered s;
  for (const int key : std::initializer_list<int>{'E', 'Z', kKeyEnd}) s.press(key);
  s.run(20);
  const Mat3 R = s.steering.intent().X_TI.R;
  EXPECT_NEAR(std::acos(s.far().dot(-Steered::resting().col(2))), 35 * kDegree, 1e-9);
  EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1, 1e-12);
  s.release('Z');
  s.release(kKeyEnd);
  s.press('C');
  s.press(kKeyHome);
  s.run(0.3);
  EXPECT_LT(std::acos(s.far().dot(-Steered::resting().col(2))), 25 * kDegree);  // back at once
}

TEST(SteeringWrist, LimitsAreThoseOfTheReach) {
  Steered s({}, SteeringReach());
  for (const int key : std::initializer_list<int>{'E', kKeyEnd}) s.press(key);
  s.run(3);
  EXPECT_NEAR(std::acos(s.far().dot(-Steered::resting().col(2))), 24 * kDegree, 1e-9);
  s.release(kKeyEnd);
  s.press(kKeyHome);
  s.run(24.0 / 45);
  s.release(kKeyHome);
  s.run(0.2);
  EXPECT_NEAR(roll_of(s), 20 * kDegree, 2e-2);
}

TEST(SteeringPort, OnlyTipAndRollCanBeHad) {
  SteeringReach reach = wide_reach();
  reach.port_T = Vec3(0.05, -0.05, 0.12);
  Steered s({}, reach);
  s.press('Z');
  s.press(kKeyRight);
  s.run(1);
  EXPECT_LT((s.far() - (*reach.port_T - s.tip()).normalized()).norm(), 1e-9);
  s.release('Z');
  s.release(kKeyRight);
  const Mat3 before = s.steering.intent().X_TI.R;
  s.press('E');
  s.run(0.5);
  const Eigen::AngleAxisd turn(before.transpose() * s.steering.intent().X_TI.R);
  EXPECT_NEAR(turn.angle(), 45 * kDegree, 1e-6);
  EXPECT_NEAR(turn.axis().z(), 1, 1e-9);
}

TEST(SteeringJaws, HeldTheyCloseLetGoTheyStayAndAClickOpensThem) {
  Steered s;
  s.button(MouseButton::kLeft, true);
  EXPECT_NEAR(s.run(0.25).jaw_opening_m, 0.010, 1e-9);
  s.button(MouseButton::kLeft, false);
  EXPECT_NEAR(s.run(1).jaw_opening_m, 0.010, 1e-9);
  s.button(MouseButton::kLeft, true);
  s.run(0.1);
  s.button(MouseButton::kLeft, false);
  EXPECT_DOUBLE_EQ(s.run(0.5).jaw_opening_m, 0.02);
  s.press(kKeySpace);  // without a mouse
  EXPECT_NEAR(s.run(0.5).jaw_opening_m, 0, 1e-9);
  s.release(kKeySpace);
  s.press('X');
  EXPECT_DOUBLE_EQ(s.run(0.6).jaw_opening_m, 0.02);
}

TEST(SteeringJaws, TheirOwnKeyClosesThemWhereTheActButtonDoesAndLetGoItOpensThem) {
  Steered s;
  s.press('G');
  EXPECT_LT(s.run(0.4).jaw_opening_m, 0.005);
  s.release('G');
  EXPECT_NEAR(s.run(1).jaw_opening_m, 0.02, 1e-4);
  s.press('G');
  s.run(0.4);
  s.steering.handle(event_of(InputEvent::Kind::kFocusLost));
  EXPECT_LT(s.run(1).jaw_opening_m, 0.005) << "what is held stays held";
}

TEST(SteeringJaws, AreClosedWhereNothingIsToBeGrippedAndOpenWhenItIs) {
  Steered s;
  s.around.jaws = false;
  EXPECT_DOUBLE_EQ(s.run(0.6).jaw_opening_m, 0);
  s.around.jaws = true;
  EXPECT_DOUBLE_EQ(s.run(0.6).jaw_opening_m, 0.02);
}

TEST(SteeringPress, GoesAlongTheViewThenSlowlyIntoWhatIsTouchedAndStaysWhenLetGo) {
  Steered s;
  s.around.jaws = false;
  const Vec3 away = axes_of(s.camera).away;
  s.button(MouseButton::kLeft, true);
  s.run(0.5);
  EXPECT_NEAR(s.tip().dot(away), 0.006, 1e-6);  // 12 mm/s
  s.around.touching = true;
  s.around.normal_T = Vec3::UnitX();
  const Vec3 touched = s.tip();
  s.run(1);
  EXPECT_LT((s.tip() - touched + 0.003 * Vec3::UnitX()).norm(), 1e-6);  // 3 mm/s against the normal
  s.button(MouseButton::kLeft, false);
  const Vec3 kept = s.tip();
  s.run(2);
  EXPECT_LT((s.tip() - kept).norm(), 1e-12);
}

TEST(SteeringPress, TheSofterWhatIsTouchedTheFasterItGoesIn) {
  for (const auto& [stiffness, speed] : {std::pair(30.0, 0.012), {75.0, 0.006}, {150.0, 0.003}, {600.0, 0.003}}) {
    Steered s;
    s.around.jaws = false;
    s.around.touching = true;
    s.around.normal_T = Vec3::UnitX();
    s.button(MouseButton::kLeft, true);
    const Vec3 touched = s.tip();
    const auto deep = [&] { return -(s.tip() - touched).x(); };
    for (int i = 0; i < 50; ++i) {
      s.around.force_n = stiffness * deep();
      s.run(kStep_s);
    }
    const double before = deep();
    for (int i = 0; i < 20; ++i) {
      s.around.force_n = stiffness * deep();
      s.run(kStep_s);
    }
    EXPECT_NEAR((deep() - before) / (20 * kStep_s), speed, 0.05 * speed) << stiffness;
  }
}

TEST(SteeringPress, LetGoItKeepsItsForceOnTissueThatRelaxesButFollowsNothingThatHasGivenWay) {
  Steered s;
  s.around.jaws = false;
  s.around.touching = true;
  s.around.normal_T = Vec3::UnitX();
  s.button(MouseButton::kLeft, true);
  const Vec3 touched = s.tip();
  const auto deep = [&] { return -(s.tip() - touched).x(); };
  double stiffness = 75;
  const auto run = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep_s); ++i) {
      s.around.force_n = stiffness * deep();
      s.run(kStep_s);
    }
  };
  run(1.2);
  s.button(MouseButton::kLeft, false);
  run(kStep_s);
  const double force = stiffness * deep(), depth = deep();
  stiffness = 60;
  run(2);
  EXPECT_NEAR(stiffness * deep(), force, 0.05 * force);
  EXPECT_GT(deep(), depth + 0.0005);
  stiffness = 1;
  run(5);
  EXPECT_LT(deep(), depth + 0.0041);
  s.around.touching = false;
  const double left = deep();
  run(1);
  EXPECT_DOUBLE_EQ(deep(), left);
}

TEST(SteeringPress, AClickOrAWayAsideLetsOff) {
  for (const bool click : {true, false}) {
    Steered s;
    s.around.jaws = false;
    s.button(MouseButton::kLeft, true);
    s.run(0.5);
    s.button(MouseButton::kLeft, false);
    s.around.touching = true;
    s.run(0.1);
    if (click) {
      s.button(MouseButton::kLeft, true);
      s.run(0.1);
      s.button(MouseButton::kLeft, false);
    } else {
      for (int i = 1; i < 20; ++i) {
        s.move(640 + 10 * i, 360);
        s.run(kStep_s);
      }
    }
    s.run(0.5);
    EXPECT_NEAR(s.tip().dot(axes_of(s.camera).away), 0, 1e-9) << (click ? "clicked" : "moved away");
  }
}

TEST(SteeringPress, TheTargetIsNeverFarAheadOfATipThatIsHeldBack) {
  Steered s;
  s.around.jaws = false;
  s.around.touching = true;
  s.around.normal_T = -axes_of(s.camera).away;
  s.around.now = s.steering.intent();
  s.button(MouseButton::kLeft, true);
  for (int i = 0; i < 500; ++i) s.steering.advance(kStep_s, s.camera, kHeight_px, s.around);  // the hand gets nowhere
  EXPECT_NEAR(s.tip().dot(axes_of(s.camera).away), 0.0015, 1e-9);
}

/// A slope that rises to the right.
GlideGround slope() {
  return {1, [](double x, double) { return 0.2 * x - 0.02; }, 0.008};
}

TEST(SteeringGlide, TheFootFollowsThePointerAndTheTipStaysAtItsHeight) {
  const GlideGround ground = slope();
  Steered s;
  s.around.ground = &ground;
  s.run(1);
  EXPECT_NEAR(s.tip().z() - ground.height(s.tip().x(), s.tip().y()), 0.008, 1e-9);
  const auto seen = [&] { return *ScopeOptics(s.camera, {0, 0, 1280, 720}).project(*s.steering.foot_T()); };
  const Eigen::Vector2d before = seen();
  s.move(640 + 80, 360 - 30);
  s.run(1);
  EXPECT_NEAR(seen().x() - before.x(), 80, 80 * 0.15);
  EXPECT_NEAR(seen().y() - before.y(), -30, 30 * 0.15);
  EXPECT_NEAR(s.tip().z() - ground.height(s.tip().x(), s.tip().y()), 0.008, 1e-9);
  s.wheel(2);
  s.run(1);
  EXPECT_NEAR(s.tip().z() - ground.height(s.tip().x(), s.tip().y()), 0.004, 1e-9);
}

/// Seen from the front over a hill whose far side falls below the plain behind it.
TEST(SteeringGlide, SmallStepsComeBackOverAnEdgeThatHidesTheGround) {
  const GlideGround ground{1, [](double, double y) { return y < 0.02 ? 0.01 - 60 * y * y : -0.002; }, 0.008};
  Steered s;
  s.camera.eye_T = {0, -0.1, 0.1};
  s.camera.look_at_T = Vec3::Zero();
  s.camera.up_T = Vec3::UnitZ();
  s.around.ground = &ground;
  s.run(1);
  s.move(640, 360 - 200);
  s.run(1);
  ASSERT_GT(s.steering.foot_T()->y(), 0.02);
  for (int n = 1; n <= 100; ++n) {
    s.move(640, 360 - 200 + 2 * n);
    s.run(kStep_s);
  }
  s.run(1);
  EXPECT_LT(s.steering.foot_T()->y(), 0.005);
}

TEST(SteeringGlide, PressingGoesStraightDownAndSlowerTheNearer) {
  const GlideGround ground = slope();
  Steered s;
  s.around.ground = &ground;
  s.around.jaws = false;
  s.run(1);
  const Vec3 above = s.tip();
  s.button(MouseButton::kLeft, true);
  s.run(0.2);
  const double first = above.z() - s.tip().z();
  s.run(1);
  const Vec3 below = s.tip();
  EXPECT_LT((below - above).head<2>().norm(), 1e-9);
  EXPECT_GT(first, 0.004);
  EXPECT_LT(std::abs(below.z() - ground.height(below.x(), below.y())), 0.0035);
}

TEST(SteeringGlide, AnotherGroundIsGoneOverToWithoutALeap) {
  const GlideGround ground = slope();
  const GlideGround higher{2, [](double, double) { return 0.03; }, 0};
  Steered s;
  s.around.ground = &ground;
  s.run(1);
  s.around.ground = &higher;
  Vec3 before = s.tip();
  for (int i = 0; i < 100; ++i) {
    s.run(kStep_s);
    EXPECT_LT((s.tip() - before).norm(), 0.0009);
    before = s.tip();
  }
  EXPECT_NEAR(s.tip().z(), 0.03, 1e-9);
}

TEST(SteeringScope, MiddleDragAndKeys) {
  Steered s;
  s.button(MouseButton::kMiddle, true);
  s.move(640 + 72, 360 + 36);
  s.wheel(2);
  s.run(kStep_s);
  EXPECT_NEAR(s.steering.scope().yaw_rad, 6 * kDegree, 1e-9);
  EXPECT_NEAR(s.steering.scope().pitch_rad, -3 * kDegree, 1e-9);
  EXPECT_NEAR(s.steering.scope().depth_m, 0.010, 1e-9);
  s.button(MouseButton::kMiddle, false);
  s.press('V');
  s.press(kKeyUp);
  s.run(0.5);
  EXPECT_GT(s.steering.scope().pitch_rad, 0);
  s.release(kKeyUp);
  s.release('V');
  s.press('D');
  s.run(0.5);
  EXPECT_NEAR(s.steering.scope().post_rad, 30 * kDegree, 1e-9);
  EXPECT_EQ(s.tip(), Vec3(Vec3::Zero()));
  s.release('D');
  s.press('H');
  s.run(1);
  EXPECT_EQ(s.steering.scope().post_rad, 0);
  EXPECT_EQ(s.steering.scope().yaw_rad, 0);
  EXPECT_EQ(s.steering.scope().depth_m, 0);
}

TEST(SteeringScope, HasLimitsAndAPostGoesRound) {
  ScopeHand hand;
  for (int i = 0; i < 100; ++i) hand.turn({0.1, 0.1, -0.1, 0.01});
  EXPECT_DOUBLE_EQ(hand.move().yaw_rad, ScopeHand::kMostTurn_rad);
  EXPECT_DOUBLE_EQ(hand.move().pitch_rad, -ScopeHand::kMostTurn_rad);
  EXPECT_DOUBLE_EQ(hand.move().depth_m, ScopeHand::kMostDepth_m);
  EXPECT_NEAR(hand.move().post_rad, 10 - 4 * std::numbers::pi, 1e-9);
}

TEST(SteeringClutch, TheInstrumentIsWhereItStoodWhenTheClutchIsLetGo) {
  Steered s;
  s.wheel(2);
  s.run(0.5);
  const Vec3 stood = s.tip();
  s.press('W');
  s.run(kStep_s);
  EXPECT_TRUE(s.steering.intent().clutch);
  s.press(kKeyRight);
  s.run(0.5);
  EXPECT_GT((s.tip() - stood).norm(), 0.003);  // where the stylus would bring it
  s.release(kKeyRight);
  s.release('W');
  s.run(kStep_s);
  EXPECT_FALSE(s.steering.intent().clutch);
  EXPECT_EQ(s.tip(), stood);
}

TEST(SteeringSwitches, PedalIsHeldAndAnExchangeIsNeverTooShort) {
  Steered s;
  s.press('F');
  EXPECT_TRUE(s.run(kStep_s).pedal);
  s.release('F');
  EXPECT_FALSE(s.run(kStep_s).pedal);
  s.press('T');
  s.release('T');  // within one picture
  EXPECT_TRUE(s.run(kStep_s).exchange);
  EXPECT_FALSE(s.run(kStep_s).exchange);
  s.press('T');
  EXPECT_TRUE(s.run(0.5).exchange) << "held, it is one press all the same: the loop counts its beginning";
  s.press('F');
  s.steering.handle(event_of(InputEvent::Kind::kFocusLost));
  EXPECT_FALSE(s.run(kStep_s).pedal || s.steering.intent().exchange);
}

TEST(SteeringSwitches, WhatIsInUseIsNotExchangedBeforeTheSwitchIsPressedAnew) {
  Steered s;
  s.around.in_use = true;
  s.press('T');
  EXPECT_FALSE(s.run(kStep_s).exchange);
  EXPECT_TRUE(s.steering.refuses_exchange());
  EXPECT_FALSE(s.run(kStep_s).exchange);
  EXPECT_FALSE(s.steering.refuses_exchange()) << "told once";
  s.around.in_use = false;
  EXPECT_FALSE(s.run(kStep_s).exchange) << "drawn back with the key held: not all of a sudden";
  s.release('T');
  s.run(kStep_s);
  s.press('T');
  EXPECT_TRUE(s.run(kStep_s).exchange);
  s.around.in_use = true;  // what is under way goes on
  EXPECT_TRUE(s.run(kStep_s).exchange);
  EXPECT_FALSE(s.steering.refuses_exchange());
}

TEST(SteeringJaws, InTissueHaveAKeyOfTheirOwnAndAreClosedWhileTheTipPresses) {
  Steered s;
  s.around.jaws = false;
  s.around.in_tissue = s.around.jaws_apart = true;
  s.press('G');
  EXPECT_NEAR(s.run(0.4).jaw_opening_m, 0, 1e-9);
  s.release('G');
  EXPECT_DOUBLE_EQ(s.run(0.5).jaw_opening_m, 0.02);
  s.press(kKeySpace);
  const Vec3 above = s.tip();
  EXPECT_EQ(s.run(0.3).X_TI.p, above) << "no press with open jaws: they would take a fold";
  EXPECT_DOUBLE_EQ(s.run(0.3).jaw_opening_m, 0);
  EXPECT_GT((s.tip() - above).norm(), 0.001);
  s.release(kKeySpace);
  EXPECT_DOUBLE_EQ(s.run(0.6).jaw_opening_m, 0) << "pressed on, they stay closed";
  s.press('X');
  s.run(0.6);
  s.release('X');
  EXPECT_DOUBLE_EQ(s.run(0.6).jaw_opening_m, 0.02);
  s.around.jaws_apart = false;  // a hook
  EXPECT_DOUBLE_EQ(s.run(1).jaw_opening_m, 0);
}

TEST(SteeringOptions, LikeAFulcrumTurnsThePlaneRoundAndLeavesTheDepth) {
  SteeringOptions options;
  options.like_a_fulcrum = true;
  Steered s(options);
  s.move(640 + 60, 360 - 40);
  s.wheel(1);
  s.run(0.5);
  const Axes axes = axes_of(s.camera);
  EXPECT_LT(s.tip().dot(axes.right), -0.005);
  EXPECT_LT(s.tip().dot(axes.up), -0.003);
  EXPECT_NEAR(s.tip().dot(axes.away), 0.002, 1e-12);
}

TEST(SteeringOptions, LeftHandedMirrorsTheWristAndNotTheTip) {
  SteeringOptions options;
  options.left_handed = true;
  Steered s(options);
  s.move(640 + 60, 360);
  s.run(0.5);
  EXPECT_GT(s.tip().dot(axes_of(s.camera).right), 0);
  s.button(MouseButton::kRight, true);
  s.wheel(5);
  s.run(0.5);
  EXPECT_NEAR(roll_of(s), -20 * kDegree, 1e-9);
  s.button(MouseButton::kRight, false);
  s.press('E');  // a key does what its name says
  s.run(20.0 / 90);
  EXPECT_NEAR(roll_of(s), 0, 2e-2);
}

TEST(SteeringEvents, TellSteeringFromCommands) {
  Steered s;
  for (const int key : std::initializer_list<int>{'Q', kKeySpace, 'V'})
    EXPECT_TRUE(s.steering.handle(key_event(key, true)));
  for (const int key : std::initializer_list<int>{'P', kKeyEscape, kKeyTab})
    EXPECT_FALSE(s.steering.handle(key_event(key, true)));
  EXPECT_TRUE(s.steering.handle(event_of(InputEvent::Kind::kWheel)));
}

TEST(SteeringEvents, OtherKeysCanBeTakenUp) {
  Steered s;
  KeyMap keys;
  keys.assign(Action::kRight, 'J');
  s.press(kKeyLeft);
  s.steering.retune(keys, {});
  s.press('J');
  s.run(0.5);
  EXPECT_GT(s.tip().dot(axes_of(s.camera).right), 0.004);  // and the other key is no longer held
  EXPECT_FALSE(s.steering.handle(key_event(kKeyRight, true)));
}

TEST(SteeringEvents, AKeyThatRepeatsIsHeld) {
  Steered s;
  InputEvent again = key_event(kKeySpace, true);
  s.steering.handle(again);
  again.repeat = true;
  for (int i = 0; i < 5; ++i) {
    s.steering.handle(again);
    s.run(0.1);
  }
  EXPECT_NEAR(s.steering.intent().jaw_opening_m, 0, 1e-9);
}

TEST(SteeringEvents, FocusLostReleasesAllAndDropsNothing) {
  Steered s;
  s.press(kKeyRight);
  s.press('E');
  s.press('W');
  s.button(MouseButton::kLeft, true);
  s.sticks(InputEvent::Kind::kPad, {1, 0, 0, 0, 0, 0});
  s.run(0.1);
  EXPECT_FALSE(s.steering.handle(event_of(InputEvent::Kind::kFocusLost)));
  s.run(1);  // what was wanted is reached
  const HandIntent stood = s.steering.intent();
  s.run(1);
  EXPECT_EQ(s.tip(), stood.X_TI.p);
  EXPECT_EQ(s.steering.intent().X_TI.R, stood.X_TI.R);
  EXPECT_NEAR(stood.jaw_opening_m, 0.016, 1e-9);  // not taken for a click
  EXPECT_FALSE(stood.clutch);
  s.move(900, 200);  // first word of the pointer after it came back
  s.run(0.5);
  EXPECT_EQ(s.tip(), stood.X_TI.p);
}

TEST(SteeringEvents, AStandstillOfTheWindowIsOneShortStep) {
  Steered s;
  s.press(kKeyRight);
  s.steering.advance(30, s.camera, kHeight_px);
  EXPECT_LT(s.tip().norm(), 0.025 + 1e-9);
}

}  // namespace
}  // namespace trocar::steering_rules_test
