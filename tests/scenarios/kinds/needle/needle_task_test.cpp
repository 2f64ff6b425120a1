// The rules of needle driving against told states: what a good pair tells, each mistake, and what earns nothing.
#include "scenarios/kinds/needle/needle_task.h"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/needle/needle_layout.h"
#include "scenarios/scoring/metrics.h"
#include "tissue/tissue_frame.h"

namespace trocar::needle_task_test {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kPairs = 2;

Exercise shipped() { return find_exercise("E12", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A told needle, the shaft along y over flat tissue; the exercise has begun.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels[1];
  NeedleShape shape = needle_of(exercise);
  Director director;
  StylusState stylus;
  TissueFrame frame;
  std::int32_t bites = 0;

  Bench() : director(exercise, level, board(needle_of(exercise))) {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = Vec3(0, 0, 0.045);
    frame.needle.there = true;
    frame.needle.X_TN = own_rules<NeedleBoard>(director.board()).X_TN_stand;
    frame.suture.needles = 1;
    step(1.2);
  }
  static Board board(const NeedleShape& shape) {
    Board out;
    out.start_T = Vec3(0, 0, 0.045);
    Mat3 R;
    R.col(2) = Vec3::UnitY();
    R.col(0) = Vec3::UnitX();
    R.col(1) = R.col(2).cross(R.col(0));
    for (const double x : {-0.005, 0.005})
      for (int pair = 0; pair < kPairs; ++pair)
        out.targets.push_back({.centre_T = Vec3(x, 0.008 * pair, 0), .radius_m = 0.001, .R_TI = R});
    NeedleBoard own;
    own.shape = shape;
    own.X_TN_stand = needle_across(shape, Vec3(0, 0, 0.03), Vec3::UnitZ(), Vec3::UnitY(), std::numbers::pi);
    out.own = std::make_shared<const NeedleBoard>(own);
    return out;
  }
  void step(double seconds = kStep_s) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
    }
  }
  /// @param share of the needle's length from its point
  void grip(double share) {
    frame.suture.held = true;
    frame.needle.held_share = 1 - share;
    step();
  }
  void let_go() {
    frame.suture.held = false;
    step();
  }
  /// The needle's circle through a pair's dots, its point so far beyond where it goes in.
  void turn(int pair, double beyond_rad) {
    const Target& in = director.board().targets[static_cast<std::size_t>(pair)];
    const Target& out = director.board().targets[static_cast<std::size_t>(kPairs + pair)];
    const BiteCircle circle = bite_circle(shape, in.centre_T, out.centre_T, Vec3::UnitZ(), Vec3::UnitY());
    frame.needle.X_TN =
        needle_across(shape, circle.middle_T, circle.up_T, Vec3::UnitY(), circle.entry_rad + beyond_rad);
  }
  void go_in(int pair, double off_m = 0) {
    turn(pair, 0);
    NeedleBite bite;
    bite.number = bites++;
    bite.entry_rest_T = bite.end_rest_T =
        director.board().targets[static_cast<std::size_t>(pair)].centre_T + Vec3(0, off_m, 0);
    bite.entry_along_T = frame.needle.X_TN.R * shape.tangent(shape.length_m);
    frame.needle.bite[0] = bite;
    frame.needle.bite_count = 1;
    step();
  }
  void come_out(int pair, double off_m = 0) {
    const double way = 2 * std::asin(0.005 / shape.radius_m());
    for (int i = 1; i <= 20; ++i) {
      turn(pair, way * i / 20);
      step();
    }
    NeedleBite& bite = frame.needle.bite[0];
    bite.through = true;
    bite.end_rest_T = director.board().targets[static_cast<std::size_t>(kPairs + pair)].centre_T + Vec3(0, off_m, 0);
    step();
    turn(pair, way + 0.007 / shape.radius_m());
    step();
  }
  /// Out of the bite that it is in the longest.
  void draw() {
    --frame.needle.bite_count;
    frame.needle.bite[0] = frame.needle.bite[1];
    ++frame.suture.stitches;
    step();
  }
  void withdraw() {
    frame.needle.bite_count = 0;
    step();
  }
  void another() {
    ++frame.suture.needles;
    frame.needle.X_TN = own_rules<NeedleBoard>(director.board()).X_TN_stand;
    step();
  }
  void do_pair(int pair) {
    grip(0.58);
    go_in(pair);
    come_out(pair);
    let_go();
    grip(0.1);
    draw();
  }
  long count(EventType type, Severity severity) const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(),
                         [&](const Event& e) { return e.type == type && e.severity == severity; });
  }
  double metric(const char* name) const {
    ScoringContext context = scoring_context(exercise, level, director.board(), director.events(), director.outcome());
    Trace trace;
    trace.rate_hz = 100;
    trace.samples.resize(1);
    trace.samples.back().t_s = stylus.t_s;
    for (const Metric& metric : compute_metrics(trace, director.events(), context))
      if (metric.name == name) return metric.value.value_or(-1);
    return -2;
  }
  Cue cue() const { return director.status().cue; }
};

