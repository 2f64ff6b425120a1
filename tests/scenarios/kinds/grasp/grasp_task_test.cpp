// The rules of limited grasp against told states: what places a block, and each way in which it goes wrong.
#include "scenarios/kinds/grasp/grasp_task.h"

#include <gtest/gtest.h>

#include "tests/scenarios/support/grasp_bench.h"

namespace trocar::grasp_task_test {
namespace {

TEST(GraspTask, LightsTheFirstBlockAndAsksToPickIt) {
  GraspBench bench;
  const DirectorStatus& status = bench.director.status();
  EXPECT_EQ(status.phase, Phase::kRun);
  EXPECT_EQ(status.target_index, 0);
  EXPECT_EQ(status.cue, Cue::kPick);
  EXPECT_EQ(status.demand.centre_T, bench.block(0).X_TO.p);
  EXPECT_EQ(status.demand.goal_T, bench.ring(0).centre_T);
  EXPECT_EQ(status.demand.band, bench.ring(0).band) << "the colour tells it at L1";
  ASSERT_EQ(status.demand.foam_count, 3);
  EXPECT_DOUBLE_EQ(status.demand.foam[2].stiffness_n_per_m, 550);
  EXPECT_DOUBLE_EQ(status.demand.foam[2].low_n, 1.2 * 1.20);
}

TEST(GraspTask, DoesNotTellTheGripWhereColourIsNoCue) {
  GraspBench bench("L3");
  EXPECT_EQ(bench.director.status().demand.band, WantedForce{});
  EXPECT_EQ(bench.director.status().demand.foam_count, 3) << "the briefing has taught it";
}

TEST(GraspTask, CuesFollowTheErrand) {
  GraspBench bench;
  bench.take(0);
  EXPECT_EQ(bench.director.status().cue, Cue::kCarry);
  bench.carry(bench.ring(0).centre_T);
  EXPECT_EQ(bench.director.status().cue, Cue::kPlace);
  bench.let_go();
  EXPECT_EQ(bench.director.status().cue, Cue::kPick);
  EXPECT_EQ(bench.director.status().target_index, 1);
  EXPECT_EQ(bench.director.status().targets_done, 1);
}

TEST(GraspTask, PlacesABlockThatWasLiftedCarriedAndSetDown) {
  GraspBench bench;
  bench.take(0);
  bench.carry(bench.ring(0).centre_T + Vec3(0.003, 0, 0));
  bench.let_go();
  for (const char* type : {"GRASPED", "LIFTED", "SET_DOWN", "PLACED"}) EXPECT_EQ(bench.count(type), 1) << type;
  EXPECT_NEAR(bench.last("PLACED").value, 0.003, 1e-9);
  EXPECT_EQ(bench.last("PLACED").severity, Severity::kInfo);
  EXPECT_NEAR(bench.last("GRASPED").value, bench.good_grip(0), 1e-12);
  EXPECT_EQ(bench.count("MISPLACED") + bench.count("DROP") + bench.count("SLIP") + bench.count("REGRASP"), 0);
  EXPECT_EQ(bench.director.status().done, std::bitset<32>(1));
  EXPECT_LT(bench.last("LIFTED").t_s, bench.last("SET_DOWN").t_s);
}

TEST(GraspTask, IsDoneWhenAllBlocksStand) {
  GraspBench bench;
  bench.place_all();
  EXPECT_EQ(bench.count("PLACED"), 6);
  EXPECT_EQ(bench.count("TARGET_LIT"), 6);
  EXPECT_EQ(bench.count("WRONG_BLOCK"), 0);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.director.status().done, std::bitset<32>(0b111111));
}

TEST(GraspTask, BesideTheRingIsMisplaced) {
  GraspBench bench;
  bench.take(0);
  bench.carry(bench.ring(0).centre_T + Vec3(0, 0.0042, 0));
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 0);
  EXPECT_EQ(bench.count("MISPLACED"), 1);
  EXPECT_NEAR(bench.last("MISPLACED").value, 0.0042, 1e-9);
  EXPECT_EQ(bench.last("MISPLACED").severity, Severity::kMinor);
  EXPECT_EQ(bench.director.status().target_index, 0) << "it is still asked for";
}

TEST(GraspTask, ALowCarryDoesNotPlace) {
  GraspBench bench;
  bench.take(0);
  bench.carry(bench.ring(0).centre_T, 0.0285);
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 0);
  EXPECT_EQ(bench.count("MISPLACED"), 1);
  EXPECT_EQ(bench.director.status().message, "Lift it higher on the way");
  bench.take(0);
  bench.carry(bench.ring(0).centre_T, 0.0295);
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 1) << "a lift may fall short by a millimetre";
}

TEST(GraspTask, ABlockIsPlacedOnWhicheverSideItLies) {
  GraspBench bench;  // what has tumbled cannot be set upright through a port
  bench.take(0);
  bench.carry(bench.ring(0).centre_T);
  bench.block(0).X_TO.R = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 1);
  EXPECT_EQ(bench.count("MISPLACED"), 0);
}

TEST(GraspTask, CountsEachCrushOnceAndMakesTheThirdCritical) {
  GraspBench bench;
  for (int i = 0; i < 4; ++i) {
    bench.take(i, 5.0);
    bench.block(i).crushed = true;
    bench.feed(0.5);
    EXPECT_EQ(bench.count("CRUSH"), i + 1);
    EXPECT_EQ(bench.last("CRUSH").severity, i == 2 ? Severity::kCritical : Severity::kMajor);
    EXPECT_EQ(bench.last("CRUSH").object, i);
    EXPECT_DOUBLE_EQ(bench.last("CRUSH").value, 5.0);
    bench.let_go();
  }
}

