// Homing tick by tick: what is asked for next, what is wrong, where the zero comes to lie.
#include "haptics/control/homing.h"

#include <gtest/gtest.h>

#include "haptics/device/index_mark.h"
#include "tests/support/allocation_guard.h"

namespace trocar::homing_test {
namespace {

constexpr double kTick_s = 1e-3;
constexpr int kRoll = 5;
using Counts = Homing::Counts;

class HomingTicks : public ::testing::Test {
 protected:
  void be(const HomingModel& model, const HomingLimits& limits = {}) {
    homing = Homing(limits, model, kTick_s);
    homing.begin();
  }
  bool tick(bool beam, const Counts& delta = {}, std::uint32_t inputs = 0) {
    DaqSample in;
    in.digital_in = inputs | (beam ? std::uint32_t{kHomeBeam} : 0u);
    const test::AllocationGuard guard;
    const bool homed = homing.update(in, delta);
    EXPECT_EQ(guard.allocations(), 0u);
    place += delta[kRoll];
    return homed;
  }
  bool wait(int ticks, bool beam) {
    bool homed = false;
    for (int k = 0; k < ticks && !homed; ++k) homed = tick(beam);
    return homed;
  }
  /// Turns joint 6 a count a tick to `to`; light between `from` and `until`.
  void turn(int to, int from, int until) {
    while (place != to) {
      Counts d{};
      d[kRoll] = place < to ? 1 : -1;
      const int next = place + d[kRoll];
      tick(next > from && next < until, d);
    }
  }
  HomingStep step() const { return homing.report().step; }
  HomingTrouble trouble() const { return homing.report().trouble; }

