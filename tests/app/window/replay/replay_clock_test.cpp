// The clock of a replay, without any screen: speeds, ends, steps, jumps, loops.
#include "app/window/replay/replay_clock.h"

#include <gtest/gtest.h>

namespace trocar::replay_clock_test {
namespace {

ReplayClock clock_of(double from, double to) {
  ReplayClock clock;
  clock.set_range(from, to);
  return clock;
}

TEST(ReplayClock, PlaysFromTheBeginningAndStopsAtTheEnd) {
  ReplayClock clock = clock_of(-1, 3);
  EXPECT_EQ(clock.now_s(), -1);
  EXPECT_TRUE(clock.playing());
  clock.advance(0.5, 10);
  EXPECT_DOUBLE_EQ(clock.now_s(), -0.5);
  clock.advance(30, 10);
  EXPECT_EQ(clock.now_s(), 3);
  EXPECT_FALSE(clock.playing());
  clock.toggle_play();
  EXPECT_EQ(clock.now_s(), -1) << "from the end it begins again";
  clock.toggle_play();
  clock.advance(1, 10);
  EXPECT_EQ(clock.now_s(), -1);
}

TEST(ReplayClock, WaitsForWhatIsStillBeingRun) {
  ReplayClock clock = clock_of(0, 100);
  clock.advance(5, 2);
  EXPECT_EQ(clock.now_s(), 2);
  EXPECT_TRUE(clock.playing());
  clock.go(50);
  clock.advance(1, 2);
  EXPECT_EQ(clock.now_s(), 50) << "but it never runs back";
}

TEST(ReplayClock, HasFiveSpeeds) {
  ReplayClock clock = clock_of(0, 100);
  EXPECT_EQ(clock.speed(), 1);
  clock.change_speed(-1);
  clock.change_speed(-1);
  clock.change_speed(-1);
  EXPECT_EQ(clock.speed(), 0.25);
  clock.advance(2, 100);
  EXPECT_DOUBLE_EQ(clock.now_s(), 0.5);
  for (int i = 0; i < 9; ++i) clock.change_speed(1);
  EXPECT_EQ(clock.speed(), 4);
}

TEST(ReplayClock, StepsStandStillAndStayOnTheirGrid) {
  ReplayClock clock = clock_of(-1, 1);
  clock.go(0.013);
  clock.step(1);
  EXPECT_FALSE(clock.playing());
  EXPECT_DOUBLE_EQ(clock.now_s(), 0.04);
  clock.step(-3);
  EXPECT_DOUBLE_EQ(clock.now_s(), -0.08);
  clock.step(1000);
  EXPECT_EQ(clock.now_s(), 1);
}

TEST(ReplayClock, JumpsToTheNearestMarkThatWay) {
  ReplayClock clock = clock_of(0, 20);
  const std::vector<double> marks{12, 4, 8};
  EXPECT_TRUE(clock.jump(marks, 1));
  EXPECT_EQ(clock.now_s(), 4);
  EXPECT_TRUE(clock.jump(marks, 1));
  EXPECT_EQ(clock.now_s(), 8);
  clock.advance(0.3, 20);
  EXPECT_TRUE(clock.jump(marks, -1));
  EXPECT_EQ(clock.now_s(), 4) << "playing on a little after a mark still counts as that mark";
  EXPECT_FALSE(clock.jump(marks, -1));
  EXPECT_EQ(clock.now_s(), 4);
  clock.go(13);
  EXPECT_FALSE(clock.jump(marks, 1));
  EXPECT_FALSE(clock.jump({}, 1));
}

TEST(ReplayClock, RepeatsWhatLiesBetweenAAndB) {
  ReplayClock clock = clock_of(0, 20);
  clock.go(6);
  clock.next_loop_point();
  EXPECT_EQ(clock.loop_a_s(), 6);
  clock.go(4);
  clock.next_loop_point();
  EXPECT_EQ(clock.loop_a_s(), 4) << "in either order";
  EXPECT_EQ(clock.loop_b_s(), 6);
  for (int i = 0; i < 100; ++i) {
    clock.advance(0.1, 20);
    EXPECT_GE(clock.now_s(), 4);
    EXPECT_LE(clock.now_s(), 6.0001);
  }
  clock.go(10);
  clock.advance(0.5, 20);
  EXPECT_EQ(clock.now_s(), 10.5) << "whoever goes beyond B is left alone";
  clock.next_loop_point();
  EXPECT_FALSE(clock.loop_a_s() || clock.loop_b_s());
  clock.next_loop_point();
  clock.next_loop_point();
  EXPECT_GT(*clock.loop_b_s(), *clock.loop_a_s()) << "never empty";
}

TEST(ReplayClock, ALongerRunBesideMovesTheEndOnly) {
  ReplayClock clock = clock_of(-1, 10);
  clock.go(7);
  clock.set_range(-0.5, 30);
  EXPECT_EQ(clock.now_s(), 7);
  EXPECT_EQ(clock.to_s(), 30);
  clock.go(25);
  clock.set_range(-1, 10);
  EXPECT_EQ(clock.now_s(), 10);
}

}  // namespace
}  // namespace trocar::replay_clock_test
