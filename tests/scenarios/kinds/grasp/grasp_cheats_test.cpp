// Ways to look better than one is at limited grasp: none of them gains anything.
#include <gtest/gtest.h>

#include "tests/scenarios/support/grasp_bench.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::grasp_cheats_test {
namespace {

Grade honest() {
  GraspBench bench;
  bench.place_all();
  return bench.grade();
}

/// Moves a block over the board without the jaws having it.
void push(GraspBench& bench, int index, const Vec3& to) {
  const Vec3 from = bench.block(index).X_TO.p;
  bench.block(index).motion = ObjectMotion::kMoving;
  for (int i = 1; i <= 20; ++i) {
    bench.block(index).X_TO.p.head<2>() = (from + (to - from) * i / 20).head<2>();
    bench.feed(0.02);
  }
  bench.block(index).motion = ObjectMotion::kResting;
  bench.feed(0.1);
}

TEST(GraspCheats, PushingABlockIntoItsRingPlacesNothing) {
  GraspBench bench;
  for (int i = 0; i < 6; ++i) push(bench, i, bench.ring(i).centre_T);
  EXPECT_EQ(bench.count("PLACED"), 0);
  EXPECT_EQ(bench.director.status().targets_done, 0);
  bench.feed(150);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kTimeout);
  EXPECT_EQ(bench.grade().score.value(), 0);
}

TEST(GraspCheats, PushingABlockThatIsHeldOnTheBoardPlacesNothing) {
  GraspBench bench;
  bench.take(0);
  bench.carry(bench.ring(0).centre_T, 0);
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED") + bench.count("LIFTED"), 0);
}

TEST(GraspCheats, ALiftOnTheSpotDoesNotServeALaterPush) {
  GraspBench bench;
  bench.take(0);
  bench.carry(bench.block(0).X_TO.p);
  bench.let_go();
  EXPECT_EQ(bench.count("MISPLACED"), 1);
  push(bench, 0, bench.ring(0).centre_T);
  EXPECT_EQ(bench.count("PLACED"), 0);
  bench.take(0);
  bench.feed(0.1);
  bench.let_go();
  EXPECT_EQ(bench.count("PLACED"), 0) << "the lift was of another grasp";
  EXPECT_EQ(bench.count("REGRASP"), 1);
}

TEST(GraspCheats, ThrowingABlockIntoItsRingPlacesNothing) {
  GraspBench bench;
  bench.take(0);
  bench.glide(bench.state.X_TI.p + Vec3(0, 0, 0.034));
  bench.glide(bench.ring(0).centre_T + Vec3(0, 0, 0.044));
  bench.let_go();
  EXPECT_EQ(bench.count("DROP"), 1);
  EXPECT_EQ(bench.count("PLACED"), 0);
}

TEST(GraspCheats, ABlockDraggedAlongByTheHeldOneIsNotPlaced) {
  GraspBench bench;
  bench.take(0);
  bench.glide(bench.state.X_TI.p + Vec3(0, 0, 0.034));
  bench.block(1).X_TO.p.z() += 0.034;
  bench.block(1).motion = ObjectMotion::kMoving;
  bench.glide(bench.ring(0).centre_T + Vec3(0, 0, 0.044));
  push(bench, 1, bench.ring(1).centre_T);
  bench.glide(bench.ring(0).centre_T + Vec3(0, 0, bench.half_height()));
  bench.let_go();
  bench.block(1).X_TO.p.z() = bench.half_height();
  bench.feed(0.5);
  EXPECT_EQ(bench.count("PLACED"), 1);
  EXPECT_EQ(bench.last("PLACED").object, 0);
  EXPECT_EQ(bench.director.status().target_index, 1) << "it is asked for as before";
}

TEST(GraspCheats, RegraspLoopsOnlyCost) {
  GraspBench bench;
  bench.take(0);
  for (int i = 0; i < 3; ++i) {
    bench.let_go();
    bench.take(0);
  }
  bench.carry(bench.ring(0).centre_T);
  bench.let_go();
  for (int i = 1; i < 6; ++i) bench.place(i);
  const Grade grade = bench.grade();
  EXPECT_EQ(value_of(grade.metrics, "block_regrasps"), 3.0);
  EXPECT_EQ(value_of(grade.metrics, "objects_done_share"), 1.0);
  EXPECT_LE(grade.score.value(), honest().score.value() - 100 * 0.15 * 3 / 4 + 1e-9);
}

TEST(GraspCheats, TakingAPlacedBlockOutAndBackCountsItOnce) {
  GraspBench bench;
  bench.place(0);
  bench.take(0);
  EXPECT_EQ(bench.count("REMOVED"), 1);
  bench.carry(bench.ring(0).centre_T);
  bench.let_go();
  EXPECT_EQ(bench.director.status().targets_done, 1);
  for (int i = 1; i < 6; ++i) bench.place(i);
  const Grade grade = bench.grade();
  EXPECT_EQ(value_of(grade.metrics, "objects_done_share"), 1.0) << "never more than all";
  EXPECT_LT(grade.score.value(), honest().score.value());
}

TEST(GraspCheats, AnotherOrderGainsNothing) {
  GraspBench bench;
  for (int i = 5; i >= 0; --i) bench.place(i);
  EXPECT_EQ(bench.count("WRONG_BLOCK"), 5);
  EXPECT_EQ(bench.director.status().targets_done, 6);
  const Grade grade = bench.grade(), usual = honest();
  for (std::size_t i = 0; i < usual.subscores.size(); ++i) {
    if (usual.subscores[i].name == "time") continue;
    EXPECT_LE(grade.subscores[i].value, usual.subscores[i].value) << usual.subscores[i].name;
  }
}

