// What is measured of ring on wire: touching gate by gate, touches, the ring's angle; nothing of it elsewhere.
#include <gtest/gtest.h>

#include "tests/scenarios/support/made_traces.h"

namespace trocar::wire_metrics_test {
namespace {

ScoringContext wire() {
  ScoringContext context;
  context.outcome = AttemptStatus::kCompleted;
  context.ring_on_wire = true;
  context.counted_hold_s = 1;
  context.objects_total = 2;
  return context;
}

Trace touching(double seconds, double from, double to) {
  Trace trace = made_trace(seconds, [](double) { return Vec3::Zero(); });
  for (TraceSample& sample : trace.samples) sample.contact = sample.t_s > from && sample.t_s <= to;
  return trace;
}

std::vector<Event> two_gates(double seconds, double second_lit) {
  return whole_run(seconds, {made_event(0, "TARGET_LIT", 0), made_event(second_lit, "TARGET_HELD", 0),
                             made_event(second_lit, "TARGET_LIT", 1)});
}

TEST(WireTouchShare, IsTheTouchingAtEachGateOverAnUnhurriedWay) {
  const auto metrics = compute_metrics(touching(4, 1, 1.4), two_gates(4, 2), wire());
  EXPECT_NEAR(value_of(metrics, "wire_touch_share").value(), 0.2, 1e-3) << "0.4 s at one of two gates";
}

TEST(WireTouchShare, NoGateCountsForMoreThanOne) {
  const auto metrics = compute_metrics(touching(9, 1, 8), two_gates(9, 8), wire());
  EXPECT_NEAR(value_of(metrics, "wire_touch_share").value(), 0.5, 1e-3);
}

TEST(WireTouchShare, StayingWithoutTouchingBuysNothingBack) {
  const auto brief = compute_metrics(touching(4, 1, 1.4), two_gates(4, 2), wire());
  const auto dwelt = compute_metrics(touching(60, 1, 1.4), two_gates(60, 50), wire());
  EXPECT_NEAR(value_of(brief, "wire_touch_share").value(), value_of(dwelt, "wire_touch_share").value(), 1e-3);
}

TEST(WireMetrics, CountTouchesAndTakeTheMeanAngle) {
  auto events =
      whole_run(10, {made_event(1, "TARGET_LIT", 0), made_event(2, "WIRE_TOUCHED", 0), made_event(3, "WIRE_TOUCHED", 0),
                     made_event(4, "ANGLE_ERROR", 0), made_event(5, "ANGLE_ERROR", 1)});
  for (Event& event : events)
    if (event.type == "ANGLE_ERROR") event.value = event.object == 0 ? 0.1 : 0.3;
  const auto metrics = compute_metrics(touching(10, 0, 0), events, wire());
  EXPECT_EQ(value_of(metrics, "wire_touches"), 2);
  EXPECT_NEAR(value_of(metrics, "touches_times_time_s").value(), 20, 0.01);
  EXPECT_NEAR(value_of(metrics, "ring_angle_deg").value(), 0.2 * 180 / M_PI, 1e-9);
  EXPECT_FALSE(value_of(metrics, "angle_error_deg").has_value()) << "that is of pens";
}

TEST(WireMetrics, AreEmptyForOtherExercises) {
  ScoringContext other = wire();
  other.ring_on_wire = false;
  const auto metrics = compute_metrics(touching(4, 1, 2), two_gates(4, 2), other);
  for (const char* name : {"wire_touch_share", "wire_touches", "ring_angle_deg", "touches_times_time_s"})
    EXPECT_FALSE(value_of(metrics, name).has_value()) << name;
}

}  // namespace
}  // namespace trocar::wire_metrics_test
