// An event of force tells how far its excursion went.
#include "scenarios/director/event_peaks.h"

#include "tests/scenarios/support/made_traces.h"

namespace trocar::event_peaks_test {
namespace {

ScoringContext limits() {
  ScoringContext context;
  context.hard_force_n = 1.5;
  context.critical_force_n = 5;
  return context;
}

Event crossing(double t_s, const char* type, double value_n, Severity severity = Severity::kMajor) {
  Event event = made_event(t_s, type, 0, severity);
  event.value = value_n;
  event.unit = "N";
  return event;
}

Trace at_rest(double seconds) {
  return made_trace(seconds, [](double) { return Vec3::Zero(); });
}

TEST(EventPeaks, AnExcursionTellsItsLargestForceAndTheNextOneItsOwn) {
  Trace trace = at_rest(10);
  press(trace, 2, 2.1, 1.6);
  press(trace, 2.1, 2.2, 6.0);
  press(trace, 5, 5.1, 1.7);
  std::vector<Event> events =
      whole_run(10, {crossing(2, "EXCESS_FORCE", 1.51), crossing(2.1, "CRITICAL_FORCE", 5.2, Severity::kCritical),
                     crossing(5, "EXCESS_FORCE", 1.52)});
  raise_to_peaks(events, trace, limits());
  EXPECT_DOUBLE_EQ(events[1].value, 6.0);
  EXPECT_DOUBLE_EQ(events[2].value, 6.0);
  EXPECT_DOUBLE_EQ(events[3].value, 1.7);
  EXPECT_DOUBLE_EQ(events[1].t_s, 2) << "when it was crossed stays";
  EXPECT_EQ(events.size(), 5u);
}

TEST(EventPeaks, TremblingAboveTheLimitIsOneExcursionAndLettingGoEndsIt) {
  Trace trace = at_rest(10);
  press(trace, 2, 2.1, 1.6);
  press(trace, 2.25, 2.3, 2.5);  // 0.15 s of rest: not armed yet
  press(trace, 2.51, 2.6, 4.0);  // 0.21 s: another push, whose own event the director would log
  std::vector<Event> events = {crossing(2, "EXCESS_FORCE", 1.51)};
  raise_to_peaks(events, trace, limits());
  EXPECT_DOUBLE_EQ(events[0].value, 2.5);
}

TEST(EventPeaks, EachFurtherSecondAboveTheLimitHasItsOwnPeak) {
  Trace trace = at_rest(10);
  press(trace, 2, 3, 2.0);
  press(trace, 3, 4, 3.0);
  std::vector<Event> events = {crossing(2, "EXCESS_FORCE", 2.0), crossing(3, "EXCESS_FORCE", 3.0)};
  raise_to_peaks(events, trace, limits());
  EXPECT_DOUBLE_EQ(events[0].value, 2.0);
  EXPECT_DOUBLE_EQ(events[1].value, 3.0);
}

TEST(EventPeaks, AGripTellsItsGripAndOtherEventsKeepTheirNumber) {
  Trace trace = at_rest(10);
  press(trace, 2, 3, 9.0);
  for (TraceSample& sample : trace.samples)
    if (sample.t_s >= 4 && sample.t_s < 4.5) sample.grip_n = sample.t_s < 4.2 ? 2.6 : 3.3;
  std::vector<Event> events = {crossing(2, "TARGET_HELD", 1), crossing(2, "EXCESS_FORCE", 2.2, Severity::kCritical),
                               crossing(4, "GRIP_EXCESS", 2.6)};
  raise_to_peaks(events, trace, limits());
  EXPECT_DOUBLE_EQ(events[0].value, 1);
  EXPECT_DOUBLE_EQ(events[1].value, 2.2) << "a pull, which the trace does not have";
  EXPECT_DOUBLE_EQ(events[2].value, 3.3);
  Trace none;
  raise_to_peaks(events, none, limits());
  EXPECT_DOUBLE_EQ(events[2].value, 3.3);
}

}  // namespace
}  // namespace trocar::event_peaks_test