TEST(GraspTask, ACrushedBlockStillCanBePlaced) {
  GraspBench bench;
  bench.take(0);
  bench.block(0).crushed = true;
  bench.carry(bench.ring(0).centre_T);
  EXPECT_EQ(bench.director.status().wrong_places, 1);
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 1);
}

TEST(GraspTask, SlipIsAMillimetreOfCreepAndCountsOnceAHold) {
  GraspBench bench;
  bench.take(0);
  bench.glide(bench.state.X_TI.p + Vec3(0, 0, 0.02));
  bench.frame.grip = GripState::kSlipping;
  bench.frame.slipped_m = 0.0009;
  bench.feed(0.1);
  EXPECT_EQ(bench.count("SLIP"), 0);
  for (const double slipped : {0.0012, 0.003, 0.008}) {
    bench.frame.slipped_m = slipped;
    bench.feed(0.1);
    EXPECT_EQ(bench.count("SLIP"), 1) << "one creep is one slip";
  }
  EXPECT_NEAR(bench.last("SLIP").value, 0.0012, 1e-12);
  EXPECT_EQ(bench.director.status().message, "It slips - hold it tighter");
  bench.frame.grip = GripState::kHolding;
  bench.feed(0.1);
  bench.frame.grip = GripState::kSlipping;
  bench.frame.slipped_m = 0.0095;
  bench.feed(0.1);
  EXPECT_EQ(bench.count("SLIP"), 2) << "held again in between";
}

TEST(GraspTask, AFallOfMoreThanFiveMillimetresIsADrop) {
  for (const double height : {0.0045, 0.0055}) {
    GraspBench bench;
    bench.take(0);
    bench.carry(bench.ring(0).centre_T);
    bench.glide(bench.state.X_TI.p + Vec3(0, 0, height));
    bench.let_go();
    const bool dropped = height > 0.005;
    EXPECT_EQ(bench.count("DROP"), dropped ? 1 : 0) << height;
    EXPECT_EQ(bench.count("PLACED"), dropped ? 0 : 1) << height;
    EXPECT_EQ(bench.count("MISPLACED"), 0) << "a fall is told once";
    if (!dropped) continue;
    EXPECT_NEAR(bench.last("DROP").value, height, 1e-9);
    EXPECT_EQ(bench.last("DROP").severity, Severity::kMajor);
  }
}

TEST(GraspTask, ADroppedBlockIsGraspedAgainAndThenPlaced) {
  GraspBench bench;
  bench.take(0);
  bench.glide(bench.state.X_TI.p + Vec3(0, 0, 0.035));
  bench.let_go();
  EXPECT_EQ(bench.director.status().message, "Dropped - pick it up again");
  bench.place(0);
  EXPECT_EQ(bench.count("GRASPED"), 1);
  EXPECT_EQ(bench.count("REGRASP"), 1);
  EXPECT_EQ(bench.last("REGRASP").severity, Severity::kMinor);
  EXPECT_EQ(bench.count("PLACED"), 1);
}

TEST(GraspTask, AnotherBlockThanTheLitOneIsNoted) {
  GraspBench bench;
  bench.take(3);
  EXPECT_EQ(bench.count("WRONG_BLOCK"), 1);
  EXPECT_EQ(bench.last("WRONG_BLOCK").object, 3);
  EXPECT_EQ(bench.director.status().target_index, 0);
  EXPECT_EQ(bench.director.status().cue, Cue::kPick) << "the lit one is still to be picked";
}

TEST(GraspTask, APlacedBlockPushedOutIsAskedForAgain) {
  GraspBench bench;
  bench.place(0);
  bench.block(0).X_TO.p.x() += 0.0048;
  bench.feed(0.05);
  EXPECT_EQ(bench.count("REMOVED"), 0) << "a millimetre beyond the tolerance is forgiven";
  bench.block(0).X_TO.p.x() += 0.0004;
  bench.feed(0.05);
  EXPECT_EQ(bench.count("REMOVED"), 1);
  EXPECT_EQ(bench.director.status().targets_done, 0);
  EXPECT_TRUE(bench.director.status().done.none());
  EXPECT_EQ(bench.director.status().target_index, 1) << "the one that is lit stays lit";
  for (int i = 1; i < 6; ++i) bench.place(i);
  EXPECT_FALSE(bench.director.finished());
  EXPECT_EQ(bench.director.status().target_index, 0);
}

TEST(GraspTask, ABlockFarOutsideIsLost) {
  GraspBench bench;
  bench.block(0).X_TO.p = Vec3(-0.064, 0, bench.half_height());
  bench.feed(0.05);
  EXPECT_EQ(bench.count("LOST"), 0) << "within 15 mm of the edge it can be fetched";
  bench.block(0).X_TO.p.x() = -0.068;
  bench.feed(0.5);
  EXPECT_EQ(bench.count("LOST"), 1);
  EXPECT_NEAR(bench.last("LOST").value, 0.003, 1e-9);
  EXPECT_EQ(bench.last("LOST").severity, Severity::kCritical);
  EXPECT_EQ(bench.director.status().target_index, 1);
}

TEST(GraspTask, TimeRunsOut) {
  GraspBench bench;
  bench.place(0);
  bench.feed(151);
  EXPECT_EQ(bench.director.status().phase, Phase::kTimeout);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kTimeout);
  EXPECT_EQ(bench.last("TIMEOUT").severity, Severity::kMajor);
  EXPECT_NEAR(bench.last("TIMEOUT").t_s - bench.last("START").t_s, 150, 0.02);
  const Grade grade = bench.grade();
  ASSERT_TRUE(grade.score.has_value());
  EXPECT_LE(*grade.score, 49.0 / 6 + 1e-9) << "one of six blocks";
  EXPECT_FALSE(grade.passed);
}

}  // namespace
}  // namespace trocar::grasp_task_test
