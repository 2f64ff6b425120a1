// An operation's stages: each is told its own ducts and places, tells in the numbers of the whole, is laid out at its
// place, scored on its own window, and read strictly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "haptics/input_error.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/kinds/operation/stage_range.h"
#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::operation_test {
namespace {

const std::filesystem::path kFile =
    std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/mini-cholecystectomy.toml";
constexpr double kStep_s = 0.01, kTop = 0.01;
constexpr int kRetracts = 2, kTriangle = 3;

Board laid_out(const Exercise& exercise, const ExerciseLevel& level, int board = 0) {
  const TriangleSurface organ = plate(0.16, kTop);
  const Mat3 down = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
  return kind_of(exercise).lay_out(exercise, level, board, {organ, nullptr, down});
}

TEST(Operation, LaysEachStageOutAtItsPlace) {
  const Exercise exercise = load_exercise(kFile);
  const ExerciseLevel& level = exercise.levels.front();
  const Board board = laid_out(exercise, level);
  ASSERT_EQ(board.stages.size(), 4u);
  EXPECT_EQ(static_cast<int>(board.targets.size()), exercise.layout.count);
  EXPECT_EQ(board.ducts_T.size(), exercise.ducts.size());
  std::size_t target = 0;
  for (std::size_t i = 0; i < board.stages.size(); ++i) {
    Vec3 mean = Vec3::Zero();
    for (const Target& own : board.stages[i].targets) {
      mean += own.centre_T / static_cast<double>(board.stages[i].targets.size());
      EXPECT_EQ(board.targets[target++].centre_T, own.centre_T);
      EXPECT_NEAR(own.R_TI.determinant(), 1, 1e-9);
    }
    EXPECT_LT((mean - exercise.stages[i].at_m).head<2>().norm(), 0.02) << exercise.stages[i].name;
  }
  const std::vector<StageRange> ranges = stage_ranges(exercise, board);
  EXPECT_EQ(ranges[2].first_object, kRetracts + kTriangle);
  EXPECT_EQ(ranges[2].first_duct, kTriangle);
  EXPECT_EQ(ranges[3].vessels, 2);
  EXPECT_EQ(stage_with(ranges, kRetracts)->stage, 1);
  EXPECT_EQ(stage_with(ranges, -1), nullptr);
}

/// They would come between the open jaws, and what is taken beside them is too thin a fold to be lifted.
TEST(Operation, FoldsToBeTakenLieClearOfTheStrandsOfLaterStages) {
  const Exercise exercise = load_exercise(kFile);
  for (const ExerciseLevel& level : exercise.levels)
    for (int number = 0; number < 20; ++number) {
      const Board board = laid_out(exercise, level, number);
      double nearest = 1;
      for (int fold = 0; fold < kRetracts; ++fold)
        for (const std::vector<Vec3>& path : board.ducts_T)
          for (const Vec3& point : path)
            nearest =
                std::min(nearest, (point - board.targets[static_cast<std::size_t>(fold)].centre_T).head<2>().norm());
      EXPECT_GT(nearest, 0.0139) << level.name << ", board " << number;
    }
}

TEST(Operation, AStageIsToldOfNothingThatIsAnothers) {
  const Exercise exercise = load_exercise(kFile);
  const std::vector<StageRange> ranges = stage_ranges(exercise, laid_out(exercise, exercise.levels.front()));
  TissueFrame frame;
  frame.touched_duct = kTriangle;  // the cystic duct
  frame.duct_mark_count = 2;
  frame.duct_mark[0] = {.kind = DuctMark::Kind::kCut, .duct = 1};
  frame.duct_mark[1] = {.kind = DuctMark::Kind::kClip, .duct = kTriangle + 1};
  frame.place_count = exercise.layout.count;
  for (int i = 0; i < frame.place_count; ++i) frame.place[static_cast<std::size_t>(i)].point_T.x() = i;
  const TissueFrame triangle = frame_of(ranges[1], frame), clip = frame_of(ranges[2], frame);
  EXPECT_EQ(triangle.touched_duct, -1);
  EXPECT_EQ(clip.touched_duct, 0);
  ASSERT_EQ(triangle.duct_mark_count, 1);
  EXPECT_EQ(triangle.duct_mark[0].duct, 1);
  ASSERT_EQ(clip.duct_mark_count, 1);
  EXPECT_EQ(clip.duct_mark[0].duct, 1);
  EXPECT_EQ(clip.place_count, kClipAims);
  EXPECT_EQ(clip.place[0].point_T.x(), kRetracts + kTriangle);
  EXPECT_EQ(frame_of(ranges[0], frame).touched_duct, -1);
}

/// A told instrument and frame; the run has begun. Ducts are touched and parted by number in the whole.
struct Bench {
  Exercise exercise = load_exercise(kFile);
  ExerciseLevel level = exercise.levels.front();
  Director director{exercise, level, laid_out(exercise, level)};
  StylusState stylus;
  TissueFrame frame;
  Trace trace;

