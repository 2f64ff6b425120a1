#include "app/window/input/jaw_fingers.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace trocar::jaw_fingers_test {
namespace {

/// Fingers that follow at once.
void run(JawFingers& jaw, JawFingers::Wish wish, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 1000 + 0.5); ++i) {
    wish.fingers_m = jaw.opening_m();
    jaw.advance(wish, 0.001);
  }
}

const JawFingers::Wish kClose{.close = true}, kLetGo{.let_go = true}, kOpen{.open = true}, kNothing{};

TEST(JawFingers, HeldTheyCloseAndGoOnSqueezing) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.25);
  EXPECT_NEAR(jaw.opening_m(), 0.010, 1e-4);
  run(jaw, kClose, 3);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), JawFingers::kTightest_m);
}

TEST(JawFingers, InTissueTheyCloseWhileHeldAndOpenWhenLetGo) {
  JawFingers jaw;
  jaw.begin(0.02);
  const auto work = [&](JawFingers::Work wish, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000 + 0.5); ++i) {
      wish.fingers_m = jaw.opening_m();
      jaw.work(wish, 0.001);
    }
    return jaw.opening_m();
  };
  EXPECT_NEAR(work({.close = true}, 0.4), 0, 1e-9) << "0.4 s";
  EXPECT_DOUBLE_EQ(work({.close = true}, 3), JawFingers::kTightest_m);
  EXPECT_DOUBLE_EQ(work({}, 1), 0.02);
  EXPECT_DOUBLE_EQ(work({.shut = true}, 1), 0) << "a closed tip presses without squeezing";
  jaw.work({.close = true, .gripping = true, .fingers_m = 0.008}, 0.001);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.006) << "not far ahead of the fingers";
  run(jaw, kClose, 0.001);
  run(jaw, kOpen, 1);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02) << "back at the act button";
}

TEST(JawFingers, LetGoTheyStayWhereTheFingersAre) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.25);
  jaw.advance({.let_go = true, .fingers_m = 0.012}, 0.001);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.012);
  run(jaw, kNothing, 5);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.012);
  run(jaw, kOpen, 0.001);
  run(jaw, kNothing, 0.5);  // once is enough
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02);
}

TEST(JawFingers, LetGoTheyKeepTheForceOnWhatRelaxes) {
  constexpr double kStiff = 300, kThick_m = 0.010;  // N/m; and half of its force goes within a second
  JawFingers jaw;
  jaw.begin(0.02);
  double relaxed_m = 0;
  const auto squeezed = [&] { return std::max(0.0, kStiff * (kThick_m - relaxed_m - jaw.opening_m())); };
  const auto step = [&](JawFingers::Wish wish) {
    wish.gripping = squeezed() > 0;
    wish.grip_n = squeezed();
    wish.fingers_m = jaw.opening_m();
    jaw.advance(wish, 0.001);
  };
  while (squeezed() < 1.5) step(kClose);
  const double kept = squeezed();
  step(kLetGo);
  for (int i = 0; i < 3000; ++i) {
    relaxed_m = std::min(0.0025, relaxed_m + 0.0025 * 0.001);
    step(kNothing);
  }
  EXPECT_NEAR(squeezed(), kept, 0.02);
  step(kOpen);
  for (int i = 0; i < 1000; ++i) step(kNothing);
  EXPECT_DOUBLE_EQ(squeezed(), 0);
}

TEST(JawFingers, AtAnObjectTheyAreNeverFarAheadOfTheFingers) {
  JawFingers jaw;
  jaw.begin(0.02);
  for (int i = 0; i < 2000; ++i) jaw.advance({.close = true, .gripping = true, .fingers_m = 0.014}, 0.001);
  EXPECT_NEAR(jaw.opening_m(), 0.014 - JawFingers::kAhead_m, 1e-12);
}

TEST(JawFingers, OpenNoWiderThanTheyCanWhereverTheHandsFingersAre) {
  constexpr double kFar_m = 0.035;
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.1);
  jaw.advance({.let_go = true, .fingers_m = kFar_m}, 0.001);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02) << "let go";
  jaw.advance({.close = true, .gripping = true, .fingers_m = kFar_m}, 0.001);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02) << "held";
  jaw.work({.close = true, .gripping = true, .fingers_m = kFar_m}, 0.001);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02) << "in tissue";
  run(jaw, kClose, 0.1);
  EXPECT_NEAR(jaw.opening_m(), 0.016, 1e-9) << "and close from there";
}

TEST(JawFingers, ClosedWhileUnusedAndOpenWhenUseBegins) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, {.used = false}, 1);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0);
  run(jaw, kNothing, 1);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02);
}

TEST(JawFingers, WiderInstrumentsOpenWider) {
  JawFingers jaw;
  jaw.begin(0.03);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.03);
  run(jaw, kClose, 0.8);
  run(jaw, kOpen, 1);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.03);
}

}  // namespace
}  // namespace trocar::jaw_fingers_test
