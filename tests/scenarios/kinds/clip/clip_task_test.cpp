// The rules of clip and cut against told states: which clip and which cut count, and each way in which one does not.
#include "scenarios/kinds/clip/clip_task.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/score.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tissue/thin/duct_system.h"
#include "tissue/tissue_frame.h"

namespace trocar::clip_task_test {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kDuct = 0, kArtery = 1, kBileDuct = 2;

Exercise shipped() { return find_exercise("E11", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A told instrument and told marks; the exercise has begun. Both structures run along x, from a vessel across it.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels.front();
  Director director;
  StylusState stylus;
  TissueFrame frame;

  Bench() : director(exercise, level, board()) {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = Vec3(0, 0, 0.055);
    step(1.2);
  }
  static Board board() {
    Board out;
    out.start_T = Vec3(0, 0, 0.055);
    out.ducts_T = {{Vec3(0, 0, 0), Vec3(0.04, 0, 0)},
                   {Vec3(0, 0.008, 0), Vec3(0.04, 0.008, 0)},
                   {Vec3(0, -0.03, 0), Vec3(0, 0.03, 0)}};
    out.targets.resize(kClipAims);
    return out;
  }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
    }
  }
  void touch(std::int32_t duct, double seconds) {
    frame.touched_duct = duct;
    step(seconds);
    frame.touched_duct = -1;
    step(0.5);
  }
  void name_both() {
    touch(kDuct, 1.2);
    touch(kArtery, 1.2);
  }
  void mark(const DuctMark& mark) {
    frame.duct_mark[static_cast<std::size_t>(frame.duct_mark_count++)] = mark;
    step(kStep_s);
  }
  void clip(int duct, double arc_mm, double angle_deg = 0, double share = 1) {
    mark({DuctMark::Kind::kClip, duct, 1e-3 * arc_mm, share, angle_deg * std::numbers::pi / 180, 0.002});
  }
  void cut(int duct, double arc_mm, DuctMark::Kind kind = DuctMark::Kind::kCut) {
    mark({.kind = kind, .duct = duct, .arc_m = 1e-3 * arc_mm});
  }
  void lose(int duct, double arc_mm) {
    const auto marks = std::span(frame.duct_mark).first(static_cast<std::size_t>(frame.duct_mark_count));
    const auto end = std::remove_if(marks.begin(), marks.end(), [&](const DuctMark& mark) {
      return mark.kind == DuctMark::Kind::kClip && mark.duct == duct && mark.arc_m == 1e-3 * arc_mm;
    });
    ASSERT_EQ(marks.end() - end, 1);
    --frame.duct_mark_count;
    step(kStep_s);
  }
  void clip_all(int duct, double angle_deg = 0) {
    for (const double arc : {9.3, 14.3, 23.8}) clip(duct, arc, angle_deg);
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
  ScoringContext context() const {
    return scoring_context(exercise, level, director.board(), director.events(), director.outcome());
  }
  /// The attempt reaches as far as now.
  std::vector<Metric> metrics() const {
    Trace trace;
    trace.rate_hz = 100;
    trace.samples.resize(1);
    trace.samples.back().t_s = stylus.t_s;
    return compute_metrics(trace, director.events(), context());
  }
  double metric(const char* name) const {
    for (const Metric& metric : metrics())
      if (metric.name == name) return metric.value.value_or(-1);
    return -2;
  }
  /// Before any cap.
  double score() const {
    const AttemptEnd end{AttemptStatus::kCompleted, context().objects_done, kClipAims};
    double sum = 0;
    for (const Subscore& one : grade_metrics(metrics(), exercise.rubric, end).subscores) sum += one.weight * one.value;
    return sum;
  }
  int done() const { return context().objects_done; }
};

TEST(ClipTask, IsDoneOnceBothAreNamedClippedAndCutBetween) {
  Bench bench;
  EXPECT_EQ(bench.director.status().cue, Cue::kReach);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kGrasper);
  bench.name_both();
  EXPECT_EQ(bench.director.status().cue, Cue::kClip);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kClipApplier);
  bench.clip_all(kDuct);
  bench.clip_all(kArtery, 6);
  EXPECT_EQ(bench.director.status().cue, Cue::kSever);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kScissors);
  bench.cut(kDuct, 19.05);
  bench.cut(kArtery, 19.55);
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.done(), kClipAims);
  EXPECT_EQ(bench.metric("clips_correct_share"), 1);
  EXPECT_EQ(bench.metric("clip_errors"), 0);
  EXPECT_NEAR(bench.metric("clip_angle_deg"), 3, 1e-9);
  EXPECT_NEAR(bench.metric("cut_off_middle_m"), 0.00025, 1e-9);
  EXPECT_EQ(bench.critical(), 0);
}

