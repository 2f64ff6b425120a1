// Motion metrics on analytic traces (1 %), and the table itself.
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::motion_metrics_test {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

std::vector<Metric> metrics_of(const Trace& trace, const ScoringContext& context = {}) {
  return compute_metrics(trace, whole_run(trace.samples.back().t_s), context);
}

double minimum_jerk_shape(double s) { return s <= 0 ? 0 : s >= 1 ? 1 : s * s * s * (10 + s * (-15 + 6 * s)); }

TEST(MotionMetrics, LineHasItsLength) {
  const auto metrics = metrics_of(made_trace(4, [](double t) { return Vec3(0.03 * t, -0.04 * t, 0); }));
  EXPECT_NEAR(*value_of(metrics, "path_m"), 0.2, 0.002);
  EXPECT_NEAR(*value_of(metrics, "path_x_m"), 0.12, 0.0012);
  EXPECT_NEAR(*value_of(metrics, "path_y_m"), 0.16, 0.0016);
  EXPECT_NEAR(*value_of(metrics, "path_z_m"), 0, 1e-9);
  EXPECT_NEAR(*value_of(metrics, "speed_mean_mps"), 0.05, 0.0005);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "time_s"), 4);
}

TEST(MotionMetrics, CircleHasItsCircumference) {
  const auto metrics = metrics_of(
      made_trace(8, [](double t) { return Vec3(0.03 * std::cos(kTau * t / 4), 0.03 * std::sin(kTau * t / 4), 0); }));
  EXPECT_NEAR(*value_of(metrics, "path_m"), 2 * kTau * 0.03, 0.01 * 2 * kTau * 0.03);
  EXPECT_NEAR(*value_of(metrics, "depth_path_m"), 0, 1e-9);
}

TEST(MotionMetrics, HelixHasItsLengthAndItsDepth) {
  const auto metrics = metrics_of(made_trace(
      8, [](double t) { return Vec3(0.02 * std::cos(kTau * t / 4), 0.02 * std::sin(kTau * t / 4), 0.01 * t); }));
  const double length = 8 * std::hypot(kTau * 0.02 / 4, 0.01);
  EXPECT_NEAR(*value_of(metrics, "path_m"), length, 0.01 * length);
  EXPECT_NEAR(*value_of(metrics, "depth_path_m"), 0.08, 0.0008) << "the shaft points along -z";
}

TEST(MotionMetrics, AngularPathFollowsTheShaft) {
  Trace trace = made_trace(3, [](double) { return Vec3::Zero(); });
  for (TraceSample& sample : trace.samples) {
    const double angle = 20 * std::numbers::pi / 180 * std::sin(kTau * sample.t_s / 3);
    sample.shaft_T = Vec3(std::sin(angle), 0, -std::cos(angle));
  }
  EXPECT_NEAR(*value_of(metrics_of(trace), "angular_path_deg"), 80, 0.8);
}

TEST(MotionMetrics, TremorOfKnownSizeIsFound) {
  const auto metrics = metrics_of(made_trace(10, [](double t) {
    return Vec3(0.02 * std::sin(kTau * 0.2 * t), 0.1e-3 * std::sqrt(2.0) * std::sin(kTau * 9.3 * t), 0);
  }));
  EXPECT_NEAR(*value_of(metrics, "tremor_rms_m"), 0.1e-3, 1e-6);
  EXPECT_GT(*value_of(metrics, "tremor_share"), 0.01);
}

TEST(MotionMetrics, CountsMovementsPeaksAndRest) {
  // Two reaches of 1 s with 2 s of rest between.
  const auto metrics = metrics_of(
      made_trace(4, [](double t) { return Vec3(0.05 * (minimum_jerk_shape(t) + minimum_jerk_shape(t - 3)), 0, 0); }));
  EXPECT_DOUBLE_EQ(*value_of(metrics, "movements"), 2);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "speed_peaks"), 2);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "speed_peak_rate_hz"), 0.5);
  EXPECT_NEAR(*value_of(metrics, "idle_share"), 0.5, 0.07) << "2 s of rest and the slow ends of the reaches";
  EXPECT_NEAR(*value_of(metrics, "speed_max_mps"), 1.875 * 0.05, 0.01 * 1.875 * 0.05);
  EXPECT_GT(*value_of(metrics, "sparc"), -1.7);
}

