// Force, grip and count metrics on step forces.
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::force_metrics_test {
namespace {

ScoringContext context_of_e02() {
  ScoringContext context;
  context.band_low_n = 0.4;
  context.band_high_n = 0.8;
  context.soft_force_n = 0.9;
  context.grip_low_n = 0.73;
  context.grip_high_n = 1.2;
  context.objects_total = 4;
  context.objects_done = 1;
  return context;
}

Trace rest(double seconds) {
  return made_trace(seconds, [](double) { return Vec3::Zero(); });
}

TEST(ForceMetrics, StepForcesGiveTheirMeanPeakAndImpulse) {
  Trace trace = rest(10);
  press(trace, 2, 4, 1.0);
  press(trace, 6, 7, 0.4);
  const auto metrics = compute_metrics(trace, whole_run(10), context_of_e02());
  EXPECT_NEAR(*value_of(metrics, "contact_time_s"), 3, 0.03);
  EXPECT_NEAR(*value_of(metrics, "force_max_n"), 1.0, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "force_mean_n"), 0.8, 0.008);
  EXPECT_NEAR(*value_of(metrics, "force_rms_n"), std::sqrt((2 * 1.0 + 0.16) / 3), 0.01);
  EXPECT_NEAR(*value_of(metrics, "force_sd_n"), std::sqrt(0.72 - 0.64), 0.01);
  EXPECT_NEAR(*value_of(metrics, "impulse_ns"), 2.4, 0.024);
  EXPECT_NEAR(*value_of(metrics, "impulse_max_ns"), 2.0, 0.02);
  EXPECT_NEAR(*value_of(metrics, "soft_force_share"), 2.0 / 3, 0.01);
  EXPECT_NEAR(*value_of(metrics, "soft_impulse_ns"), 2 * (1.0 - context_of_e02().soft_force_n), 0.01);
  EXPECT_NEAR(*value_of(metrics, "pressed_impulse_ns"), 2.0, 0.02) << "the 0.4 N stay under the limit";
}

TEST(ForceMetrics, VirtualCommandedAndDeliveredForceAreToldApart) {
  Trace trace = rest(10);
  press(trace, 2, 4, 1.0);
  for (TraceSample& sample : trace.samples) {
    sample.commanded_n = 0.6 * sample.force_T.norm();
    sample.rendered_n = 0.5 * sample.force_T.norm();
  }
  ScoringContext context = context_of_e02();
  context.room_share = 0.97;
  const auto metrics = compute_metrics(trace, whole_run(10), context);
  EXPECT_NEAR(*value_of(metrics, "force_max_n"), 1.0, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "commanded_max_n"), 0.6, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "commanded_mean_n"), 0.6, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "delivered_max_n"), 0.5, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "delivered_mean_n"), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "room_share"), 0.97);
  trace.samples[trace.samples.size() * 3 / 10].commanded_n = std::nan("");  // as an older recording decodes
  EXPECT_FALSE(value_of(compute_metrics(trace, whole_run(10), context), "commanded_max_n"));
  EXPECT_TRUE(value_of(compute_metrics(trace, whole_run(10), context), "delivered_max_n"));
}

TEST(ForceMetrics, ClutchesAreCounted) {
  auto events = whole_run(10);
  for (const double t : {2.0, 5.0}) {
    Event clutch;
    clutch.t_s = t;
    clutch.type = "CLUTCH";
    events.insert(events.end() - 1, clutch);
  }
  EXPECT_EQ(*value_of(compute_metrics(rest(10), events, context_of_e02()), "clutches"), 2);
}

TEST(ForceMetrics, SwingingForceHasItsSteepestRate) {
  Trace trace = rest(4);
  for (TraceSample& sample : trace.samples) {
    sample.force_T = Vec3(0, 0, 1 - 0.5 * std::cos(2 * M_PI * sample.t_s));
    sample.contact = true;
  }
  EXPECT_NEAR(*value_of(compute_metrics(trace, whole_run(4), {}), "force_rate_max_n_per_s"), M_PI, 0.01 * M_PI);
}

TEST(ForceMetrics, VolumeOfAnEllipsoidOfForces) {
  Trace trace = rest(6.283);
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    const double a = 0.7 * static_cast<double>(i), b = 1.9 * static_cast<double>(i), c = 2.3 * static_cast<double>(i);
    trace.samples[i].force_T = std::sqrt(2.0) * Vec3(0.3 * std::sin(a), 0.2 * std::sin(b), 0.1 * std::sin(c));
    trace.samples[i].contact = true;
  }
  const double expected = 4.0 / 3 * M_PI * 0.3 * 0.2 * 0.1;
  EXPECT_NEAR(*value_of(compute_metrics(trace, whole_run(6.283), {}), "force_volume_n3"), expected, 0.02 * expected);
}

TEST(ForceMetrics, AreUndefinedWithoutContact) {
  const auto metrics = compute_metrics(rest(3), whole_run(3), context_of_e02());
  for (const char* name :
       {"force_max_n", "force_mean_n", "force_rms_n", "impulse_ns", "force_volume_n3", "force_rate_max_n_per_s",
        "in_band_share", "grip_max_n", "grip_in_band_share", "regrasps", "saturated_contact_share",
        "passivity_active_share", "soft_force_share", "soft_impulse_ns", "pressed_impulse_ns"})
    EXPECT_FALSE(value_of(metrics, name)) << name;
  EXPECT_DOUBLE_EQ(*value_of(metrics, "contact_time_s"), 0);
}