TEST(ClipTask, AnyOrderIsAsGood) {
  Bench bench;
  bench.name_both();
  bench.clip(kArtery, 23);
  bench.clip(kArtery, 13.5);
  bench.clip(kArtery, 9);
  bench.cut(kArtery, 19.05);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kClipApplier) << "the duct is left";
  bench.clip_all(kDuct);
  bench.cut(kDuct, 19.05);
  EXPECT_EQ(bench.metric("clips_correct_share"), 1);
  EXPECT_EQ(bench.critical(), 0);
}

TEST(ClipTask, ATouchNamesWhatIsAskedForAndAnotherIsAMistakeOnce) {
  Bench bench;
  bench.touch(kArtery, 5);
  EXPECT_EQ(bench.count(event_type::kWrongStructure), 1) << "staying on it is no second one";
  EXPECT_EQ(bench.count(event_type::kNamed), 0);
  bench.touch(kDuct, 0.9);
  EXPECT_EQ(bench.count(event_type::kNamed), 0) << "not long enough";
  bench.touch(kDuct, 1.1);
  EXPECT_EQ(bench.count(event_type::kNamed), 1);
  bench.touch(kDuct, 1.1);
  EXPECT_EQ(bench.count(event_type::kWrongStructure), 2) << "now the artery is asked for";
  EXPECT_EQ(bench.critical(), 0);
}

TEST(ClipTask, AnotherInstrumentOrTheClutchNamesNothing) {
  Bench bench;
  bench.stylus.instrument = 1;
  bench.touch(kDuct, 3);
  bench.stylus.instrument = 0;
  bench.stylus.clutched = true;
  bench.touch(kDuct, 3);
  EXPECT_EQ(bench.count(event_type::kNamed), 0);
  bench.stylus.clutched = false;
  bench.touch(kDuct, 1.1);
  EXPECT_EQ(bench.count(event_type::kNamed), 1);
}

TEST(ClipTask, AClipBeforeBothAreNamedDoesNotCount) {
  Bench bench;
  bench.touch(kDuct, 1.2);
  bench.clip(kDuct, 9);
  EXPECT_EQ(bench.count(event_type::kClipSet), 0);
  EXPECT_EQ(bench.count(event_type::kClipWasted), 1);
  EXPECT_EQ(bench.director.status().target_index, kArtery) << "the artery is still to be named";
}

TEST(ClipTask, AskewHalfTooNearOrOneTooManyIsWasted) {
  Bench bench;
  bench.name_both();
  bench.clip(kDuct, 9, 21);
  bench.clip(kArtery, 9, 0, 0.9);
  EXPECT_EQ(bench.count(event_type::kClipWasted), 2);
  bench.clip(kDuct, 12.1);  // 1.9 mm between their edges
  EXPECT_EQ(bench.count(event_type::kClipWasted), 3) << "a clip that does not count is in the way all the same";
  bench.clip(kDuct, 15.4);
  EXPECT_EQ(bench.count(event_type::kClipSet), 1);
  bench.clip(kArtery, 6.3);  // what it comes from ends 1.75 mm from where it begins: 3.95 mm to the clip's edge
  EXPECT_EQ(bench.count(event_type::kClipWasted), 4);
  for (const double arc : {19.0, 23.0, 27.0, 31.0}) bench.clip(kArtery, arc);
  EXPECT_EQ(bench.count(event_type::kClipSet), 4) << "three are enough";
  EXPECT_EQ(bench.metric("clips_wasted"), 5);
  EXPECT_NEAR(bench.metric("clips_correct_share"), 4 / 6.0, 1e-12);
}