TEST(MotionMetrics, SmoothnessIsUndefinedWithoutMovement) {
  const auto metrics = metrics_of(made_trace(3, [](double) { return Vec3(1, 2, 3); }));
  EXPECT_DOUBLE_EQ(*value_of(metrics, "movements"), 0);
  EXPECT_FALSE(value_of(metrics, "sparc"));
  EXPECT_FALSE(value_of(metrics, "ldlj"));
  EXPECT_FALSE(value_of(metrics, "normalised_jerk"));
  EXPECT_FALSE(value_of(metrics, "economy"));
  EXPECT_NEAR(*value_of(metrics, "idle_share"), 1, 1e-9);
}

TEST(MotionMetrics, IdealPathWithdrawsBetweenTargets) {
  ScoringContext context;
  context.retract_height_m = 0.010;
  context.waypoints = {Vec3(0, 0, 0.050), Vec3(0, 0, 0), Vec3(0.030, 0, 0)};
  // down 40 to the retract point and 10 to the disc; up 10, across 30, down 10.
  EXPECT_NEAR(ideal_path_length(context), 0.040 + 0.010 + 0.010 + 0.030 + 0.010, 1e-12);
  context.waypoints.resize(1);
  EXPECT_EQ(ideal_path_length(context), 0);
}

TEST(MotionMetrics, EconomyOfTheIdealPathIsOne) {
  ScoringContext context;
  context.retract_height_m = 0.010;
  context.waypoints = {Vec3(0, 0, 0.060), Vec3(0, 0, 0)};
  const auto metrics =
      metrics_of(made_trace(3, [](double t) { return Vec3(0, 0, 0.060 * (1 - minimum_jerk_shape(t / 3))); }), context);
  EXPECT_NEAR(*value_of(metrics, "economy"), 1, 0.01);
  EXPECT_NEAR(*value_of(metrics, "path_ratio"), 1, 0.01);
  EXPECT_NEAR(*value_of(metrics, "ideal_path_m"), 0.060, 1e-12);
}

TEST(MotionMetrics, ChangeLittleWithTheRateOfTheTrace) {
  const auto position = [](double t) {
    return Vec3(0.03 * std::cos(kTau * t / 3), 0.02 * std::sin(kTau * t / 2), 0.01 * std::sin(kTau * t / 4));
  };
  const auto fine = metrics_of(made_trace(12, position)), coarse = metrics_of(made_trace(12, position, 200));
  for (const char* name : {"path_m", "depth_path_m", "speed_mean_mps", "speed_max_mps", "sparc", "time_s"})
    EXPECT_NEAR(*value_of(coarse, name) / *value_of(fine, name), 1, 0.02) << name;
}

TEST(MotionMetrics, SeeOnlyTheGradedWindow) {
  Trace trace = made_trace(6, [](double t) { return Vec3(0.05 * t, 0, 0); });
  std::vector<Event> events = {made_event(2, "START"), made_event(5, "DONE")};
  const auto metrics = compute_metrics(trace, events, {});
  EXPECT_DOUBLE_EQ(*value_of(metrics, "time_s"), 3);
  EXPECT_NEAR(*value_of(metrics, "path_m"), 0.15, 0.0015);
  for (TraceSample& sample : trace.samples)
    if (sample.t_s < 2 || sample.t_s > 5) sample.tip_T *= 7;
  const auto same = compute_metrics(trace, events, {});
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    if (metrics[i].name == "rest_tremor_rms_m") continue;  // looks at the second before START, and says so
    EXPECT_EQ(metrics[i].value, same[i].value) << metrics[i].name;
  }
}

TEST(MetricTable, ListsExactlyWhatIsComputed) {
  const auto metrics = metrics_of(made_trace(2, [](double t) { return Vec3(0.01 * t, 0, 0); }));
  ASSERT_EQ(metrics.size(), metric_catalogue().size());
  std::set<std::string> names;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name, metric_catalogue()[i].name);
    EXPECT_EQ(metrics[i].unit, metric_catalogue()[i].unit) << metrics[i].name;
    EXPECT_FALSE(metric_catalogue()[i].meaning.empty());
    EXPECT_TRUE(names.insert(metrics[i].name).second) << "twice: " << metrics[i].name;
  }
  EXPECT_EQ(find_metric("path_m")->unit, "m");
  EXPECT_EQ(find_metric("no_such_metric"), nullptr);
}

TEST(MetricTable, IsEmptyNotZeroWithoutAStart) {
  const auto metrics = compute_metrics(made_trace(2, [](double) { return Vec3::Zero(); }), {}, {});
  EXPECT_FALSE(value_of(metrics, "time_s"));
  EXPECT_FALSE(value_of(metrics, "path_m"));
  EXPECT_FALSE(value_of(metrics, "speed_peaks"));
  EXPECT_FALSE(value_of(metrics, "idle_share"));
}

}  // namespace
}  // namespace trocar::motion_metrics_test