const Cap* cap_of(const Grade& grade, CapKind kind) {
  const auto at = std::find_if(grade.caps.begin(), grade.caps.end(), [&](const Cap& cap) { return cap.kind == kind; });
  return at == grade.caps.end() ? nullptr : &*at;
}

TEST(GraspCheats, SweepingTheBoardEmptyEarnsNothing) {
  GraspBench bench;
  for (int i = 0; i < 6; ++i) push(bench, i, Vec3(-0.080, 0, 0));
  EXPECT_EQ(bench.count("LOST"), 6);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted) << "there is nothing left to do";
  const Grade grade = bench.grade();
  EXPECT_EQ(value_of(grade.metrics, "objects_done_share"), 0.0);
  EXPECT_FALSE(value_of(grade.metrics, "object_grip_window_share").has_value());
  EXPECT_FALSE(grade.passed);
  EXPECT_EQ(grade.score.value(), 0);
  const Cap* undone = cap_of(grade, CapKind::kUnfinished);
  ASSERT_TRUE(undone);
  EXPECT_EQ(cap_sentence(*undone), "not finished: 0 of 6: at most 0");
}

TEST(GraspCheats, PlacingTheEasyOnesAndLosingTheRestIsUnfinished) {
  for (int placed = 1; placed < 6; ++placed) {
    GraspBench bench;
    for (int i = 0; i < placed; ++i) bench.place(i);
    for (int i = placed; i < 6; ++i) push(bench, i, Vec3(0.090, 0.070, 0));
    const Grade grade = bench.grade();
    EXPECT_LE(grade.score.value(), 49.0 * placed / 6 + 1e-12) << placed;
    EXPECT_FALSE(grade.passed);
    EXPECT_TRUE(cap_of(grade, CapKind::kCritical));
    const Cap* undone = cap_of(grade, CapKind::kUnfinished);
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->done, placed);
    EXPECT_EQ(undone->total, 6);
  }
}

TEST(GraspCheats, LosingABlockGainsNothingOverLeavingIt) {
  GraspBench left, lost;
  for (GraspBench* bench : {&left, &lost}) {
    for (int i = 0; i < 5; ++i) bench->place(i);
  }
  push(lost, 5, Vec3(-0.080, 0, 0));
  left.feed(150);
  EXPECT_EQ(left.director.outcome(), AttemptStatus::kTimeout);
  EXPECT_LE(lost.grade().score.value(), 49.0 * 5 / 6);
  EXPECT_LE(left.grade().score.value(), 49.0 * 5 / 6);
}

TEST(GraspCheats, APlacedBlockThatIsLostIsNotDone) {
  GraspBench bench;
  bench.place(0);
  bench.block(0).X_TO.p = Vec3(-0.080, 0, bench.half_height());  // at once, as it seems between two frames
  bench.feed(0.1);
  EXPECT_EQ(bench.count("REMOVED"), 1);
  EXPECT_EQ(bench.last("LOST").severity, Severity::kCritical);
  EXPECT_EQ(bench.director.status().targets_done, 0);
  for (int i = 1; i < 6; ++i) bench.place(i);
  EXPECT_EQ(bench.director.status().targets_done, 5);
  EXPECT_LE(bench.grade().score.value(), 49.0 * 5 / 6);
}

/// The events with one more, at its time.
std::vector<Event> with(std::vector<Event> events, const Event& more) {
  const auto after = std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.t_s > more.t_s; });
  events.insert(after, more);
  return events;
}

TEST(GraspCheats, NoErrorEventEverRaisesTheScore) {
  GraspBench bench;
  bench.place(0);
  bench.take(1, 5);  // an imperfect run: too hard, let go on the way, misplaced
  bench.carry(bench.ring(1).centre_T + Vec3(0.006, 0, 0));
  bench.let_go();
  for (int i = 1; i < 6; ++i) bench.place(i);
  const double before = bench.grade().score.value();
  EXPECT_GT(before, 20);
  const double start = bench.last("START").t_s, end = bench.last("DONE").t_s;
  for (const char* type : {"CRUSH", "REGRASP", "SLIP", "DROP", "MISPLACED", "WRONG_BLOCK", "REMOVED", "LOST",
                           "EXCESS_FORCE", "TOOL_COLLISION", "WRONG_PLACE"}) {
    for (const Severity severity : {Severity::kMinor, Severity::kMajor, Severity::kCritical}) {
      for (const double share : {0.0, 0.2, 0.5, 0.8, 0.999}) {
        for (int object = 0; object < 6; ++object) {
          const Event more = made_event(start + share * (end - start), type, object, severity);
          EXPECT_LE(bench.grade(with(bench.director.events(), more)).score.value(), before)
              << type << " of " << object << " at " << share;
        }
      }
    }
  }
}

TEST(GraspCheats, EachCrushRegraspAndExcessLowersAFaultlessScore) {
  GraspBench bench;
  bench.place_all();
  const double t = bench.last("DONE").t_s - 0.01;
  for (const char* type : {"CRUSH", "REGRASP", "EXCESS_FORCE"}) {
    std::vector<Event> events = bench.director.events();
    double before = bench.grade(events).score.value();
    for (int i = 0; i < 2; ++i) {  // the second crush closes the gate: from there on the cap holds
      events = with(events, made_event(t, type, i, Severity::kMinor));
      const double now = bench.grade(events).score.value();
      EXPECT_LT(now, before) << type << " number " << i + 1;
      before = now;
    }
  }
  std::vector<Event> pressed = bench.director.events();
  for (int i = 0; i < 4; ++i) pressed = with(pressed, made_event(t, "EXCESS_FORCE", i, Severity::kMajor));
  EXPECT_FALSE(bench.grade(pressed).passed) << "pressing block and board into each other is no way to place";
}

}  // namespace
}  // namespace trocar::grasp_cheats_test