TEST(ClipTask, AClosingThatIsRefusedIsAWastedClipUnlessItWasGivenUp) {
  Bench bench;
  bench.name_both();
  const auto refuse = [&](std::int32_t why) {
    ++bench.frame.surgery.refusals;
    bench.frame.surgery.refusal = why;
    bench.step(0.1);
  };
  refuse(refusal_code(ClipRefusal::kAngle));
  refuse(refusal_code(ClipRefusal::kTipHidden));
  EXPECT_EQ(bench.count(event_type::kClipWasted), 2);
  refuse(refusal_code(ClipRefusal::kNotShut));
  refuse(refusal_code(ClipRefusal::kMagazineEmpty));
  refuse(1);  // of blades
  EXPECT_EQ(bench.count(event_type::kClipWasted), 2);
}

TEST(ClipTask, AClipThatComesOffIsMissingAgain) {
  Bench bench;
  bench.name_both();
  bench.clip(kDuct, 9);
  EXPECT_EQ(bench.director.status().target_index, kFirstClipAim + 1);
  bench.frame.duct_mark_count = 0;
  bench.step(kStep_s);
  EXPECT_EQ(bench.count(event_type::kClipWasted), 1);
  EXPECT_EQ(bench.director.status().target_index, kFirstClipAim);
  EXPECT_EQ(bench.metric("clips_correct_share"), 0);
  EXPECT_EQ(bench.done(), 2) << "the names";
  bench.clip(kDuct, 9);
  EXPECT_NEAR(bench.metric("clips_correct_share"), 1 / 6.0, 1e-12);
  EXPECT_EQ(bench.done(), 3);
}

TEST(ClipTask, AStumpThatLosesItsClipHasOneLessUntilItIsClippedAgain) {
  Bench bench;
  bench.name_both();
  bench.clip_all(kDuct);
  bench.cut(kDuct, 19.05);
  bench.lose(kDuct, 23.8);
  EXPECT_EQ(bench.count(event_type::kClipWasted), 1);
  EXPECT_EQ(bench.director.status().message, "A clip came off");
  EXPECT_NEAR(bench.metric("clips_correct_share"), 2 / 6.0, 1e-12);
  EXPECT_EQ(bench.critical(), 0);
  bench.clip(kDuct, 24);
  EXPECT_NEAR(bench.metric("clips_correct_share"), 3 / 6.0, 1e-12);
  bench.clip_all(kArtery);
  bench.lose(kArtery, 14.3);
  bench.cut(kArtery, 19.05);
  EXPECT_EQ(bench.critical(), 1) << "one before it is too few";
}

TEST(ClipTask, OfAClipThatComesOffWhatMustBeSparedNothingIsCounted) {
  Bench bench;
  bench.clip(kBileDuct, 30);
  bench.lose(kBileDuct, 30);
  EXPECT_EQ(bench.count(event_type::kClipWasted), 0) << "who has tried nothing else has no errors to be few of";
  EXPECT_EQ(bench.critical(), 1);
}

TEST(ClipTask, AClipThatComesOffNeverRaisesTheScore) {
  for (const double askew_deg : {0.0, 5.0})
    for (const bool cut : {false, true})
      for (const double lost_mm : {9.3, 14.3, 23.8}) {
        Bench kept, lost;
        for (Bench* bench : {&kept, &lost}) {
          bench->name_both();
          bench->clip_all(kDuct, askew_deg);
          bench->clip(kArtery, 9.3, 25);
          if (cut) bench->cut(kDuct, 19.05);
        }
        for (const int duct : {kDuct, kArtery}) {
          const double before = lost.score();
          lost.lose(duct, duct == kDuct ? lost_mm : 9.3);
          kept.step(kStep_s);
          EXPECT_LE(lost.score(), before);
        }
        EXPECT_LT(lost.score(), kept.score()) << lost_mm;
      }
}