  Bench() {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = director.board().start_T;
    frame.tip_gap_m = 0.05;
    trace.rate_hz = 1 / kStep_s;
    step(1.2);
  }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
      TraceSample sample;
      sample.t_s = stylus.t_s;
      sample.tip_T = stylus.X_TI.p;
      sample.force_T = stylus.F_I_T.force;
      sample.contact = sample.force_T.norm() > 0;
      sample.pedal = stylus.pedal;
      trace.samples.push_back(sample);
    }
  }
  void retract() {
    for (int i = 0; i < kRetracts; ++i) {
      stylus.instrument = 0;
      stylus.X_TI.p = director.board().targets[static_cast<std::size_t>(i)].centre_T;
      stylus.grip_force_n = 1.8;
      frame.grip = GripState::kHolding;
      step(0.1);
      stylus.X_TI.p.z() += 0.014;
      stylus.F_I_T.force = Vec3(0, 0, -1.6);
      step(8.5);
      frame.grip = GripState::kEmpty;
      stylus.F_I_T.force.setZero();
      step(0.1);
    }
  }
  void divide(int duct) {
    stylus.instrument = 1;
    frame.tip_gap_m = 0.007;
    frame.touched_duct = duct;
    stylus.pedal = true;
    step(1);
    frame.duct_mark[static_cast<std::size_t>(frame.duct_mark_count++)] = {.kind = DuctMark::Kind::kCut, .duct = duct};
    step(kStep_s);
    frame.touched_duct = -1;
    stylus.pedal = false;
    step(0.1);
  }
  void mark(const DuctMark& mark) {
    frame.duct_mark[static_cast<std::size_t>(frame.duct_mark_count++)] = mark;
    step(kStep_s);
  }
  /// Names, clips and cuts duct and artery.
  void clip_and_cut() {
    stylus.instrument = 0;
    for (int duct = kTriangle; duct < kTriangle + kClipStructures; ++duct) {
      frame.touched_duct = duct;
      step(1.5);
      frame.touched_duct = -1;
      step(0.5);
    }
    for (int duct = kTriangle; duct < kTriangle + kClipStructures; ++duct) {
      for (const double arc_m : {0.0093, 0.0143, 0.0238}) mark({DuctMark::Kind::kClip, duct, arc_m, 1, 0, 0.002});
      mark({.kind = DuctMark::Kind::kCut, .duct = duct, .arc_m = 0.01905});
    }
  }
  const Event* event(EventType type, int object) const {
    const auto& events = director.events();
    const auto found = std::find_if(events.begin(), events.end(),
                                    [&](const Event& e) { return e.type == type && e.object == object; });
    return found == events.end() ? nullptr : &*found;
  }
  ScoringContext context() const {
    return scoring_context(exercise, level, director.board(), director.events(), director.outcome());
  }
};

TEST(Operation, StagesFollowEachOtherAndAskForTheirInstrument) {
  Bench bench;
  ASSERT_NE(bench.event(event_type::kStageBegun, 0), nullptr);
  EXPECT_EQ(bench.director.status().cue, Cue::kTake);
  bench.retract();
  ASSERT_NE(bench.event(event_type::kStageBegun, 1), nullptr);
  EXPECT_EQ(bench.director.status().target_index, kRetracts);
  EXPECT_EQ(bench.director.status().cue, Cue::kExchange);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kHook);
  EXPECT_EQ(bench.director.status().message, "Take the hook");
  bench.stylus.instrument = 1;
  bench.step(kStep_s);
  EXPECT_EQ(bench.director.status().cue, Cue::kHook);
  for (int strand = 0; strand < kTriangle; ++strand) bench.divide(strand);
  ASSERT_NE(bench.event(event_type::kStrandDivided, kRetracts + 2), nullptr);
  ASSERT_NE(bench.event(event_type::kStageBegun, 2), nullptr);
  EXPECT_EQ(bench.director.status().target_index, kRetracts + kTriangle);
  EXPECT_EQ(bench.director.status().targets_done, kRetracts + kTriangle);
  EXPECT_EQ(bench.director.status().demand.instrument, InstrumentKind::kGrasper) << "the stage itself asks";
}

TEST(Operation, WhatIsCutBeforeItsStageIsJudgedOnceThatBegins) {
  Bench bench;
  bench.retract();
  bench.frame.duct_mark[static_cast<std::size_t>(bench.frame.duct_mark_count++)] = {.kind = DuctMark::Kind::kCut,
                                                                                    .duct = kTriangle};
  bench.step(0.1);
  for (int strand = 0; strand < kTriangle; ++strand) bench.divide(strand);
  bench.step(0.1);
  const Event* soon = bench.event(event_type::kCutTooSoon, kRetracts + kTriangle + kFirstCutAim);
  ASSERT_NE(soon, nullptr);
  EXPECT_EQ(soon->severity, Severity::kCritical);
}

