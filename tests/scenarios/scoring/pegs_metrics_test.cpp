// What is measured of peg transfer, and that nothing of it is elsewhere.
#include <gtest/gtest.h>

#include "tests/scenarios/support/made_traces.h"

namespace trocar::pegs_metrics_test {
namespace {

ScoringContext pegs() {
  ScoringContext context;
  context.outcome = AttemptStatus::kCompleted;
  context.time_limit_s = 300;
  context.grip_windows.assign(12, {1.2, 3.5});
  context.objects_total = 12;
  return context;
}

std::vector<Metric> metrics_of(const std::vector<Event>& events, const ScoringContext& context) {
  return compute_metrics(made_trace(10, [](double) { return Vec3::Zero(); }), events, context);
}

std::vector<Event> run_with_errors() {
  return whole_run(10, {made_event(1, "TARGET_HELD", 0), made_event(2, "BUMP", 1), made_event(3, "BUMP", 1),
                        made_event(4, "BUMP", 2), made_event(5, "DROP", 2), made_event(6, "GRIP_EXCESS", 3),
                        made_event(7, "LOST", 4, Severity::kCritical)});
}

TEST(PegsMetrics, ADropWeighsTwoBumps) {
  const auto metrics = metrics_of(run_with_errors(), pegs());
  EXPECT_EQ(value_of(metrics, "bumps"), 3);
  EXPECT_EQ(value_of(metrics, "transfer_errors"), 1 + 1.5);
  EXPECT_EQ(value_of(metrics, "grip_marks"), 1);
}

TEST(PegsMetrics, TimeLeftIsLessEachLostRingsShareOfAHundredSeconds) {
  EXPECT_NEAR(value_of(metrics_of(run_with_errors(), pegs()), "time_left_less_lost_s").value(), 290 - 100.0 / 6, 1e-9);
  ScoringContext late = pegs();
  late.outcome = AttemptStatus::kTimeout;
  late.time_limit_s = 10;
  EXPECT_EQ(value_of(metrics_of(run_with_errors(), late), "time_left_less_lost_s"), 0) << "never below";
  ScoringContext left = pegs();
  left.outcome = AttemptStatus::kAborted;
  EXPECT_FALSE(value_of(metrics_of(run_with_errors(), left), "time_left_less_lost_s").has_value());
}

TEST(PegsMetrics, AreEmptyForOtherExercises) {
  ScoringContext other = pegs();
  other.grip_windows.clear();
  const auto metrics = metrics_of(run_with_errors(), other);
  for (const char* name : {"bumps", "transfer_errors", "grip_marks", "time_left_less_lost_s"})
    EXPECT_FALSE(value_of(metrics, name).has_value()) << name;
  const auto blocks = metrics_of(whole_run(10, {made_event(1, "PLACED", 0), made_event(2, "DROP", 1)}), pegs());
  EXPECT_FALSE(value_of(blocks, "transfer_errors").has_value()) << "blocks are placed, no ring is held";
}

}  // namespace
}  // namespace trocar::pegs_metrics_test
