// The rules of peg transfer against told states: what moves a ring, and each way in which it goes wrong.
#include "scenarios/kinds/pegs/peg_task.h"

#include <gtest/gtest.h>

#include "tests/scenarios/support/pegs_bench.h"

namespace trocar::peg_task_test {
namespace {

TEST(PegTask, LightsTheFirstRingAndItsPeg) {
  PegsBench bench;
  const DirectorStatus& status = bench.director.status();
  EXPECT_EQ(status.phase, Phase::kRun);
  EXPECT_EQ(status.target_index, 0);
  EXPECT_EQ(status.cue, Cue::kPick);
  EXPECT_EQ(status.demand.centre_T, bench.ring(0).X_TO.p);
  EXPECT_EQ(status.demand.goal_T, bench.goal(0).centre_T);
  EXPECT_EQ(status.demand.band, (WantedForce{1.4, 3.0}));
  EXPECT_EQ(status.demand.foam_count, 1);
}

TEST(PegTask, CuesFollowTheErrand) {
  PegsBench bench;
  bench.take(0);
  EXPECT_EQ(bench.director.status().cue, Cue::kCarry);
  bench.carry(bench.goal(0).centre_T);
  EXPECT_EQ(bench.director.status().cue, Cue::kPlace);
  bench.let_go();
  EXPECT_EQ(bench.director.status().cue, Cue::kPick);
  EXPECT_EQ(bench.director.status().target_index, 1);
}

TEST(PegTask, ARingOnItsPegIsMoved) {
  PegsBench bench;
  bench.take(0);
  bench.carry(bench.goal(0).centre_T + Vec3(0.001, 0, 0));
  bench.let_go();
  for (const char* type : {"GRASPED", "LIFTED", "SET_DOWN", "TARGET_HELD"}) EXPECT_EQ(bench.count(type), 1) << type;
  EXPECT_NEAR(bench.last("TARGET_HELD").value, 0.001, 1e-9);
  for (const char* type : {"BUMP", "DROP", "MISPLACED", "REGRASP", "GRIP_EXCESS", "WRONG_BLOCK"})
    EXPECT_EQ(bench.count(type), 0) << type;
}

TEST(PegTask, ARingMayFallDownThePegThatItIsOn) {
  PegsBench bench;
  bench.take(0);
  bench.carry(bench.goal(0).centre_T, 0.022);
  bench.let_go();
  EXPECT_EQ(bench.count("TARGET_HELD"), 1);
  EXPECT_EQ(bench.count("DROP"), 0);
}

TEST(PegTask, AllRingsGoAcrossAndThenBackToWhereTheyCameFrom) {
  PegsBench bench;
  const auto rings = bench.director.board().rigid.blocks;
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(bench.director.status().target_index, i);
    bench.transfer(i);
  }
  EXPECT_EQ(bench.count("TARGET_HELD"), 12);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.director.status().done.count(), 12u);
  for (int i = 0; i < 6; ++i)
    EXPECT_LT((bench.ring(i).X_TO.p - rings[static_cast<std::size_t>(i)].X_TO.p).norm(), 1e-9) << i;
}

TEST(PegTask, ComingDownBesideTheMiddleBumpsOnce) {
  PegsBench bench;
  bench.take(0);
  bench.carry(bench.goal(0).centre_T + Vec3(0.0021, 0, 0), 0.020);
  EXPECT_EQ(bench.count("BUMP"), 1);
  EXPECT_NEAR(bench.last("BUMP").value, 0.0021, 1e-9);
  EXPECT_EQ(bench.last("BUMP").severity, Severity::kMinor);
  bench.glide(bench.goal(0).centre_T + Vec3(0.003, 0, 0.020));
  EXPECT_EQ(bench.count("BUMP"), 1) << "along the same peg";
  bench.carry(bench.goal(0).centre_T + Vec3(0.0021, 0, 0), 0.020);
  EXPECT_EQ(bench.count("BUMP"), 2) << "lifted off and set on anew";
}

TEST(PegTask, ALowCarryAgainstAPegIsABump) {
  PegsBench bench;
  bench.take(0);
  bench.glide(bench.state.X_TI.p + Vec3(0, 0, 0.034));
  EXPECT_EQ(bench.count("BUMP"), 0) << "the peg that it came from is none";
  const Vec3 peg = bench.goal(0).centre_T;
  bench.glide(peg + Vec3(-0.020, 0, 0.039));
  bench.glide(peg + Vec3(-0.020, 0, 0.020));
  bench.glide(peg + Vec3(-0.005, 0, 0.020));
  EXPECT_EQ(bench.count("BUMP"), 1);
}

TEST(PegTask, AFallBesideThePegsIsADropAndTheRingStaysAskedFor) {
  PegsBench bench;
  bench.take(0);
  bench.glide(Vec3(0, 0, PegsBench::kHigh));
  bench.let_go();
  EXPECT_EQ(bench.count("DROP"), 1);
  EXPECT_EQ(bench.last("DROP").severity, Severity::kMajor);
  EXPECT_NEAR(bench.last("DROP").value, 0.034, 1e-9);
  EXPECT_EQ(bench.director.status().target_index, 0);
  bench.take(0);
  bench.carry(bench.goal(0).centre_T);
  bench.let_go();
  EXPECT_EQ(bench.count("REGRASP"), 1);
  EXPECT_EQ(bench.count("TARGET_HELD"), 1);
}

