// Mouse and keys: directions in the picture, sizes, speeds, the ball.
#include <cmath>
#include <vector>

#include "app/picture/scene/scope_optics.h"
#include "tests/app/window/input/steered.h"

namespace trocar::steering_test {
namespace {

const std::vector<Camera>& cameras() {
  static const std::vector<Camera> all{front_camera(), camera_at(Vec3(0.12, 0.03, 0.06), Vec3(0.2, 0, 1), 60),
                                       camera_at(Vec3(0.01, 0, 0.14), Vec3(0, 1, 0), 80)};
  return all;
}

TEST(Steering, KeysMoveTheTipAlongThePicturesAxes) {
  for (const Camera& camera : cameras()) {
    const Axes axes = axes_of(camera);
    const std::vector<std::pair<std::int32_t, Vec3>> ways{{kKeyRight, axes.right}, {kKeyLeft, -axes.right},
                                                          {kKeyUp, axes.up},       {kKeyDown, -axes.up},
                                                          {kKeyPageUp, axes.away}, {kKeyPageDown, -axes.away}};
    for (const auto& [key, way] : ways) {
      Steered s;
      s.camera = camera;
      s.press(key);
      s.run(0.5);
      EXPECT_GT(s.tip().norm(), 0.004);
      EXPECT_GT(s.tip().normalized().dot(way), 1 - 1e-9) << key;
    }
  }
}

TEST(Steering, APixelOfMouseIsAPixelOfTip) {
  for (const Camera& camera : cameras()) {
    Steered s;
    s.camera = camera;
    s.move(640 + 60, 360 - 40);
    s.run(0.5);
    const Axes axes = axes_of(camera);
    EXPECT_NEAR(s.tip().dot(axes.away), 0, 1e-12);
    const ScopeOptics optics(camera, {0, 0, 1280, 720});
    const auto from = optics.project(Vec3::Zero()), to = optics.project(s.tip());
    ASSERT_TRUE(from && to);
    EXPECT_NEAR(to->x() - from->x(), 60, 60 * 0.12);  // 12 %: the barrel stretches the middle by 1 + k
    EXPECT_NEAR(to->y() - from->y(), -40, 40 * 0.12);
  }
}

TEST(Steering, WheelGoesInByTwoMillimetresAndByHalfOne) {
  Steered s;
  const Vec3 away = axes_of(s.camera).away;
  s.wheel(1);
  s.run(0.3);
  EXPECT_NEAR(s.tip().dot(away), 0.002, 1e-12);
  s.wheel(-2, true);
  s.run(0.3);
  EXPECT_NEAR(s.tip().dot(away), 0.001, 1e-12);
}

TEST(Steering, SensitivityScalesMouseAndKeysWithinItsLimits) {
  const auto way = [](double sensitivity) {
    SteeringOptions options;
    options.sensitivity = sensitivity;
    Steered s(options);
    s.wheel(1);
    s.run(0.3);
    return s.tip().norm();
  };
  EXPECT_NEAR(way(2), 0.004, 1e-12);
  EXPECT_NEAR(way(0.5), 0.001, 1e-12);
  EXPECT_NEAR(way(100), 0.008, 1e-12);
  EXPECT_NEAR(way(0), 0.0005, 1e-12);
}

TEST(Steering, KeysStartSlowlyAndGrowFaster) {
  Steered s;
  s.press(kKeyRight);
  s.run(0.1);
  const double tap = s.tip().norm();
  EXPECT_LT(tap, 0.0015);  // a tap is a millimetre
  EXPECT_GT(tap, 0.0005);
  s.run(1.4);
  const Vec3 before = s.tip();
  s.run(0.1);
  EXPECT_NEAR((s.tip() - before).norm(), 0.008, 1e-6);  // 80 mm/s
  s.release(kKeyRight);
  const Vec3 stood = s.tip();
  s.run(0.5);
  EXPECT_EQ(s.tip(), stood);
}

TEST(Steering, StepsMayBeLongOrShort) {
  const auto end = [](double step) {
    Steered s;
    s.press(kKeyRight);
    for (int i = 0; i < std::lround(1.2 / step); ++i) s.steering.advance(step, s.camera, kHeight_px);
    return s.tip().norm();
  };
  EXPECT_NEAR(end(0.04), end(0.001), 2e-4);
}

TEST(Steering, NothingIsFasterThanAQuarterMetreASecond) {
  Steered s;
  Vec3 before = s.tip();
  for (int i = 0; i < 200; ++i) {
    s.move(640 + 190 * ((i % 3) - 1), 360 + 150 * ((i % 2) ? 1 : -1));
    s.run(kStep_s);
    EXPECT_LE((s.tip() - before).norm(), 0.25 * kStep_s + 1e-12);
    before = s.tip();
  }
}

TEST(Steering, ALostMouseStaysInTheBallAndTurnsBackAtOnce) {
  SteeringReach reach;
  reach.radius_m = 0.06;
  Steered s({}, reach);
  for (int i = 1; i < 60; ++i) {
    s.move(640 + 100.0 * i, 360);
    s.run(0.05);
  }
  EXPECT_NEAR(s.tip().norm(), 0.06, 1e-6);
  for (int i = 60; i < 90; ++i) {
    s.wheel(30);
    s.move(640 + 100.0 * i, 360);
    s.run(0.1);
    EXPECT_LE(s.tip().norm(), 0.06 + 1e-9);
  }
  const Vec3 out = s.tip();
  s.wheel(-1);
  s.run(0.2);
  EXPECT_LT(s.tip().norm(), out.norm());  // nothing of the lost way has to come back first
}

TEST(Steering, APointerThatWasElsewhereLeapsNothing) {
  Steered s;
  s.move(1200, 100);  // came back from a panel
  s.run(0.5);
  EXPECT_EQ(s.tip(), Vec3(Vec3::Zero()));
  s.move(1210, 100);
  s.run(0.5);
  EXPECT_GT(s.tip().norm(), 0.0005);
}

TEST(Steering, BeginsWhereTheInstrumentIsEvenOutsideTheBall) {
  Steered s;
  const Pose start{Steered::resting(), Vec3(0, 0, 0.2)};
  s.steering.begin(start, 0.02, Vec3::Zero(), wide_reach());
  EXPECT_EQ(s.run(0.5).X_TI.p, start.p);
  EXPECT_EQ(s.steering.intent().X_TI.R, start.R);
}

TEST(Steering, SameEventsGiveTheSameIntents) {
  const auto run = [] {
    Steered s;
    for (int i = 0; i < 50; ++i) {
      s.move(640 + 7 * i, 360 - 3 * i);
      if (i == 10) s.press('Q');
      if (i == 20) s.button(MouseButton::kLeft, true);
      if (i == 30) s.press(kKeyPageUp);
      s.run(kStep_s);
    }
    return s.steering.intent();
  };
  const HandIntent a = run(), b = run();
  EXPECT_EQ(a.X_TI.p, b.X_TI.p);
  EXPECT_EQ(a.X_TI.R, b.X_TI.R);
  EXPECT_EQ(a.jaw_opening_m, b.jaw_opening_m);
}

}  // namespace
}  // namespace trocar::steering_test