TEST(InBandShare, ForgivesTheRiseButNotTheOvershoot) {
  Trace trace = rest(5);
  press(trace, 1.0, 1.4, 0.2);  // rising: below the band, within the grace
  press(trace, 1.4, 2.4, 0.6);
  const auto events = whole_run(5, {made_event(1, "TARGET_TOUCHED", 0), made_event(2.4, "TARGET_HELD", 0)});
  EXPECT_NEAR(*value_of(compute_metrics(trace, events, context_of_e02()), "in_band_share"), 1, 0.002);
  press(trace, 1.4, 1.8, 1.2);  // now it shoots through the band first
  EXPECT_NEAR(*value_of(compute_metrics(trace, events, context_of_e02()), "in_band_share"), 0.6, 0.002);
}

TEST(InBandShare, CountsDawdlingBelowTheBandAfterHalfASecond) {
  Trace trace = rest(6);
  press(trace, 1.0, 2.5, 0.2);
  press(trace, 2.5, 3.5, 0.6);
  const auto events = whole_run(6, {made_event(1, "TARGET_TOUCHED", 0), made_event(3.5, "TARGET_HELD", 0)});
  EXPECT_NEAR(*value_of(compute_metrics(trace, events, context_of_e02()), "in_band_share"), 1.0 / 2.0, 0.002);
}

TEST(InBandShare, CountsLettingGoAsOutsideAndIgnoresTheTimeBetweenTargets) {
  Trace trace = rest(10);
  press(trace, 1.0, 1.5, 0.6);
  press(trace, 2.0, 3.0, 0.6);  // let go for half a second, then held
  press(trace, 7.0, 8.0, 0.6);
  const auto events = whole_run(10, {made_event(1, "TARGET_TOUCHED", 0), made_event(3, "TARGET_HELD", 0),
                                     made_event(7, "TARGET_TOUCHED", 1), made_event(8, "TARGET_HELD", 1)});
  EXPECT_NEAR(*value_of(compute_metrics(trace, events, context_of_e02()), "in_band_share"), 2.5 / 3, 0.002);
}

TEST(InBandShare, RunsToTheEndWhenATargetIsNeverHeld) {
  Trace trace = rest(5);
  press(trace, 1, 2, 0.6);
  const auto events = whole_run(5, {made_event(1, "TARGET_TOUCHED", 0)});
  EXPECT_NEAR(*value_of(compute_metrics(trace, events, context_of_e02()), "in_band_share"), 0.25, 0.002);
}

TEST(GripMetrics, MeasureTheSqueeze) {
  Trace trace = rest(6);
  for (TraceSample& sample : trace.samples) {
    if (sample.t_s >= 1 && sample.t_s < 2) sample.grip_n = 2.0;
    if (sample.t_s >= 3 && sample.t_s < 4) sample.grip_n = 1.0;
  }
  const auto events = whole_run(6, {made_event(1, "GRIP_TOUCHED", 12), made_event(4, "GRIP_HELD", 12)});
  const auto metrics = compute_metrics(trace, events, context_of_e02());
  EXPECT_NEAR(*value_of(metrics, "grip_max_n"), 2, 1e-12);
  EXPECT_NEAR(*value_of(metrics, "grip_mean_n"), 1.5, 0.015);
  EXPECT_NEAR(*value_of(metrics, "grip_in_band_share"), 1.0 / 3, 0.003);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "regrasps"), 1);
}

TEST(CountMetrics, CountEventsOfTheGradedWindow) {
  const auto events = whole_run(
      9, {made_event(1, "WRONG_PLACE", 0), made_event(2, "EXCESS_FORCE", 0, Severity::kMajor),
          made_event(2, "CRITICAL_FORCE", 0, Severity::kCritical), made_event(3, "TARGET_HELD", 0),
          made_event(4, "TARGET_HELD", 0), made_event(5, "GRIP_EXCESS", 1), made_event(6, "TOOL_COLLISION", 1)});
  const auto metrics = compute_metrics(rest(9), events, context_of_e02());
  EXPECT_DOUBLE_EQ(*value_of(metrics, "wrong_places"), 1);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "excess_events"), 2);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "critical_events"), 1);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "targets_held"), 1) << "the same target twice is one";
  EXPECT_DOUBLE_EQ(*value_of(metrics, "tool_collisions"), 1);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "objects_done_share"), 0.25);
}

TEST(HonestyMetrics, ShareOfContactTicks) {
  Trace trace = rest(4);
  press(trace, 1, 3, 0.6);
  for (TraceSample& sample : trace.samples) {
    sample.saturated = sample.t_s >= 2.5;  // a quarter of the contact, and some free motion
    sample.passivity_active = sample.t_s < 2;
  }
  const auto metrics = compute_metrics(trace, whole_run(4), context_of_e02());
  EXPECT_NEAR(*value_of(metrics, "saturated_contact_share"), 0.25, 0.002);
  EXPECT_NEAR(*value_of(metrics, "passivity_active_share"), 0.5, 0.002);
}

}  // namespace
}  // namespace trocar::force_metrics_test