  Homing homing{{}, {}, kTick_s};
  int place = 0;
};

TEST_F(HomingTicks, OfTheThesisAskForTheJigThenForRest) {
  be({});
  EXPECT_FALSE(wait(100, false));
  EXPECT_EQ(step(), HomingStep::kJig);
  EXPECT_FALSE(wait(300, true));
  EXPECT_EQ(step(), HomingStep::kStill);
  EXPECT_TRUE(wait(201, true));
  EXPECT_EQ(step(), HomingStep::kHomed);
  EXPECT_TRUE(homing.offset().isZero());
}

TEST_F(HomingTicks, ALightThatWasNeverDarkIsDoubtedWhereSoAsked) {
  be({.see_dark = true});
  EXPECT_FALSE(wait(2000, true));
  EXPECT_EQ(step(), HomingStep::kRoll);
  wait(3, false);
  EXPECT_FALSE(wait(400, true)) << "a flicker is no darkness";
  EXPECT_EQ(step(), HomingStep::kRoll);
  wait(6, false);
  EXPECT_TRUE(wait(600, true));
}

TEST_F(HomingTicks, MovingWhereItShouldRestIsToldWithTheJoint) {
  be({});
  wait(300, true);
  Counts moved{};
  moved[2] = -1;
  tick(true, moved);
  EXPECT_EQ(trouble(), HomingTrouble::kMoved);
  EXPECT_EQ(homing.report().channel, 2);
  EXPECT_FALSE(wait(400, true)) << "begins anew";
  EXPECT_TRUE(wait(101, true));
  EXPECT_EQ(trouble(), HomingTrouble::kNone);
}

TEST_F(HomingTicks, ADarkChannelAndALongWaitAreTold) {
  be({}, {.dark_s = 0.5, .limit_s = 1.5});
  EXPECT_FALSE(wait(510, false));
  EXPECT_EQ(trouble(), HomingTrouble::kDark);
  tick(true);
  EXPECT_EQ(trouble(), HomingTrouble::kNone);
  for (int k = 0; k < 30; ++k) wait(40, k % 2);
  EXPECT_EQ(trouble(), HomingTrouble::kTimeout);
  EXPECT_TRUE(wait(600, true)) << "a wait of long is told, and forbids nothing";
}

TEST_F(HomingTicks, ALightThatFollowsTheArmEverywhereNeverHomes) {
  be({});
  Counts d{};
  d[1] = 2;
  for (int k = 0; k < 310; ++k) tick(true, d);
  EXPECT_EQ(trouble(), HomingTrouble::kAlwaysLit);
  EXPECT_FALSE(wait(3000, true));
  wait(10, false);
  EXPECT_TRUE(wait(600, true)) << "once it has been dark it is believed";
}

TEST_F(HomingTicks, EdgesGiveTheMiddleWhateverTheHysteresis) {
  be({.method = HomingMethod::kEdges});
  place = -400;
  turn(200, -125, 140);  // on at -124, off only at 140
  turn(60, -140, 125);   // back: on at 124
  EXPECT_EQ(step(), HomingStep::kStill);
  EXPECT_TRUE(wait(501, true));
  EXPECT_NEAR(homing.offset()[kRoll], 60, 1e-9) << "60 counts off the middle of -124 and 124";
}

TEST_F(HomingTicks, AWindowThatIsNoneOfTheJigsIsRefused) {
  be({.method = HomingMethod::kEdges});
  place = -400;
  turn(100, -30, 30);
  turn(0, -30, 30);
  EXPECT_FALSE(wait(600, true));
  EXPECT_EQ(trouble(), HomingTrouble::kWrongPose) << "tilted in the jig: the light is narrow";
  EXPECT_EQ(homing.report().channel, kRoll);
  turn(300, -125, 125);
  turn(-300, -125, 125);
  turn(0, -125, 125);
  EXPECT_TRUE(wait(501, true)) << "turned through once more";
}

TEST_F(HomingTicks, AJointThatDoesNotCountIsFoundByItsLight) {
  be({.method = HomingMethod::kEdges});
  Counts one{};
  one[kRoll] = 1;
  tick(false, one);
  wait(20, false), wait(20, true);
  wait(20, false);
  one[kRoll] = -1;
  tick(false, one), one[kRoll] = 1, tick(false, one), one[kRoll] = -1, tick(false, one);
  wait(20, false), wait(20, true);
  EXPECT_FALSE(wait(600, true));
  EXPECT_TRUE(trouble() == HomingTrouble::kDeadChannel || trouble() == HomingTrouble::kWrongPose);
}

TEST_F(HomingTicks, MarksTellTheZeroToACountAndWhichTurnIsTheJigs) {
  HomingModel model{.method = HomingMethod::kIndex};
  model.index_counts = {700, -700, 10, 990, -990, 0};
  be(model);
  wait(10, false);
  EXPECT_EQ(step(), HomingStep::kMarks);
  EXPECT_EQ(homing.report().missing, 0x3F);
  // Each joint from its mark into the jig, which misses home by 3 counts.
  for (int i = 0; i < kArmJoints; ++i) {
    tick(false, {}, index_mark(i));
    Counts d{};
    d[static_cast<std::size_t>(i)] = 3 - model.index_counts[static_cast<std::size_t>(i)] + (i == 3 ? 2000 : 0);
    tick(false, d);
  }
  EXPECT_EQ(homing.report().missing, 0);
  EXPECT_TRUE(wait(600, true));
  for (int i = 0; i < kArmJoints; ++i) EXPECT_NEAR(homing.offset()[i], 3, 1e-9) << i;
  for (int i = 0; i < kArmJoints; ++i)
    EXPECT_NEAR(homing.marks()[i], model.index_counts[static_cast<std::size_t>(i)], 1e-9) << "and learns the same";
}

TEST_F(HomingTicks, AnArmThatSitsWrongInTheJigIsToldByItsMarks) {
  be({.method = HomingMethod::kIndex});
  for (int i = 0; i < kArmJoints; ++i) tick(false, {}, index_mark(i));
  Counts off{};
  off[1] = 200;
  tick(false, off);
  EXPECT_FALSE(wait(2000, true));
  EXPECT_EQ(trouble(), HomingTrouble::kWrongPose);
  EXPECT_EQ(homing.report().channel, 1);
  EXPECT_NEAR(homing.report().value, 200, 1e-9);
}

TEST_F(HomingTicks, TheTrembleOfAPotentiometerIsNoMotion) {
  HomingLimits limits;
  limits.still_counts[kPinchChannel] = 3;
  be({}, limits);
  Counts tremble{};
  bool homed = false;
  for (int k = 0; k < 600 && !homed; ++k) {
    tremble[kPinchChannel] = k % 2 ? 3 : -3;
    homed = tick(true, tremble);
  }
  EXPECT_TRUE(homed);
}

}  // namespace
}  // namespace trocar::homing_test
