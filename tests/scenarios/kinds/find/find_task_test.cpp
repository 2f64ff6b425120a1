// The rules of lift and find against told states: what counts as seen, held and told, and each way to cheat.
#include "scenarios/kinds/find/find_task.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/score.h"
#include "tissue/tissue_frame.h"

namespace trocar::find_task_test {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kHingeY = 0.015, kEdgeY = -0.010;  // m: hinge, and where the flap is taken

Exercise shipped() { return find_exercise("E08", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A told instrument and a told grip; the exercise has begun.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels.front();
  Director director;
  StylusState stylus;
  TissueFrame frame;

  Bench() : director(exercise, level, board()) {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = director.board().start_T;
    step(1.2);
  }
  static Board board() {
    Board out;
    out.start_T = Vec3(0, 0, 0.045);
    FindBoard own;
    own.hinge_T = Vec3(0.02, kHingeY, 0);
    own.along_T = -Vec3::UnitX();
    own.thickness_m = 0.003;
    for (int n = 0; n < 5; ++n) {
      out.targets.push_back({Vec3(0.006 * (n - 2), kEdgeY, 0), Vec3::UnitZ(), 0.004, {}, Mat3::Identity()});
      own.pins.push_back({Vec3(0, 0, 0), Vec3::UnitZ(), n % kMostAnswers});
    }
    for (int n = 0; n < kMostAnswers; ++n)
      own.answers_T[static_cast<std::size_t>(n)] = Vec3(0.015 * (n - 1.5), -0.03, 0.008);
    out.own = std::make_shared<const FindBoard>(own);
    return out;
  }
  const FindBoard& own() const { return own_rules<FindBoard>(director.board()); }
  const DirectorStatus& now() const { return director.status(); }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
    }
  }
  void take(int place) {
    stylus.X_TI.p = director.board().targets[static_cast<std::size_t>(place)].centre_T;
    stylus.grip_force_n = 1;
    frame.grip = GripState::kHolding;
    step(kStep_s);
  }
  /// Turns the flap about its hinge. @param share of its width, how far from the hinge it is held
  void swing(double degrees, double share = 1) {
    const double angle = degrees * M_PI / 180, width = share * (kHingeY - kEdgeY);
    stylus.X_TI.p.y() = kHingeY - width * std::cos(angle);
    stylus.X_TI.p.z() = width * std::sin(angle);
    step(kStep_s);
  }
  void let_go() {
    frame.grip = GripState::kEmpty;
    stylus.grip_force_n = 0;
    step(kStep_s);
  }
  void read(int place) {
    take(place);
    swing(65);
    step(3.1);
    swing(0);
    let_go();
  }
  void tell(int symbol, double seconds = 1.1) {
    stylus.X_TI.p = own().answers_T[static_cast<std::size_t>(symbol)];
    step(seconds);
  }
  int symbol(int place) const { return own().pins[static_cast<std::size_t>(place)].symbol; }
  long count(EventType type) const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.type == type; });
  }
  ScoringContext context() const {
    return scoring_context(exercise, level, director.board(), director.events(), director.outcome());
  }
  double metric(const char* name) const {
    Trace trace;
    trace.rate_hz = 100;
    for (const Metric& metric : compute_metrics(trace, director.events(), context()))
      if (metric.name == name) return metric.value.value_or(-1);
    return -2;
  }
};

TEST(FindTask, IsDoneOnceEverySymbolWasReadAndTold) {
  Bench bench;
  for (int place = 0; place < 5; ++place) {
    EXPECT_EQ(bench.now().target_index, place);
    EXPECT_EQ(bench.now().cue, Cue::kTake);
    bench.read(place);
    EXPECT_EQ(bench.now().cue, Cue::kRead);
    bench.tell(bench.symbol(place));
  }
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.metric("right_answers_share"), 1);
  EXPECT_EQ(bench.metric("holds_lost"), 0);
  EXPECT_EQ(bench.context().objects_done, 5);
}

TEST(FindTask, TheSymbolIsToldOnlyWhileTheFlapIsUp) {
  Bench bench;
  EXPECT_EQ(bench.now().shown_symbol, -1);
  bench.take(0);
  bench.swing(59);
  EXPECT_EQ(bench.now().shown_symbol, -1) << "not lifted far enough";
  EXPECT_EQ(bench.now().cue, Cue::kLift);
  bench.swing(61);
  EXPECT_EQ(bench.now().shown_symbol, bench.symbol(0));
  bench.step(2);
  bench.swing(40);
  EXPECT_EQ(bench.now().shown_symbol, -1);
  EXPECT_EQ(bench.count(event_type::kCovered), 1);
  bench.swing(80);
  bench.step(1.1);
  EXPECT_EQ(bench.now().cue, Cue::kLower) << "what was held stays held";
  EXPECT_EQ(bench.count(event_type::kTargetTouched), 1) << "the pull is judged from the first on";
  bench.swing(0);
  bench.let_go();
  EXPECT_EQ(bench.now().shown_symbol, -1) << "to be told from memory";
}

TEST(FindTask, AFlapThatIsFoldedUpShowsNothing) {
  Bench bench;
  bench.take(0);
  bench.swing(80, 0.6);
  bench.step(4);
  EXPECT_EQ(bench.now().shown_symbol, -1);
  EXPECT_EQ(bench.now().hold_progress, 0);
}

