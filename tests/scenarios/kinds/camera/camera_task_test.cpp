// Camera navigation against scripted states: every condition of a held sphere counts, the horizon and the walls are
// watched, what is told of a sphere is of all its time; and what is measured of it.
#include "scenarios/kinds/camera/camera_task.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/director/cue_percept.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/camera/scope_view.h"
#include "scenarios/scoring/metrics.h"

namespace trocar::camera_task_test {
namespace {

constexpr double kDegree = M_PI / 180;

/// Two spheres and a director that is fed one state after the other at 100 Hz; 30 degree scope, level L2.
class CameraTest : public testing::Test {
 protected:
  CameraTest()
      : exercise_(find_exercise("E04", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises")),
        level_(find_level(exercise_, "L2")),
        director_(exercise_, level_, board()) {
    state_.loop = LoopState::kActive;
    state_.X_TI = {board().targets[0].R_TI, board().start_T};
    feed(1.1);
  }

  static Board board() {
    Board board;
    board.start_T = Vec3(0, 0, 0.06);
    for (const double x : {0.03, -0.03}) {
      Target pose;
      pose.centre_T = Vec3(x, 0, 0);
      pose.R_TI = level_instrument(Vec3(-0.5, 0.6, -0.6).normalized());
      board.targets.push_back(pose);
    }
    return board;
  }
  Cup cup(std::size_t index) const {
    return cup_of(board().targets[index], own_rules<CameraRules>(exercise_), own_rules<CameraLevel>(level_));
  }
  /// At the sphere's own pose, moved along and turned about the axes of the picture.
  void look_at(std::size_t index, const Vec3& moved_C = Vec3::Zero(), const Vec3& turned_C = Vec3::Zero()) {
    const Target pose = board().targets[index];
    const Mat3 R_IC = picture_in_instrument(own_rules<CameraLevel>(level_).tilt_rad), R_TC = pose.R_TI * R_IC;
    const double angle = turned_C.norm();
    const Mat3 turn = angle > 0 ? Eigen::AngleAxisd(angle, turned_C / angle).toRotationMatrix() : Mat3::Identity();
    state_.X_TI = {R_TC * turn * R_IC.transpose(), pose.centre_T + R_TC * moved_C};
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
  double last(const std::string& type) const {
    for (auto e = director_.events().rbegin(); e != director_.events().rend(); ++e)
      if (e->type == type) return e->value;
    ADD_FAILURE() << "no event " << type;
    return 0;
  }
  bool held_so(const Vec3& moved_C, const Vec3& turned_C = Vec3::Zero()) {
    look_at(0, moved_C, turned_C);
    feed(1.2);
    return count("TARGET_HELD") == 1;
  }

  Exercise exercise_;
  ExerciseLevel level_;
  Director director_;
  StylusState state_;
};

TEST_F(CameraTest, AsksForAPoseFromWhichEverythingIsRight) {
  Percept percept;
  show_cue(director_.status(), percept);
  EXPECT_EQ(percept.cue, Cue::kOrient);
  EXPECT_TRUE(percept.target_oriented);
  EXPECT_EQ(percept.target_T, board().targets[0].centre_T);
  EXPECT_TRUE(held_so(Vec3::Zero()));
  EXPECT_EQ(director_.status().target_index, 1);
  look_at(1);
  feed(1.1);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
}

TEST_F(CameraTest, ThePoseItAsksForIsGoodAllOverItsTolerance) {
  const Demand& demand = director_.status().demand;
  const double share = 0.7;  // what the least exact hand settles for
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    look_at(0, share * demand.radius_m * axis, share * demand.angle_tolerance_rad * axis);
    feed(0.1);
    EXPECT_EQ(director_.status().message, "Good - hold") << axis.transpose();
  }
}

TEST_F(CameraTest, TheSphereMustBeInTheMiddle) {
  EXPECT_FALSE(held_so(Vec3::Zero(), Vec3(8 * kDegree, 0, 0)));
  EXPECT_EQ(director_.status().message, "Bring the lit sphere into the ring");
  EXPECT_TRUE(held_so(Vec3::Zero(), Vec3(7 * kDegree, 0, 0)));
}

TEST_F(CameraTest, TheDistanceMustBeRight) {
  EXPECT_FALSE(held_so(Vec3(0, 0, 0.016)));
  EXPECT_EQ(director_.status().hint, "It is too near.");
  EXPECT_FALSE(held_so(Vec3(0, 0, -0.016)));
  EXPECT_EQ(director_.status().hint, "It is too far away.");
  EXPECT_TRUE(held_so(Vec3(0, 0, 0.014)));
}

TEST_F(CameraTest, TheWallMustNotHideIt) {
  const double aslant = 20 * kDegree, away = own_rules<CameraRules>(exercise_).drawn_m;
  EXPECT_FALSE(held_so({away * std::sin(aslant), 0, away * (1 - std::cos(aslant))}, Vec3(0, -aslant, 0)));
  EXPECT_EQ(director_.status().message, "Look along the cup");
  EXPECT_LT(director_.status().angle_error_rad, 1 * kDegree);
}

TEST_F(CameraTest, ThePictureMustBeLevel) {
  EXPECT_FALSE(held_so(Vec3::Zero(), Vec3(0, 0, 16 * kDegree)));
  EXPECT_EQ(director_.status().message, "Level the picture");
  EXPECT_NEAR(std::abs(director_.status().horizon_rad), 16 * kDegree, 1e-6);
  EXPECT_TRUE(held_so(Vec3::Zero(), Vec3(0, 0, -14 * kDegree)));
}

TEST_F(CameraTest, TheHorizonIsLostAfterTwoSecondsAndAgainAfterTwoMore) {
  look_at(0, Vec3::Zero(), Vec3(0, 0, 30 * kDegree));
  feed(1.9);
  EXPECT_EQ(count("HORIZON_LOST"), 0);
  feed(0.2);
  EXPECT_EQ(count("HORIZON_LOST"), 1);
  feed(2);
  EXPECT_EQ(count("HORIZON_LOST"), 2);
}

TEST_F(CameraTest, DwellingDoesNotBuyBackARolledPicture) {
  look_at(0, Vec3(0, 0, -0.03));
  feed(8);  // level, too far away
  look_at(0, Vec3::Zero(), Vec3(0, 0, 30 * kDegree));
  feed(4);
  look_at(0);
  feed(1.1);
  ASSERT_EQ(count("TARGET_HELD"), 1);
  EXPECT_NEAR(last("HORIZON_KEPT"), 0.5, 0.01) << "4 of the 9 s level, 4 s rolled";
}

TEST_F(CameraTest, ASphereNotFoundInTimeComesBackWithItsAccount) {
  look_at(0, Vec3::Zero(), Vec3(0, 0, 30 * kDegree));
  feed(15.1);
  EXPECT_EQ(count("TARGET_TIMEOUT"), 1);
  EXPECT_EQ(director_.status().target_index, 1);
  EXPECT_LT(last("HORIZON_KEPT"), 0.1);
  look_at(1);
  feed(1.1);
  EXPECT_EQ(director_.status().target_index, 0);
  look_at(0);
  feed(1.1);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  EXPECT_LT(last("HORIZON_KEPT"), 0.15) << "what it was lit for before counts, too";
}

TEST_F(CameraTest, ALensAtAWallIsTold) {
  const Cup beside = cup(1);
  state_.X_TI.p =
      beside.rim_T() + (beside.bore_m / 2 + 0.0005) * beside.axis_T.unitOrthogonal() + 0.002 * beside.axis_T;
  feed(0.3);
  EXPECT_EQ(count("WALL_CONTACT"), 1);
  EXPECT_TRUE(director_.status().warning);
  feed(0.9);
  EXPECT_EQ(count("WALL_CONTACT"), 2) << "staying there does not make it cheaper";
  look_at(0);
  feed(0.5);
  state_.contact = true;  // the plate
  feed(0.1);
  EXPECT_EQ(count("WALL_CONTACT"), 3);
}

TEST_F(CameraTest, TheClutchHoldsNothing) {
  look_at(0);
  state_.clutched = true;
  feed(3);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  state_.clutched = false;
  feed(1.1);
  EXPECT_EQ(count("TARGET_HELD"), 1);
}

TEST(ScopeView, LooksAlongTheShaftOrBelowItAndKnowsUp) {
  const Mat3 R_TI = level_instrument(Vec3(0, std::cos(0.6), -std::sin(0.6)));
  const Mat3 straight = R_TI * picture_in_instrument(0), tilted = R_TI * picture_in_instrument(30 * kDegree);
  EXPECT_TRUE(straight.col(2).isApprox(R_TI.col(2)));
  EXPECT_NEAR(std::asin(-tilted(2, 2)), 0.6 + 30 * kDegree, 1e-12) << "the tip looks below the shaft";
  EXPECT_NEAR(horizon_of(straight).value(), 0, 1e-12);
  EXPECT_NEAR(horizon_of(straight * Eigen::AngleAxisd(0.3, Vec3::UnitZ())).value(), -0.3, 1e-12)
      << "a scope rolled to the right has up on its left";
  EXPECT_FALSE(horizon_of(Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix()).has_value());
}

TEST(ViewMotion, CountsMovesAndNoTremor) {
  const auto peaks = [](double moves, double tremor_rad) {
    ViewMotion motion;
    int n = 0;
    for (double t = 0; t < 4; t += 0.01) {
      const double angle = 0.2 * (1 - std::cos(M_PI * moves * t / 2)) + tremor_rad * std::sin(2 * M_PI * 9 * t);
      n += motion.update(Vec3(std::sin(angle), 0, std::cos(angle)), 0.01) ? 1 : 0;
    }
    return n;
  };
  EXPECT_EQ(peaks(1, 0), 2) << "there and back";
  EXPECT_EQ(peaks(3, 0), 6);
  EXPECT_EQ(peaks(1, 0.001), 2);
}

Event told(double t_s, const char* type, std::int32_t object, double value = 0) {
  Event e;
  e.t_s = t_s;
  e.type = type;
  e.object = object;
  e.value = value;
  return e;
}

std::optional<double> metric_of(const std::vector<Event>& events, const std::string& name) {
  ScoringContext context;
  context.objects_done = 2;
  Trace trace;
  trace.samples.resize(2);
  trace.samples.back().t_s = 12;
  std::vector<Metric> metrics;
  add_camera_metrics(trace, events, context, metrics);
  for (const Metric& metric : metrics)
    if (metric.name == name) return metric.value;
  ADD_FAILURE() << name;
  return std::nullopt;
}

TEST(CameraMetrics, TakeWhatWasLastToldOfEachSphere) {
  const std::vector<Event> events{told(1, "HORIZON_KEPT", 0, 0.2), told(2, "HORIZON_KEPT", 1, 1),
                                  told(3, "HORIZON_KEPT", 0, 0.5), told(3, "VIEW_JERKS", 0, 4),
                                  told(3, "VIEW_JERKS", 1, 1),     told(4, "WALL_CONTACT", 0)};
  EXPECT_DOUBLE_EQ(metric_of(events, "horizon_share").value(), 0.75);
  EXPECT_DOUBLE_EQ(metric_of(events, "view_jerks").value(), 2.5);
  EXPECT_DOUBLE_EQ(metric_of(events, "wall_contacts").value(), 1);
  EXPECT_DOUBLE_EQ(metric_of(events, "horizon_losses").value(), 0);
  EXPECT_DOUBLE_EQ(metric_of(events, "time_per_target_s").value(), 6);
}

TEST(CameraMetrics, AreEmptyInOtherExercises) {
  for (const char* name : {"time_per_target_s", "horizon_share", "horizon_losses", "wall_contacts", "view_jerks"})
    EXPECT_FALSE(metric_of({told(1, "TARGET_HELD", 0), told(2, "WALL_CONTACT", 0)}, name).has_value()) << name;
}

}  // namespace
}  // namespace trocar::camera_task_test