TEST(ClipTask, WhatMustBeSparedIsCritical) {
  Bench bench;
  bench.name_both();
  bench.clip(kBileDuct, 30);
  EXPECT_EQ(bench.critical(), 1);
  bench.cut(kBileDuct, 40);
  EXPECT_EQ(bench.critical(), 2);
  EXPECT_EQ(bench.count(event_type::kWrongStructure), 2);
}

TEST(ClipTask, OpeningWithoutTwoClipsBeforeAndOneBeyondIsCritical) {
  struct Case {
    std::vector<double> clips_mm;
    double at_mm;
    DuctMark::Kind kind;
    long critical;
  };
  using Kind = DuctMark::Kind;
  for (const Case& one : {Case{{9, 13.5, 23}, 18, Kind::kCut, 0}, Case{{9, 13.5, 23}, 11, Kind::kCut, 1},
                          Case{{9, 13.5}, 18, Kind::kCut, 1}, Case{{}, 18, Kind::kNick, 1},
                          Case{{9, 13.5, 23}, 18, Kind::kNick, 0}, Case{{9, 13.5, 23}, 18, Kind::kTorn, 1}}) {
    Bench bench;
    bench.name_both();
    for (const double arc : one.clips_mm) bench.clip(kDuct, arc);
    bench.cut(kDuct, one.at_mm, one.kind);
    EXPECT_EQ(bench.critical(), one.critical) << one.clips_mm.size() << " clips, opened at " << one.at_mm;
    EXPECT_EQ(bench.count(event_type::kDivided), one.kind != Kind::kNick);
  }
}

TEST(ClipTask, ACutBesideAClipIsAMistakeAndFarFromTheMiddle) {
  Bench bench;
  bench.name_both();
  bench.clip_all(kDuct);
  bench.cut(kDuct, 16.8);  // 1.9 mm from the second clip's edge
  EXPECT_EQ(bench.metric("clip_errors"), 1);
  EXPECT_NEAR(bench.metric("cut_off_middle_m"), 0.00225, 1e-9);
  bench.cut(kDuct, 20);
  EXPECT_NEAR(bench.metric("cut_off_middle_m"), 0.00225, 1e-9) << "a second cut mends nothing";
}

TEST(ClipTask, WhatWasLeftOutOfADividedStructureIsNotUndone) {
  Bench bench;
  bench.name_both();
  bench.clip(kDuct, 9);
  bench.clip(kDuct, 14, 30);  // it shuts the duct, but it does not count
  bench.clip(kDuct, 23);
  bench.cut(kDuct, 18);
  EXPECT_EQ(bench.critical(), 0);
  EXPECT_EQ(bench.done(), 2 + kClipsEach + 1);
  EXPECT_EQ(bench.director.status().target_index, kFirstClipAim + kClipsEach) << "the artery's first clip";
}

TEST(ClipTask, MuchBloodIsCriticalOnce) {
  Bench bench;
  bench.frame.surgery.blood_ml = 51;
  bench.step(1);
  bench.frame.surgery.blood_ml = 60;
  bench.step(1);
  EXPECT_EQ(bench.critical(), 1);
}

TEST(ClipTask, WithoutATryNothingIsMeasured) {
  Bench bench;
  for (const char* name : {"clips_correct_share", "clips_wasted", "clip_errors", "clip_angle_deg", "cut_off_middle_m"})
    EXPECT_EQ(bench.metric(name), -1) << name;
  EXPECT_EQ(bench.done(), 0);
}

}  // namespace
}  // namespace trocar::clip_task_test
