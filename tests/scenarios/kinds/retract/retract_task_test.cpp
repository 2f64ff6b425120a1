// The rules of retract and hold against told states: what counts as held, and each way in which it is lost or cheated.
#include "scenarios/kinds/retract/retract_task.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "tissue/tissue_frame.h"

namespace trocar::retract_task_test {
namespace {

constexpr double kStep_s = 0.01;

Exercise shipped() { return find_exercise("E09", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A told instrument and a told grip; the exercise has begun.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels.front();
  Director director;
  StylusState stylus;
  TissueFrame frame;

  Bench() : director(exercise, level, board()) {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = Vec3(0, 0, 0.045);
    step(1.2);
  }
  static Board board() {
    Board out;
    out.start_T = Vec3(0, 0, 0.045);
    for (const double x : {-0.03, 0.0, 0.03})
      out.targets.push_back({Vec3(x, 0, 0), Vec3::UnitZ(), 0.005, {}, Mat3::Identity()});
    return out;
  }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
    }
  }
  void pull(double newtons) { stylus.F_I_T.force = Vec3(0, 0, -newtons); }
  void take(int place, double grip_n = 1.8) {
    stylus.X_TI.p = director.board().targets[static_cast<std::size_t>(place)].centre_T - Vec3(0, 0, 0.005);
    stylus.grip_force_n = grip_n;
    frame.grip = GripState::kHolding;
    step(kStep_s);
  }
  void lift(double metres) {
    stylus.X_TI.p.z() = metres - 0.005;
    step(kStep_s);
  }
  void let_go() {
    frame.grip = GripState::kEmpty;
    pull(0);
    step(kStep_s);
  }
  long count(EventType type) const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.type == type; });
  }
  long critical() const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(),
                         [](const Event& e) { return e.severity == Severity::kCritical; });
  }
  void do_place(int place) {
    take(place);
    pull(1.6);
    lift(level_lift());
    step(10.1);
    lift(0);
    let_go();
  }
  double level_lift() const { return director.status().demand.goal_T.z() + 0.005; }
  double metric(const char* name) const {
    ScoringContext context = scoring_context(exercise, level, director.board(), director.events(), director.outcome());
    Trace trace;
    trace.rate_hz = 100;
    for (const Metric& metric : compute_metrics(trace, director.events(), context))
      if (metric.name == name) return metric.value.value_or(-1);
    return -2;
  }
};

TEST(RetractTask, IsDoneOnceEveryPlaceWasHeldAndLetDown) {
  Bench bench;
  EXPECT_EQ(bench.director.status().cue, Cue::kTake);
  EXPECT_EQ(bench.director.status().demand.centre_T, bench.director.board().targets[0].centre_T);
  for (const int place : {0, 1, 2}) bench.do_place(place);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.count(event_type::kTargetHeld), 3);
  EXPECT_EQ(bench.count(event_type::kLetGo) + bench.count(event_type::kCovered) + bench.count(event_type::kSlip), 0);
  EXPECT_EQ(bench.metric("holds_lost"), 0);
  EXPECT_LT(bench.metric("time_to_expose_s"), 0.15) << "told states need no time";
}

TEST(RetractTask, CountsTheTimeInWhichEnoughIsExposed) {
  Bench bench;
  bench.take(0);
  bench.lift(0.79 * 0.0125);
  bench.step(12);
  EXPECT_EQ(bench.director.status().hold_progress, 0) << "not lifted far enough";
  bench.lift(0.81 * 0.0125);
  bench.step(4);
  bench.lift(0.5 * 0.0125);
  bench.step(3);
  EXPECT_NEAR(bench.director.status().hold_progress, 0.4, 0.01) << "what was held stays held";
  EXPECT_EQ(bench.count(event_type::kCovered), 1);
  bench.lift(0.0125);
  bench.step(6.1);
  EXPECT_EQ(bench.director.status().cue, Cue::kLower);
  EXPECT_EQ(bench.count(event_type::kExposed), 2);
  EXPECT_EQ(bench.count(event_type::kTargetTouched), 1) << "the pull is judged from the first on";
}

TEST(RetractTask, TissueElsewhereOrLiftedAlreadyDoesNotCount) {
  Bench bench;
  bench.take(1);
  bench.lift(0.02);
  bench.step(11);
  EXPECT_EQ(bench.count(event_type::kTissueTaken), 0) << "30 mm from the lit place";
  bench.let_go();
  bench.take(0);
  EXPECT_EQ(bench.count(event_type::kTissueTaken), 1);
}

TEST(RetractTask, LettingGoTooEarlyIsALossAndTheHoldGoesOnWhenItIsTakenAgain) {
  Bench bench;
  bench.take(0);
  bench.lift(0.0125);
  bench.step(5);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kLetGo), 1);
  EXPECT_EQ(bench.director.status().cue, Cue::kTake);
  bench.take(0);
  EXPECT_EQ(bench.count(event_type::kRegrasp), 1);
  bench.lift(0.0125);
  bench.step(5.1);
  EXPECT_EQ(bench.count(event_type::kTargetHeld), 1);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kLetGo), 2) << "let go while it was lifted, though the hold was over";
  EXPECT_EQ(bench.director.status().target_index, 1);
}

TEST(RetractTask, TheClutchHoldsForNobody) {
  Bench bench;
  bench.take(0);
  bench.lift(0.0125);
  bench.stylus.clutched = true;
  bench.step(20);
  EXPECT_LT(bench.director.status().hold_progress, 0.01);
}

TEST(RetractTask, ASlipIsALossOnceAndTooHardForTooLongIsCritical) {
  Bench bench;
  bench.take(0);
  bench.lift(0.0125);
  bench.frame.grip = GripState::kSlipping;
  for (int i = 0; i < 100; ++i) {
    bench.frame.slipped_m += 1e-4;
    bench.step(kStep_s);
  }
  EXPECT_EQ(bench.count(event_type::kSlip), 1);
  bench.frame.grip = GripState::kHolding;
  bench.pull(3.1);
  bench.step(2.4);
  EXPECT_EQ(bench.critical(), 0);
  bench.step(0.2);
  EXPECT_EQ(bench.critical(), 1) << "a quarter of the hold above 3 N";
}

TEST(RetractTask, WithoutAHoldNothingIsMeasured) {
  Bench bench;
  EXPECT_EQ(bench.metric("holds_lost"), -1) << "nothing was taken: not 0";
  EXPECT_EQ(bench.metric("time_to_expose_s"), -1);
  EXPECT_EQ(bench.metric("hard_force_share"), -1);
}

TEST(RetractKind, TissueThatStandsStillIsRefused) {
  Exercise exercise = shipped();
  const std::string normal = "tissue = \"normal\"";
  exercise.text.replace(exercise.text.find(normal), normal.size(), "tissue = \"still\"");
  EXPECT_THROW(parse_exercise(exercise.text, "retract.toml"), InputError);
}

}  // namespace
}  // namespace trocar::retract_task_test
