// Time in a wanted force by object: what dwelling and the clutch cannot buy.
#include "scenarios/scoring/band_time.h"

#include <gtest/gtest.h>

#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::band_time_test {
namespace {

ScoringContext of_discs() {
  ScoringContext context;
  context.outcome = AttemptStatus::kCompleted;
  context.band_low_n = 0.4;
  context.band_high_n = 0.8;
  context.counted_hold_s = 1;
  return context;
}
ScoringContext of_blocks() {
  ScoringContext context = of_discs();
  context.grip_windows = {{0.6, 1.2}, {0.6, 1.2}};
  context.counted_hold_s = 3;
  return context;
}

Trace pressed(double seconds, const std::vector<std::array<double, 3>>& from_to_force) {
  Trace trace = made_trace(seconds, [](double) { return Vec3::Zero(); });
  for (TraceSample& sample : trace.samples)
    for (const auto& [from, to, force] : from_to_force)
      if (sample.t_s >= from && sample.t_s < to) {
        sample.force_T = Vec3(0, 0, force);
        sample.grip_n = force;
        sample.contact = true;
      }
  return trace;
}

double share(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context) {
  const char* name = context.grip_windows.empty() ? "object_in_band_share" : "object_grip_window_share";
  return value_of(compute_metrics(trace, events, context), name).value_or(-1);
}

TEST(BandTime, IsTheHoldOverTheHoldAndTheTimeOutOfTheBand) {
  const auto events = whole_run(6, {made_event(1, "TARGET_TOUCHED", 0), made_event(3, "TARGET_HELD", 0)});
  EXPECT_NEAR(share(pressed(6, {{1, 2, 1.0}, {2, 3, 0.6}}), events, of_discs()), 0.5, 0.002);
  EXPECT_NEAR(share(pressed(6, {{1, 1.25, 1.0}, {1.25, 3, 0.6}}), events, of_discs()), 1 / 1.25, 0.002)
      << "1.75 s in the band count as the one that is asked for";
}

TEST(BandTime, TheRiseIsFreeForAsLongAsTheExerciseSays) {
  const auto events = whole_run(6, {made_event(1, "TARGET_TOUCHED", 0), made_event(3.2, "TARGET_HELD", 0)});
  const Trace slow = pressed(6, {{1, 2.2, 0.2}, {2.2, 3.2, 0.6}});
  EXPECT_NEAR(share(slow, events, of_discs()), 1 / 1.7, 0.002) << "0.5 s unless the exercise says otherwise";
  ScoringContext context = of_discs();
  context.rise_s = 1.5;
  EXPECT_NEAR(share(slow, events, context), 1, 0.002);
  const Trace lost = pressed(6, {{1, 1.2, 0.6}, {1.2, 2.2, 0.2}, {2.2, 3.2, 0.6}});
  EXPECT_NEAR(share(lost, events, context), 1 / 2.0, 0.002) << "a rise is over once the band is reached";
}

TEST(BandTime, DwellingInTheBandBesideADiscBuysNothingBack) {
  const std::vector<Event> quick = whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(3, "TARGET_HELD", 0)});
  const std::vector<Event> slow = whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(8, "TARGET_HELD", 0)});
  EXPECT_NEAR(share(pressed(9, {{1, 2, 1.0}, {2, 8, 0.6}}), slow, of_discs()),
              share(pressed(9, {{1, 2, 1.0}, {2, 3, 0.6}}), quick, of_discs()), 0.002);
}

TEST(BandTime, OneGoodDiscDoesNotPayForABadOne) {
  const auto events = whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(3, "TARGET_HELD", 0),
                                    made_event(4, "TARGET_TOUCHED", 1), made_event(8, "TARGET_HELD", 1)});
  EXPECT_NEAR(share(pressed(9, {{1, 3, 0.6}, {4, 7, 1.0}, {7, 8, 0.6}}), events, of_discs()), (1 + 0.25) / 2, 0.002);
}

TEST(BandTime, ABlockHeldForAMinuteDoesNotPayForTheOthers) {
  const auto carries = [](double to_s) {
    return whole_run(60, {made_event(1, "LIFTED", 0), made_event(5, "SET_DOWN", 0), made_event(6, "LIFTED", 1),
                          made_event(to_s, "SET_DOWN", 1)});
  };
  const double bad = 1.5;  // N, above the window
  const Trace trace = pressed(60, {{1, 5, bad}, {6, 60, 0.9}});
  EXPECT_NEAR(share(trace, carries(9), of_blocks()), 0.5, 0.002);
  EXPECT_NEAR(share(trace, carries(55), of_blocks()), 0.5, 0.002);
  EXPECT_NEAR(value_of(compute_metrics(trace, carries(55), of_blocks()), "grip_window_share").value(), 49. / 53, 0.002)
      << "as it was: 0.43 before the block was held on to";
}

TEST(BandTime, TheClutchEarnsNothingAndHidesNothing) {
  std::vector<Event> events = whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(2, "CLUTCH", 0),
                                            made_event(4, "INSTRUMENT_FREE", 0), made_event(5, "TARGET_HELD", 0)});
  EXPECT_NEAR(share(pressed(9, {{1, 2, 1.0}, {2, 5, 0.6}}), events, of_discs()), 0.5, 0.002)
      << "of the band the second after the clutch counts";
  EXPECT_NEAR(share(pressed(9, {{1, 4, 1.0}, {4, 5, 0.6}}), events, of_discs()), 0.25, 0.002)
      << "too hard stays too hard under the clutch";
  EXPECT_NEAR(share(pressed(9, {{1, 2, 1.0}, {2, 5, 0.6}}),
                    whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(2, "CLUTCH", 0)}), of_discs()),
              0, 1e-9)
      << "a clutch that is never let go lasts until the end";
}

TEST(BandTime, MoreTimeOutOfTheBandNeverRaisesIt) {
  double before = 1;
  for (double out = 0.1; out < 5; out += 0.1) {
    const auto events = whole_run(9, {made_event(1, "TARGET_TOUCHED", 0), made_event(2 + out, "TARGET_HELD", 0)});
    const double now = share(pressed(9, {{1, 1 + out, 1.0}, {1 + out, 2 + out, 0.6}}), events, of_discs());
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(BandTime, IsEmptyWhereNothingWasJudgedOrNoHoldIsKnown) {
  const auto held = whole_run(5, {made_event(1, "TARGET_TOUCHED", 0), made_event(3, "TARGET_HELD", 0)});
  EXPECT_EQ(share(pressed(5, {}), whole_run(5), of_discs()), -1);
  ScoringContext old = of_discs();
  old.counted_hold_s = 0;
  EXPECT_EQ(share(pressed(5, {{1, 3, 0.6}}), held, old), -1) << "recorded before the time was kept";
}

}  // namespace
}  // namespace trocar::band_time_test
