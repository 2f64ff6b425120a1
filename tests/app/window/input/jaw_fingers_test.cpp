#include "app/window/input/jaw_fingers.h"

#include <gtest/gtest.h>

namespace trocar::jaw_fingers_test {
namespace {

void run(JawFingers& jaw, const JawFingers::Wish& wish, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 1000 + 0.5); ++i) jaw.advance(wish, 0.001);
}

const JawFingers::Wish kClose{true, false, false, 0}, kOpen{false, true, false, 0}, kNothing{};

TEST(JawFingers, CloseWithinFourTenthsThenSqueezeSlowly) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.2);
  EXPECT_NEAR(jaw.opening_m(), 0.010, 1e-4);
  run(jaw, kClose, 0.2);
  EXPECT_NEAR(jaw.opening_m(), 0, 1e-4);
  run(jaw, kClose, 1);
  EXPECT_NEAR(jaw.opening_m(), -0.005, 1e-4);
  run(jaw, kClose, 3);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), JawFingers::kTightest_m);
}

TEST(JawFingers, ReleasedTheyOpenUnlessLatched) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.2);
  run(jaw, kNothing, 0.1);
  EXPECT_NEAR(jaw.opening_m(), 0.015, 1e-4);
  run(jaw, kClose, 0.1);
  jaw.toggle_latch();
  run(jaw, kNothing, 5);
  EXPECT_NEAR(jaw.opening_m(), 0.010, 1e-4);
  jaw.toggle_latch();
  run(jaw, kNothing, 1);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02);
}

TEST(JawFingers, LatchedTheyTightenSlowlyAndOpenFully) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, kClose, 0.1);
  jaw.toggle_latch();
  run(jaw, kClose, 1);
  EXPECT_NEAR(jaw.opening_m(), 0.010, 1e-4);  // 5 mm/s
  run(jaw, kOpen, 0.5);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02);
  EXPECT_FALSE(jaw.latched());
}

TEST(JawFingers, FineIsSlowInBothDirections) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, {true, false, true, 0}, 1);
  EXPECT_NEAR(jaw.opening_m(), 0.015, 1e-4);
  jaw.toggle_latch();
  run(jaw, {false, true, true, 0}, 0.4);
  EXPECT_NEAR(jaw.opening_m(), 0.017, 1e-4);
  EXPECT_TRUE(jaw.latched());
}

TEST(JawFingers, TriggerSaysTheOpening) {
  JawFingers jaw;
  jaw.begin(0.02);
  run(jaw, {false, false, false, 0.5}, 2);
  EXPECT_NEAR(jaw.opening_m(), 0.005, 1e-9);
  run(jaw, {false, false, false, 1}, 2);
  EXPECT_NEAR(jaw.opening_m(), JawFingers::kTightest_m, 1e-9);
  run(jaw, kNothing, 2);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.02);
}

TEST(JawFingers, HoldKeepsWhatIsHeldAndNothingElse) {
  JawFingers jaw;
  jaw.begin(0.02);
  jaw.hold();
  EXPECT_FALSE(jaw.latched());
  run(jaw, kClose, 0.2);
  jaw.hold();
  run(jaw, kNothing, 1);
  EXPECT_NEAR(jaw.opening_m(), 0.010, 1e-4);
}

TEST(JawFingers, WiderInstrumentsOpenWider) {
  JawFingers jaw;
  jaw.begin(0.03);
  EXPECT_DOUBLE_EQ(jaw.opening_m(), 0.03);
  run(jaw, kClose, 0.4);
  EXPECT_NEAR(jaw.opening_m(), 0, 1e-4);
}

}  // namespace
}  // namespace trocar::jaw_fingers_test
