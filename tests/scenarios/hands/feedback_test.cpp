// When the force bar is shown, what a hand is told, and what the watch on safety notes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scenarios/director/cue_percept.h"
#include "scenarios/director/director.h"
#include "scenarios/director/safety_watch.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::feedback_test {
namespace {

Exercise surface_touch() {
  return load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/surface-touch.toml");
}

/// One disc of 0.4 to 0.8 N and the block after it, under one way of showing the force.
struct TouchRun {
  Exercise exercise = surface_touch();
  Director director;
  StylusState state;

  explicit TouchRun(const std::string& display) : director(exercise, level(exercise, display), board()) {
    state.loop = LoopState::kActive;
    state.X_TI.p = board().start_T;
    state.jaw_opening_m = 0.001;
  }
  static ExerciseLevel level(const Exercise& exercise, const std::string& display) {
    ExerciseLevel level = exercise.levels[0];
    level.force_display = display;
    return level;
  }
  static Board board() {
    Board board;
    board.start_T = Vec3(0, 0, 0.045);
    board.targets.push_back({Vec3(0.02, 0, 0), Vec3::UnitZ(), 0.003, {0.4, 0.8}, Mat3::Identity()});
    return board;
  }
  void feed(double seconds) {
    for (int i = 0; i < std::lround(seconds * 100); ++i) {
      state.t_s += 0.01;
      director.update(state);
    }
  }
  void start() {
    feed(1.2);
    ASSERT_EQ(director.status().phase, Phase::kRun);
  }
  /// On the disc with this force; 0: above it.
  bool shown_at(double force_n) {
    state.X_TI.p = state.contact_point_T = Vec3(0.02, 0, 0);
    state.contact = state.tip_contact = force_n > 0;
    state.F_I_T.force = Vec3(0, 0, force_n);
    feed(0.05);
    return director.status().force_shown;
  }
  bool shown_at_grip(double grip_n) {
    state.grip_force_n = grip_n;
    feed(0.02);
    return director.status().force_shown;
  }
  /// Through the disc to the block between open jaws.
  void reach_block() {
    shown_at(0.6);
    feed(1.2);
    shown_at(0);
    state.jaw_opening_m = 0.030;
    feed(0.1);
    ASSERT_EQ(director.status().cue, Cue::kGrip);
    ASSERT_GT(director.status().grip.stiffness_n_per_m, 0);
  }
};

TEST(ForceShown, AlwaysMeansAtEveryForce) {
  TouchRun run("always");
  EXPECT_TRUE(run.director.status().force_shown);
  run.start();
  for (const double force : {0.0, 0.2, 0.6, 1.0}) EXPECT_TRUE(run.shown_at(force)) << force;
  run.reach_block();
  for (const double grip : {0.0, 0.3, 0.8, 1.1}) EXPECT_TRUE(run.shown_at_grip(grip)) << grip;
}

TEST(ForceShown, BandMeansOnlyOutsideTheLimitsAndInContact) {
  TouchRun run("band");
  EXPECT_FALSE(run.director.status().force_shown) << "nothing is out of its band before the start";
  run.start();
  EXPECT_FALSE(run.shown_at(0)) << "in the air";
  EXPECT_TRUE(run.shown_at(0.39));
  EXPECT_FALSE(run.shown_at(0.4)) << "the limits belong to the band";
  EXPECT_FALSE(run.shown_at(0.8));
  EXPECT_TRUE(run.shown_at(0.81));
}

TEST(ForceShown, BandCountsForTheBlockOnceItIsTouched) {
  TouchRun run("band");
  run.start();
  run.reach_block();
  const GripTask& task = run.exercise.grip;
  EXPECT_FALSE(run.shown_at_grip(0)) << "not touched yet";
  EXPECT_TRUE(run.shown_at_grip(task.low_n - 0.01));
  EXPECT_FALSE(run.shown_at_grip((task.low_n + task.high_n) / 2));
  EXPECT_TRUE(run.shown_at_grip(task.high_n + 0.01));
  EXPECT_TRUE(run.shown_at_grip(0)) << "let go after the touch";
}

TEST(ForceShown, AfterMeansNeverDuringTheRun) {
  TouchRun run("after");
  EXPECT_FALSE(run.director.status().force_shown);
  run.start();
  for (const double force : {0.0, 0.2, 0.6, 1.0, 3.0}) EXPECT_FALSE(run.shown_at(force)) << force;
  EXPECT_NE(run.director.status().cue, Cue::kRelease) << "nor does the cue give away that it is too hard";
  run.reach_block();
  for (const double grip : {0.0, 0.3, 0.8, 2.0}) EXPECT_FALSE(run.shown_at_grip(grip)) << grip;
}

TEST(ForceShown, TheWordsTellOfTheForceOnlyWhereTheBarMay) {
  for (const char* display : {"always", "band", "after"}) {
    TouchRun run(display);
    run.start();
    run.shown_at(0.2);
    const std::string light = run.director.status().message;
    run.shown_at(1.0);
    EXPECT_EQ(run.director.status().message == light, std::string(display) == "after") << display;
  }
}

TEST(CuePercept, CarriesTheWholeDemand) {
  DirectorStatus status;
  status.cue = Cue::kCarry;
  status.target_index = 3;
  status.force_shown = false;
  status.demand.centre_T = Vec3(1, 2, 3);
  status.demand.normal_T = Vec3::UnitX();
  status.demand.radius_m = 0.004;
  status.demand.oriented = true;
  status.demand.R_TI = Eigen::AngleAxisd(0.3, Vec3::UnitY()).toRotationMatrix();
  status.demand.angle_tolerance_rad = 0.2;
  status.demand.band = {0.3, 0.7};
  status.demand.object.size_m = Vec3(0.01, 0.02, 0.03);
  status.demand.object.slipping = true;
  status.demand.goal_T = Vec3(4, 5, 6);
  status.demand.foam[1] = {500, 0.2, 0.9};
  status.demand.foam_count = 2;
  Percept percept;
  show_cue(status, percept);
  EXPECT_EQ(percept.cue, Cue::kCarry);
  EXPECT_EQ(percept.target_index, 3);
  EXPECT_EQ(percept.target_T, Vec3(1, 2, 3));
  EXPECT_EQ(percept.target_normal_T, Vec3::UnitX());
  EXPECT_EQ(percept.target_radius_m, 0.004);
  EXPECT_TRUE(percept.target_oriented);
  EXPECT_EQ(percept.target_R_TI, status.demand.R_TI);
  EXPECT_EQ(percept.target_angle_rad, 0.2);
  EXPECT_EQ(percept.band_low_n, 0.3);
  EXPECT_EQ(percept.band_high_n, 0.7);
  EXPECT_EQ(percept.object.size_m, Vec3(0.01, 0.02, 0.03));
  EXPECT_TRUE(percept.object.slipping);
  EXPECT_EQ(percept.goal_T, Vec3(4, 5, 6));
  EXPECT_EQ(percept.foam[1].stiffness_n_per_m, 500);
  EXPECT_EQ(percept.foam_count, 2);
}

TEST(CuePercept, LeavesPlaceForceAndTimeToTheSession) {
  Percept percept;
  percept.t_s = 7;
  percept.tip_T = Vec3(0.1, 0.2, 0.3);
  percept.felt_force_T = Vec3(0, 0, 0.5);
  percept.shown_force_n = 0.25;
  percept.jaw_opening_m = 0.012;
  show_cue(DirectorStatus{}, percept);
  EXPECT_EQ(percept.t_s, 7);
  EXPECT_EQ(percept.tip_T, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(percept.felt_force_T.z(), 0.5);
  EXPECT_EQ(percept.shown_force_n, 0.25);
  EXPECT_EQ(percept.jaw_opening_m, 0.012);
}

TEST(CuePercept, WhileWaitingTheTargetIsTheStartSphere) {
  TouchRun run("always");
  run.state.X_TI.p = Vec3(0, 0, 0.2);
  run.feed(0.1);
  Percept percept;
  percept.target_index = 5;
  show_cue(run.director.status(), percept);
  EXPECT_EQ(percept.cue, Cue::kWait);
  EXPECT_EQ(percept.target_index, -1);
  EXPECT_EQ(percept.target_T, TouchRun::board().start_T);
  EXPECT_EQ(percept.target_radius_m, run.exercise.start_sphere_m);
}

/// The watch alone, one state every 10 ms.
struct Watch {
  Exercise exercise = surface_touch();
  SafetyWatch watch{exercise};
  EventLog log;
  StylusState state;

  void feed(double seconds) {
    for (int i = 0; i < std::lround(seconds * 100); ++i) watch.update(state, 0.01, 4, log);
  }
  int count(const std::string& type) const {
    return static_cast<int>(
        std::count_if(log.events.begin(), log.events.end(), [&](const Event& e) { return e.type == type; }));
  }
};

TEST(SafetyWatch, NotesEachPressOfTheClutchOnce) {
  Watch w;
  for (int i = 0; i < 3; ++i) {
    w.state.clutched = true;
    w.feed(0.4);
    w.state.clutched = false;
    w.feed(0.1);
  }
  EXPECT_EQ(w.count("CLUTCH"), 3);
  EXPECT_EQ(w.count("INSTRUMENT_FREE"), 3);
  EXPECT_EQ(w.log.events.size(), 6u);
  EXPECT_EQ(w.log.events[0].severity, Severity::kInfo);
  EXPECT_EQ(w.log.events[0].object, 4);
}

TEST(SafetyWatch, NotesEachHoldAtThePortWithItsDepth) {
  Watch w;
  w.state.port_held = true;
  w.state.depth_in_port_m = 0.28;
  w.feed(1);
  ASSERT_EQ(w.count("PORT_HOLD"), 1);
  EXPECT_EQ(w.log.events[0].severity, Severity::kMinor);
  EXPECT_EQ(w.log.events[0].value, 0.28);
  EXPECT_EQ(w.log.events[0].unit, "m");
  w.state.port_held = false;
  w.feed(0.05);
  w.state.port_held = true;
  w.feed(0.05);
  EXPECT_EQ(w.count("PORT_HOLD"), 2);
}

TEST(SafetyWatch, OnlyTheShaftCollides) {
  Watch w;
  w.state.contact = w.state.tip_contact = true;
  w.state.F_I_T.force = Vec3(0, 0, 2.5);
  w.feed(0.3);
  EXPECT_EQ(w.count("TOOL_COLLISION"), 0);
  w.state.tip_contact = false;
  w.feed(0.3);
  EXPECT_EQ(w.count("TOOL_COLLISION"), 1);
}

TEST(SafetyWatch, RemembersThePeakAndWhetherItIsTooHardNow) {
  Watch w;
  const double hard = w.exercise.hard_force_n;
  w.state.F_I_T.force = Vec3(hard + 0.1, 0, 0);
  w.feed(0.1);
  EXPECT_TRUE(w.watch.too_hard());
  EXPECT_EQ(w.watch.excess_count(), 1);
  w.state.F_I_T.force = Vec3(0.81 * hard, 0, 0);
  w.feed(1);
  EXPECT_TRUE(w.watch.too_hard()) << "not below eight tenths";
  w.state.F_I_T.force = Vec3(0.79 * hard, 0, 0);
  w.feed(0.18);
  EXPECT_TRUE(w.watch.too_hard()) << "not for long enough";
  w.feed(0.04);
  EXPECT_FALSE(w.watch.too_hard());
  EXPECT_DOUBLE_EQ(w.watch.peak_n(), hard + 0.1);
  EXPECT_EQ(w.watch.excess_count(), 1);
}

}  // namespace
}  // namespace trocar::feedback_test