TEST(Operation, EachStageIsScoredOnItsOwnWindow) {
  Bench bench;
  bench.retract();
  for (int strand = 0; strand < kTriangle; ++strand) bench.divide(strand);
  const ScoringContext context = bench.context();
  ASSERT_EQ(context.stages.size(), 4u);
  EXPECT_EQ(context.objects_total, bench.exercise.layout.count);
  EXPECT_EQ(context.objects_done, kRetracts + kTriangle);
  EXPECT_EQ(context.stages[1].objects_done, kTriangle);
  EXPECT_EQ(context.stages[1].strands_total, kTriangle);
  const std::vector<Metric> metrics = compute_metrics(bench.trace, bench.director.events(), context);
  const auto value = [&](const std::string& name) {
    const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == name; });
    EXPECT_NE(found, metrics.end()) << name;
    return found == metrics.end() ? std::nullopt : found->value;
  };
  EXPECT_NEAR(value("retract/object_in_band_share").value_or(-1), 1, 0.02);
  EXPECT_NEAR(value("retract/force_max_n").value_or(-1), 1.6, 1e-9);
  EXPECT_NEAR(value("dissect/strand_clearance_share").value_or(-1), 1, 1e-9);
  EXPECT_NEAR(value("dissect/safe_energy_share").value_or(-1), 1, 1e-9);
  const std::vector<Event> own = events_of_stage(bench.director.events(), 1, kRetracts, kTriangle);
  EXPECT_NEAR(own.back().t_s - own.front().t_s, 3.3, 0.2);
  EXPECT_EQ(value("clip/clips_correct_share"), std::nullopt) << "nothing was done there";
  EXPECT_EQ(value("detach/spurted_ml"), std::nullopt) << "it never began";
  EXPECT_EQ(parse_scoring_context(scoring_context_json(context), "context"), context);
}

TEST(Operation, AClipThatComesOffInALaterStageIsLostToItsOwn) {
  Bench bench;
  bench.retract();
  for (int strand = 0; strand < kTriangle; ++strand) bench.divide(strand);
  bench.clip_and_cut();
  ASSERT_NE(bench.event(event_type::kStageBegun, 3), nullptr);
  bench.step(1);
  const auto correct = [&] {
    for (const Metric& metric : compute_metrics(bench.trace, bench.director.events(), bench.context()))
      if (metric.name == "clip/clips_correct_share") return metric.value.value_or(-1);
    return -2.0;
  };
  EXPECT_EQ(correct(), 1);
  const auto marks = std::span(bench.frame.duct_mark).first(static_cast<std::size_t>(bench.frame.duct_mark_count));
  const auto end = std::remove_if(marks.begin(), marks.end(), [](const DuctMark& mark) {
    return mark.kind == DuctMark::Kind::kClip && mark.duct == kTriangle + 1 && mark.arc_m == 0.0238;
  });
  ASSERT_EQ(marks.end() - end, 1);
  --bench.frame.duct_mark_count;
  bench.step(1);
  const int first = kRetracts + kTriangle, lost = kFirstClipAim + 2 * kClipsEach - 1;
  ASSERT_NE(bench.event(event_type::kClipWasted, first + lost), nullptr);
  EXPECT_NEAR(correct(), 5 / 6.0, 1e-12);
  const std::vector<Event> own = events_of_stage(bench.director.events(), 2, first, kClipAims);
  EXPECT_EQ(own.back().type, event_type::kDone);
  EXPECT_EQ(own[own.size() - 2].type, event_type::kClipWasted);
  EXPECT_EQ(own[own.size() - 2].object, lost);
  EXPECT_EQ(own[own.size() - 2].t_s, own.back().t_s);
  const auto& events = bench.director.events();
  EXPECT_EQ(
      std::count_if(events.begin(), events.end(), [](const Event& e) { return e.type == event_type::kClipWasted; }), 1)
      << "told once";
}

std::string shipped_with(const std::string& from, const std::string& to) {
  std::string text = load_exercise(kFile).text;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Operation, FilesAreReadStrictly) {
  const auto refusal = [](const std::string& from, const std::string& to) -> std::string {
    try {
      parse_exercise(shipped_with(from, to), "operation.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("count = 19", "count = 18").find("must be 19"), std::string::npos);
  EXPECT_NE(refusal("name = \"dissect\"", "name = \"retract\"").find("two stages are called 'retract'"),
            std::string::npos);
  EXPECT_NE(refusal("kind = \"clip\"", "kind = \"grasp\"").find("kind"), std::string::npos);
  EXPECT_NE(refusal("instrument = \"hook\"", "instrument = \"suction\"").find("instrument"), std::string::npos);
  EXPECT_NE(refusal("metric = \"clip/force_max_n\"", "metric = \"clips/force_max_n\"").find("metric"),
            std::string::npos);
  EXPECT_NE(refusal("[levels.clip]", "[levels.clips]").find("clips"), std::string::npos);
  EXPECT_NE(refusal("places_shown = false", "places_shown = false\nlift_mm = 3").find("lift_mm"), std::string::npos);
}

}  // namespace
}  // namespace trocar::operation_test