TEST(NeedleTask, AsksStepByStepAndIsDoneOnceAllAreDrawn) {
  Bench bench;
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle);
  bench.grip(0.58);
  EXPECT_EQ(bench.cue(), Cue::kDrive);
  bench.go_in(0);
  EXPECT_EQ(bench.cue(), Cue::kDrive);
  bench.come_out(0);
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle) << "at its point";
  bench.let_go();
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle);
  bench.grip(0.1);
  EXPECT_EQ(bench.cue(), Cue::kPull);
  bench.draw();
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle);
  EXPECT_EQ(bench.director.status().message, "Let go of the needle");
  bench.let_go();
  bench.another();
  bench.do_pair(1);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_NEAR(bench.metric("entry_error_m"), 0, 1e-12);
  EXPECT_NEAR(bench.metric("exit_error_m"), 0, 1e-12);
  EXPECT_LT(bench.metric("needle_angle_deg"), 3) << "on its own circle";
  EXPECT_EQ(bench.metric("needle_redos"), 0);
}

TEST(NeedleTask, ToldDistancesAreThoseFromTheDots) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0, 0.001);
  bench.come_out(0, 0.002);
  EXPECT_NEAR(bench.metric("entry_error_m"), 0.001, 1e-12);
  EXPECT_NEAR(bench.metric("exit_error_m"), 0.002, 1e-12);
  EXPECT_EQ(bench.count(event_type::kBiteBegun, Severity::kInfo), 1) << "within 1.5 mm";
  EXPECT_EQ(bench.count(event_type::kBiteThrough, Severity::kMinor), 1) << "beyond";
}

TEST(NeedleTask, WrongAndNeedlessGripsAreRedos) {
  Bench bench;
  bench.grip(0.9);
  EXPECT_EQ(bench.count(event_type::kNeedleGripped, Severity::kMinor), 1) << "too near to the swage";
  bench.let_go();
  bench.grip(0.58);
  EXPECT_EQ(bench.count(event_type::kNeedleGripped, Severity::kMinor), 2) << "once more than needed";
  EXPECT_EQ(bench.metric("needle_redos"), 2);
}

TEST(NeedleTask, ABiteThatIsUndoneCountsAndItsErrorStays) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0, 0.002);
  bench.step(0.5);
  bench.withdraw();
  EXPECT_EQ(bench.count(event_type::kBiteUndone, Severity::kMinor), 1);
  bench.go_in(0);
  bench.step(0.5);
  EXPECT_NEAR(bench.metric("entry_error_m"), 0.001, 1e-12) << "mean of both: going in again washes nothing off";
  EXPECT_EQ(bench.metric("needle_redos"), 1);
}

TEST(NeedleTask, APointThatSlidesOverTheSurfaceHasNotBitten) {
  Bench bench;
  bench.grip(0.58);
  for (int i = 0; i < 5; ++i) {
    bench.go_in(0, 0.004);
    bench.withdraw();
  }
  EXPECT_EQ(bench.metric("entry_error_m"), -1) << "nothing was told";
  EXPECT_EQ(bench.metric("needle_redos"), 0);
  bench.go_in(0, 0.001);
  bench.come_out(0);
  EXPECT_NEAR(bench.metric("entry_error_m"), 0.001, 1e-12) << "of the bite that held";
}