TEST(PegTask, AnotherPegIsMisplaced) {
  PegsBench bench;
  bench.take(0);
  bench.carry(bench.goal(1).centre_T);
  bench.let_go();
  EXPECT_EQ(bench.count("MISPLACED"), 1);
  EXPECT_EQ(bench.count("DROP") + bench.count("TARGET_HELD"), 0);
  EXPECT_EQ(bench.director.status().message, "That is another peg");
}

TEST(PegTask, ARingThatHangsOnAPegAskewIsNotMoved) {
  PegsBench bench;
  bench.take(0);
  bench.carry(bench.goal(0).centre_T, 0.020);
  bench.ring(0).X_TO.R = Eigen::AngleAxisd(0.6, Vec3::UnitX()).toRotationMatrix();
  bench.let_go(0.012);
  EXPECT_EQ(bench.count("TARGET_HELD"), 0);
}

TEST(PegTask, OutsideTheFieldIsLostForGood) {
  PegsBench bench;
  bench.take(0);
  bench.carry(Vec3(0, 0.0785, 0));
  bench.let_go();
  ASSERT_EQ(bench.count("LOST"), 1);
  EXPECT_EQ(bench.last("LOST").severity, Severity::kCritical);
  EXPECT_EQ(bench.director.status().target_index, 1);
  for (int i = 1; i < 12; ++i)
    if (i != 6) bench.transfer(i);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_LE(bench.grade().score.value(), 49);
}

TEST(PegTask, EachTightGripMarksOnce) {
  PegsBench bench;
  bench.take(0, 3.6);
  EXPECT_EQ(bench.count("GRIP_EXCESS"), 1);
  bench.state.grip_force_n = 3.3;
  bench.feed(0.1);
  bench.state.grip_force_n = 3.6;
  bench.feed(0.1);
  EXPECT_EQ(bench.count("GRIP_EXCESS"), 1) << "not let off enough";
  bench.state.grip_force_n = 2.0;
  bench.feed(0.1);
  bench.state.grip_force_n = 4.0;
  bench.feed(0.1);
  EXPECT_EQ(bench.count("GRIP_EXCESS"), 2);
  EXPECT_EQ(bench.last("GRIP_EXCESS").severity, Severity::kMajor);
}

TEST(PegTask, SlidingThroughTheJawsIsASlip) {
  PegsBench bench;
  bench.take(0, 0.6);
  bench.frame.grip = GripState::kSlipping;
  bench.frame.slipped_m = 0.0015;
  bench.feed(0.1);
  EXPECT_EQ(bench.count("SLIP"), 1);
}

TEST(PegTask, TellsWhichRingWasTakenInPlaceOfTheLitOne) {
  PegsBench bench;
  bench.take(3);
  EXPECT_EQ(bench.count("WRONG_BLOCK"), 1);
  EXPECT_EQ(bench.last("WRONG_BLOCK").object, 3);
}

// ---- What is no use ------------------------------------------------------------------------------------------------

TEST(PegTricks, NothingIsMovedByTakingAndLettingGoOnThePeg) {
  PegsBench bench;
  for (int i = 0; i < 5; ++i) {
    bench.take(0);
    bench.let_go();
  }
  EXPECT_EQ(bench.count("TARGET_HELD"), 0);
  EXPECT_EQ(bench.director.status().targets_done, 0);
}

TEST(PegTricks, ARingMovedTwiceIsMovedOnce) {
  PegsBench bench;
  bench.transfer(0);
  bench.take(0);
  bench.carry(bench.goal(0).centre_T);
  bench.let_go();
  EXPECT_EQ(bench.count("TARGET_HELD"), 1);
  EXPECT_EQ(bench.count("MISPLACED"), 1) << "it is asked back, not here";
}

TEST(PegTricks, DwellingBringsNothing) {
  PegsBench quick, slow;
  for (int i = 0; i < 12; ++i) {
    quick.transfer(i);
    slow.transfer(i);
    slow.feed(8);
  }
  EXPECT_LT(slow.grade().score.value(), quick.grade().score.value());
}

TEST(PegTricks, AnErrorMoreNeverRaisesTheScore) {
  PegsBench bench;
  for (int i = 0; i < 12; ++i) bench.transfer(i);
  const double before = bench.grade().score.value();
  for (const EventType type : {event_type::kBump, event_type::kDrop, event_type::kGripExcess, event_type::kLost}) {
    std::vector<Event> events = bench.director.events();
    Event error = events[events.size() / 2];
    error.type = type.name;
    error.severity = type.name == event_type::kLost.name ? Severity::kCritical : Severity::kMinor;
    events.insert(events.begin() + static_cast<std::ptrdiff_t>(events.size() / 2), error);
    EXPECT_LT(bench.grade(events).score.value(), before) << type.name;
  }
}

TEST(PegTricks, OneRingAndThenNothingIsATwelfthOfAnUnfinishedRun) {
  PegsBench bench;
  bench.transfer(0);
  bench.feed(300);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kTimeout);
  EXPECT_LE(bench.grade().score.value(), 49.0 / 12 + 1e-9);
}

}  // namespace
}  // namespace trocar::peg_task_test
