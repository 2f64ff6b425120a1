// What is measured of a limited grasp: share of the carry with the wanted grip, and the counts of what went wrong.
#include <gtest/gtest.h>

#include "tests/scenarios/support/grasp_bench.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::grasp_metrics_test {
namespace {

/// Two blocks: wanted 0.6 to 1.2 N and 1.0 to 1.9 N.
ScoringContext two_blocks() {
  ScoringContext context;
  context.outcome = AttemptStatus::kCompleted;
  context.grip_windows = {{0.6, 1.2}, {1.0, 1.9}};
  context.objects_total = 2;
  return context;
}

Trace still(double seconds) {
  return made_trace(seconds, [](double) { return Vec3::Zero(); });
}

void squeeze(Trace& trace, double from, double to, double grip_n) {
  for (TraceSample& sample : trace.samples)
    if (sample.t_s > from && sample.t_s <= to) sample.grip_n = grip_n;
}

std::optional<double> share(const Trace& trace, const std::vector<Event>& events,
                            const ScoringContext& context = two_blocks()) {
  return value_of(compute_metrics(trace, events, context), "grip_window_share");
}

TEST(GripWindowShare, IsTheTimeInTheWindowOfTheCarry) {
  Trace trace = still(10);
  squeeze(trace, 0, 10, 5);
  squeeze(trace, 2, 5, 0.9);
  const auto events = whole_run(10, {made_event(2, "LIFTED", 0), made_event(6, "SET_DOWN", 0)});
  EXPECT_NEAR(share(trace, events).value(), 0.75, 1e-3) << "5 N before and after the carry do not count";
}

TEST(GripWindowShare, TooLightAndTooHardCountAlike) {
  for (const double grip : {0.59, 1.21}) {
    Trace trace = still(6);
    squeeze(trace, 1, 3, 1.2);
    squeeze(trace, 3, 5, grip);
    const auto events = whole_run(6, {made_event(1, "LIFTED", 0), made_event(5, "SET_DOWN", 0)});
    EXPECT_NEAR(share(trace, events).value(), 0.5, 1e-3) << grip;
  }
}

TEST(GripWindowShare, EachBlockHasItsOwnWindow) {
  Trace trace = still(10);
  squeeze(trace, 0, 10, 1.5);
  const auto events = whole_run(10, {made_event(1, "LIFTED", 0), made_event(2, "SET_DOWN", 0),
                                     made_event(5, "LIFTED", 1), made_event(8, "SET_DOWN", 1)});
  EXPECT_NEAR(share(trace, events).value(), 0.75, 1e-3) << "three of four seconds, not the mean of two shares";
}

TEST(GripWindowShare, ACarryLastsUntilTheSameBlockIsSetDown) {
  Trace trace = still(10);
  squeeze(trace, 0, 4, 0.9);
  const auto events =
      whole_run(10, {made_event(0, "LIFTED", 0), made_event(2, "SET_DOWN", 1), made_event(8, "SET_DOWN", 0)});
  EXPECT_NEAR(share(trace, events).value(), 0.5, 1e-3);
}

TEST(GripWindowShare, ACarryAtTheEndCountsUntilTheEnd) {
  Trace trace = still(10);
  squeeze(trace, 5, 10, 0.9);
  EXPECT_NEAR(share(trace, whole_run(10, {made_event(0.01, "LIFTED", 0)})).value(), 0.5, 1e-2);
}

TEST(GripWindowShare, IsEmptyWithoutACarryAndWithoutBlocks) {
  const Trace trace = still(5);
  EXPECT_FALSE(share(trace, whole_run(5, {made_event(1, "GRASPED", 0)})).has_value());
  EXPECT_FALSE(share(trace, whole_run(5, {made_event(1, "LIFTED", 7)})).has_value()) << "no such block";
  EXPECT_FALSE(share(trace, whole_run(5, {made_event(1, "LIFTED", 0)}), ScoringContext{}).has_value());
}

struct Counted {
  const char* metric;
  const char* event;
};

TEST(GraspCounts, CountTheirOwnEventsWithinTheRun) {
  const Counted all[] = {{"crushed", "CRUSH"},
                         {"block_regrasps", "REGRASP"},
                         {"slips", "SLIP"},
                         {"drops", "DROP"},
                         {"misplaced", "MISPLACED"}};
  const Trace trace = still(5);
  for (const Counted& counted : all) {
    auto events = whole_run(
        5, {made_event(1, counted.event, 0), made_event(2, counted.event, 1), made_event(3, counted.event, 1)});
    events.push_back(made_event(5.5, counted.event, 0));
    const auto metrics = compute_metrics(trace, events, two_blocks());
    for (const Counted& other : all)
      EXPECT_EQ(value_of(metrics, other.metric), other.metric == counted.metric ? 3.0 : 0.0)
          << other.metric << " with three " << counted.event << " in time and one late";
  }
}

TEST(GraspCounts, AreEmptyWhereThereAreNoBlocks) {
  const auto metrics = compute_metrics(still(5), whole_run(5), ScoringContext{});
  for (const char* name : {"crushed", "block_regrasps", "slips", "drops", "misplaced"})
    EXPECT_FALSE(value_of(metrics, name).has_value()) << name;
}

TEST(GraspCounts, AFaultlessRunEarnsAllButTime) {
  GraspBench bench;
  bench.place_all();
  const Grade grade = bench.grade();
  EXPECT_EQ(value_of(grade.metrics, "objects_done_share"), 1.0);
  EXPECT_EQ(value_of(grade.metrics, "grip_window_share"), 1.0);
  EXPECT_EQ(value_of(grade.metrics, "crushed"), 0.0);
  EXPECT_EQ(value_of(grade.metrics, "block_regrasps"), 0.0);
  ASSERT_TRUE(grade.score.has_value());
  EXPECT_GE(*grade.score, 85);
  EXPECT_TRUE(grade.passed);
  EXPECT_TRUE(grade.caps.empty());
}

TEST(GraspCounts, ThreeCrushedBlocksCapTheScore) {
  GraspBench bench;
  for (int i = 0; i < 6; ++i) {
    bench.take(i);
    bench.block(i).crushed = i < 3;
    bench.carry(bench.ring(i).centre_T);
    bench.let_go();
  }
  const Grade grade = bench.grade();
  EXPECT_EQ(value_of(grade.metrics, "crushed"), 3.0);
  EXPECT_EQ(value_of(grade.metrics, "critical_events"), 1.0);
  EXPECT_LE(grade.score.value(), 49);
  EXPECT_FALSE(grade.passed);
}

}  // namespace
}  // namespace trocar::grasp_metrics_test