TEST(NeedleTask, ANeedleThatHasBittenTwiceIsDrawnOnceItIsOutOfBoth) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0);
  bench.come_out(0);
  bench.let_go();
  NeedleSight& needle = bench.frame.needle;
  needle.bite[1] = needle.bite[0];
  needle.bite[1].number = bench.bites++;
  needle.bite_count = 2;
  bench.grip(0.1);
  bench.draw();
  EXPECT_EQ(bench.count(event_type::kNeedleDrawn, Severity::kInfo), 0) << "no other needle stands ready yet";
  EXPECT_EQ(bench.director.status().cue, Cue::kPull);
  bench.draw();
  EXPECT_EQ(bench.count(event_type::kNeedleDrawn, Severity::kInfo), 1);
  EXPECT_EQ(bench.director.status().targets_done, 1);
  bench.another();
  bench.let_go();
  bench.do_pair(1);
  EXPECT_EQ(bench.count(event_type::kNeedleDrawn, Severity::kInfo), 2);
}

TEST(NeedleTask, ADroppedNeedleIsARedoAndALostOneCritical) {
  Bench bench;
  bench.grip(0.58);
  bench.let_go();
  bench.another();
  EXPECT_EQ(bench.count(event_type::kNeedleLost, Severity::kMinor), 1);
  bench.grip(0.58);
  bench.let_go();
  bench.frame.needle.X_TN.p = Vec3(0.2, 0, 0);
  bench.step();
  bench.another();
  EXPECT_EQ(bench.count(event_type::kNeedleLost, Severity::kCritical), 1);
}

TEST(NeedleTask, ANeedleHeldByItsPointIsToBeTakenAnew) {
  Bench bench;
  bench.grip(0.10);
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle);
  bench.step(4);
  EXPECT_EQ(bench.director.status().message, "Let go of the needle");
  bench.let_go();
  EXPECT_EQ(bench.cue(), Cue::kTakeNeedle);
  bench.grip(0.58);
  EXPECT_EQ(bench.cue(), Cue::kDrive);
}

TEST(NeedleTask, ANeedleTornOutIsCritical) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0);
  bench.frame.needle.bite_count = 0;
  ++bench.frame.suture.tears;
  bench.step();
  EXPECT_EQ(bench.count(event_type::kTear, Severity::kCritical), 1);
  EXPECT_EQ(bench.count(event_type::kBiteUndone, Severity::kMinor), 0);
}

TEST(NeedleTask, AWayAcrossTheNeedleIsToldInDegrees) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0);
  for (int i = 0; i < 50; ++i) {
    bench.frame.needle.X_TN.p += Vec3(0, 0.0002, 0);
    bench.step();
  }
  bench.frame.needle.bite[0].through = true;
  bench.step();
  bench.draw();
  EXPECT_NEAR(bench.metric("needle_angle_deg"), 90, 1e-6);
}

TEST(NeedleTask, DwellingAndTheClutchEarnNothing) {
  Bench bench;
  bench.grip(0.58);
  bench.go_in(0, 0.001);
  bench.step(0.5);
  const std::size_t events = bench.director.events().size();
  bench.step(5);
  bench.stylus.clutched = true;
  bench.step(5);
  EXPECT_EQ(bench.director.events().size(), events + 1) << "of the clutch";
  EXPECT_EQ(bench.director.status().targets_done, 0);
}

TEST(NeedleTask, NothingIsToldBeforeTheNeedleWasTaken) {
  Bench bench;
  bench.step(1);
  for (const char* name : {"entry_error_m", "exit_error_m", "needle_angle_deg", "needle_redos"})
    EXPECT_EQ(bench.metric(name), -1) << name;
}

}  // namespace
}  // namespace trocar::needle_task_test