TEST(FindTask, NothingBeforeTheSymbolIsSeenTellsWhichItIs) {
  // Two boards that differ in the symbols alone are the same to hand and screen until then.
  const auto told = [](int symbol) {
    Board board = Bench::board();
    FindBoard own = own_rules<FindBoard>(board);
    for (HiddenPin& pin : own.pins) pin.symbol = symbol;
    board.own = std::make_shared<const FindBoard>(own);
    const Exercise exercise = shipped();
    Director director(exercise, exercise.levels.front(), board);
    StylusState stylus;
    TissueFrame frame;
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = board.start_T;
    std::string all;
    for (int n = 0; n < 300; ++n) {
      stylus.t_s += kStep_s;
      if (n == 150) {
        stylus.X_TI.p = board.targets[0].centre_T;
        stylus.grip_force_n = 1;
        frame.grip = GripState::kHolding;
      }
      if (n > 200) stylus.X_TI.p += Vec3(0, 0, 1e-4);
      director.update(stylus, &frame);
      const DirectorStatus& status = director.status();
      all += status.message + status.hint + std::to_string(static_cast<int>(status.cue)) +
             std::to_string(status.demand.goal_T.x()) + std::to_string(status.shown_symbol);
    }
    return all;
  };
  EXPECT_EQ(told(0), told(3));
}

TEST(FindTask, AnAnswerBeforeTheHoldIsWrongWhateverWasSeen) {
  Bench bench;
  bench.tell(bench.symbol(0));
  EXPECT_EQ(bench.count(event_type::kWrongAnswer), 1) << "guessed";
  EXPECT_EQ(bench.now().target_index, 1);
  bench.take(1);
  bench.swing(65);
  bench.step(1);
  bench.swing(0);
  bench.let_go();
  bench.tell(bench.symbol(1));
  EXPECT_EQ(bench.count(event_type::kWrongAnswer), 2) << "seen, and not held";
  EXPECT_EQ(bench.count(event_type::kAnswered), 0);
  for (int place = 2; place < 5; ++place) bench.tell(bench.symbol(place));
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.context().objects_done, 0) << "guessing does nothing";
  EXPECT_EQ(bench.metric("right_answers_share"), 0);
}

TEST(FindTask, AWrongAnswerIsGivenOnce) {
  Bench bench;
  bench.read(0);
  bench.tell((bench.symbol(0) + 1) % kMostAnswers);
  EXPECT_EQ(bench.count(event_type::kWrongAnswer), 1);
  EXPECT_EQ(bench.now().target_index, 1) << "no second try";
  EXPECT_EQ(bench.context().objects_done, 1) << "it was lifted and held";
}

TEST(FindTask, ATipThatRestsInTheBallOfTheLastAnswerTellsNothingOfTheNextPin) {
  Bench bench;
  bench.read(0);
  bench.tell(bench.symbol(0), 5);
  EXPECT_EQ(bench.count(event_type::kWrongAnswer), 0);
  EXPECT_EQ(bench.now().target_index, 1);
}

TEST(FindTask, OnlyATipThatStaysTells) {
  Bench bench;
  bench.read(0);
  for (int n = 0; n < 8; ++n) bench.tell(n % kMostAnswers, 0.5);
  EXPECT_EQ(bench.count(event_type::kAnswered) + bench.count(event_type::kWrongAnswer), 0)
      << "from ball to ball the time begins anew";
  bench.stylus.clutched = true;
  bench.tell(bench.symbol(0), 3);
  EXPECT_EQ(bench.count(event_type::kAnswered), 0) << "the clutch tells nothing";
}

TEST(FindTask, JawsThatHoldTheFlapTellNothing) {
  Bench bench;
  bench.take(0);
  bench.swing(65);
  bench.step(3.1);
  bench.tell(bench.symbol(0), 2);
  EXPECT_EQ(bench.count(event_type::kAnswered), 0);
  EXPECT_EQ(bench.now().cue, Cue::kLower);
}

TEST(FindTask, TheClutchHoldsForNobody) {
  Bench bench;
  bench.take(0);
  bench.swing(65);
  bench.stylus.clutched = true;
  bench.step(20);
  EXPECT_LT(bench.now().hold_progress, 0.01);
}

TEST(FindTask, LettingGoUpThereAndSlippingAreLosses) {
  Bench bench;
  bench.take(0);
  bench.swing(65);
  bench.frame.grip = GripState::kSlipping;
  for (int n = 0; n < 60; ++n) {
    bench.frame.slipped_m += 1e-4;
    bench.step(kStep_s);
  }
  EXPECT_EQ(bench.count(event_type::kSlip), 1) << "one, however long it slides";
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kLetGo), 1);
  bench.take(0);
  EXPECT_EQ(bench.count(event_type::kRegrasp), 1);
  bench.swing(65);
  bench.step(3);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kLetGo), 2) << "it is to be let down even when the hold is over";
  EXPECT_EQ(bench.count(event_type::kCovered), 0) << "what is let go has not sunk back besides";
}

TEST(FindTask, TissueBesideThePlaceIsNoFlap) {
  Bench bench;
  bench.take(4);  // 24 mm from the lit place
  EXPECT_EQ(bench.count(event_type::kTissueTaken), 0);
}

TEST(FindTask, WithoutAnAnswerNothingIsMeasured) {
  Bench bench;
  EXPECT_EQ(bench.metric("right_answers_share"), -1);
}

}  // namespace
}  // namespace trocar::find_task_test
