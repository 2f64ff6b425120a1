// Reach and orient against scripted states: place and turn both count, holds, time-outs that come back, what is
// measured.
#include "scenarios/kinds/reach/pose_task.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/director/cue_percept.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"

namespace trocar::pose_task_test {
namespace {

constexpr double kDegree = M_PI / 180;

Mat3 turned(double degrees, const Vec3& axis = Vec3::UnitX()) {
  return Eigen::AngleAxisd(degrees * kDegree, axis).toRotationMatrix();
}

/// Two pens and a director that is fed one state after the other at 100 Hz.
class PoseTest : public testing::Test {
 protected:
  PoseTest()
      : exercise_(find_exercise("E01", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises")),
        director_(exercise_, exercise_.levels[0], board()) {
    state_.loop = LoopState::kActive;
    place(board().start_T, Mat3::Identity());
    feed(1.1);
  }

  static Board board() {
    Board board;
    board.start_T = Vec3(0, 0, 0.03);
    board.targets.push_back({Vec3(0.02, 0, 0), Vec3::UnitZ(), 0.003, {}, turned(10)});
    board.targets.push_back({Vec3(-0.02, 0, 0), Vec3::UnitZ(), 0.003, {}, turned(-10, Vec3::UnitY())});
    return board;
  }
  void place(const Vec3& tip, const Mat3& R) { state_.X_TI = {R, tip}; }
  /// At a pen, off by this much.
  void at_pen(std::size_t index, double off_m = 0, double off_deg = 0) {
    const Target target = board().targets[index];
    place(target.centre_T + Vec3(0, 0, off_m), target.R_TI * turned(off_deg, Vec3::UnitZ()));
  }
  void feed(double seconds) {
    for (int i = 0, n = static_cast<int>(std::lround(seconds * 100)); i < n; ++i) {
      state_.t_s += 0.01;
      director_.update(state_);
    }
  }
  int count(const std::string& type) const {
    return static_cast<int>(std::count_if(director_.events().begin(), director_.events().end(),
                                          [&](const Event& e) { return e.type == type; }));
  }
  double value(const std::string& type) const {
    for (const Event& e : director_.events())
      if (e.type == type) return e.value;
    ADD_FAILURE() << "no event " << type;
    return 0;
  }

  Exercise exercise_;
  Director director_;
  StylusState state_;
};

TEST_F(PoseTest, LightsTheFirstPenWithItsOrientation) {
  EXPECT_EQ(director_.status().phase, Phase::kRun);
  Percept percept;
  show_cue(director_.status(), percept);
  EXPECT_EQ(percept.cue, Cue::kOrient);
  EXPECT_EQ(percept.target_index, 0);
  EXPECT_EQ(percept.target_T, board().targets[0].centre_T);
  EXPECT_TRUE(percept.target_oriented);
  EXPECT_TRUE(percept.target_R_TI.isApprox(turned(10)));
  EXPECT_NEAR(percept.target_angle_rad, 8 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(percept.target_radius_m, 0.003);
  EXPECT_FALSE(director_.status().force_shown) << "there is no force to show";
}

TEST_F(PoseTest, IsDoneWhenAllPensAreHeld) {
  at_pen(0);
  feed(0.8);
  EXPECT_EQ(director_.status().targets_done, 1);
  EXPECT_EQ(director_.status().target_index, 1);
  at_pen(1);
  feed(0.8);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(count("TARGET_HELD"), 2);
  EXPECT_EQ(count("TARGET_LIT"), 2);
}

TEST_F(PoseTest, PlaceAloneIsNotEnough) {
  at_pen(0, 0, 9);
  feed(3);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_EQ(director_.status().message, "Turn the instrument along the pen");
  EXPECT_NEAR(director_.status().angle_error_rad, 9 * kDegree, 1e-9);
}

TEST_F(PoseTest, RollCountsAsMuchAsTheAxis) {
  const Target pen = board().targets[0];
  place(pen.centre_T, pen.R_TI * turned(9, Vec3::UnitX()));
  feed(2);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  place(pen.centre_T, pen.R_TI * turned(7, Vec3::UnitX()));
  feed(0.8);
  EXPECT_EQ(count("TARGET_HELD"), 1);
}

TEST_F(PoseTest, TurnAloneIsNotEnough) {
  at_pen(0, 0.0035);
  feed(3);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_NEAR(director_.status().position_error_m, 0.0035, 1e-12);
}

TEST_F(PoseTest, LeavingForLongStartsTheHoldAgain) {
  at_pen(0);
  feed(0.5);
  EXPECT_GT(director_.status().hold_progress, 0.6);
  at_pen(0, 0.01);
  feed(0.3);
  EXPECT_EQ(director_.status().hold_progress, 0);
  at_pen(0);
  feed(0.6);
  EXPECT_EQ(count("TARGET_HELD"), 0);
}

TEST_F(PoseTest, MeasuresTheErrorsOfTheHold) {
  at_pen(0, 0.002, 3);
  feed(0.8);
  EXPECT_NEAR(value("POSITION_ERROR"), 0.002, 1e-9);
  EXPECT_NEAR(value("ANGLE_ERROR"), 3 * kDegree, 1e-9);
}

TEST_F(PoseTest, APenThatIsNotMatchedInTimeComesBackAtTheEnd) {
  place(Vec3(0, 0, 0.05), Mat3::Identity());
  feed(15.2);
  EXPECT_EQ(count("TARGET_TIMEOUT"), 1);
  EXPECT_EQ(director_.status().target_index, 1);
  EXPECT_EQ(director_.status().timeouts, 1);
  at_pen(1);
  feed(0.8);
  EXPECT_EQ(director_.status().target_index, 0) << "nobody gets past a pen by waiting";
  EXPECT_FALSE(director_.finished());
  at_pen(0);
  feed(0.8);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
}

TEST_F(PoseTest, WaitingOutThePensEndsAtTheLimitWithNothing) {
  place(Vec3(0, 0, 0.05), Mat3::Identity());
  feed(181);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kTimeout);
  EXPECT_EQ(director_.status().targets_done, 0);
  const ScoringContext context =
      scoring_context(exercise_, exercise_.levels[0], board(), director_.events(), director_.outcome());
  EXPECT_EQ(context.objects_total, 2) << "no block to squeeze here";
  EXPECT_EQ(context.objects_done, 0);
}

TEST(RotationBetween, IsTheAngleOfTheWholeTurn) {
  for (const double degrees : {0.0, 1e-4, 1.0, 45.0, 179.0})
    EXPECT_NEAR(rotation_between(turned(20), turned(20) * turned(degrees, Vec3(0.6, 0, 0.8))), degrees * kDegree, 1e-9);
}

Event event(double t_s, const char* type, std::int32_t object, double value = 0) {
  Event e;
  e.t_s = t_s;
  e.type = type;
  e.object = object;
  e.value = value;
  return e;
}

std::optional<double> metric_of(const std::vector<Event>& events, const std::string& name) {
  ScoringContext context;
  context.objects_total = 4;
  std::vector<Metric> metrics;
  add_pose_metrics(events, context, metrics);
  for (const Metric& metric : metrics)
    if (metric.name == name) return metric.value;
  ADD_FAILURE() << name;
  return std::nullopt;
}

TEST(PoseMetrics, CountWhatWasMatchedInTime) {
  const std::vector<Event> events{event(1, "TARGET_HELD", 0), event(2, "TARGET_TIMEOUT", 1), event(3, "TARGET_HELD", 1),
                                  event(4, "TARGET_HELD", 2)};
  EXPECT_DOUBLE_EQ(*metric_of(events, "matched_in_time_share"), 0.5) << "0 and 2 of four; 1 came late";
  EXPECT_DOUBLE_EQ(*metric_of(events, "target_timeouts"), 1);
}

TEST(PoseMetrics, AverageTheErrorsAndHaveNoneWithoutAHold) {
  const std::vector<Event> events{event(1, "POSITION_ERROR", 0, 0.001), event(1, "ANGLE_ERROR", 0, 2 * kDegree),
                                  event(2, "POSITION_ERROR", 1, 0.002), event(2, "ANGLE_ERROR", 1, 4 * kDegree)};
  EXPECT_DOUBLE_EQ(*metric_of(events, "position_error_m"), 0.0015);
  EXPECT_NEAR(*metric_of(events, "angle_error_deg"), 3, 1e-9);
  EXPECT_FALSE(metric_of({}, "position_error_m"));
  EXPECT_FALSE(metric_of({}, "angle_error_deg"));
}

TEST(PoseMetrics, TakeTheTremorOfTheSecondBeforeTheStart) {
  Trace trace;
  for (int i = 0; i < 4000; ++i) {
    TraceSample sample;
    sample.t_s = i * 1e-3;
    const double size = sample.t_s < 2 ? 1e-4 : 5e-3;  // quiet before START, wild after it
    sample.tip_T = Vec3(size * std::sin(2 * M_PI * 10 * sample.t_s), 0, 0);
    trace.samples.push_back(sample);
  }
  std::vector<Metric> metrics;
  add_rest_metric(trace, {event(2, "START", -1)}, metrics);
  ASSERT_TRUE(metrics.at(0).value);
  EXPECT_NEAR(*metrics[0].value, 1e-4 / std::sqrt(2), 0.1e-4) << "the Hann window leaves some per cent";
  metrics.clear();
  add_rest_metric(trace, {}, metrics);
  EXPECT_FALSE(metrics.at(0).value);
}

}  // namespace
}  // namespace trocar::pose_task_test
