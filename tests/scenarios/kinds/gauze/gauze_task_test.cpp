// The rules of the gauze circle cut against told cuts and pulls, its boards, and what its reader refuses.
#include "scenarios/kinds/gauze/gauze_task.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/gauze/gauze_layout.h"
#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::gauze_task_test {
namespace {

constexpr double kStep_s = 0.01;

Exercise shipped() {
  return load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/gauze-cut.toml");
}

/// A level plate, 200 mm square.
TriangleSurface plate() {
  TriangleSurface out;
  out.vertices = {Vec3(-0.1, -0.1, 0), Vec3(0.1, -0.1, 0), Vec3(0.1, 0.1, 0), Vec3(-0.1, 0.1, 0)};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  return out;
}

Board board_of(const Exercise& exercise, const ExerciseLevel& level, int n) {
  const TriangleSurface organ = plate();
  const Mat3 R_TI_rest = Vec3(1, -1, -1).asDiagonal();  // the shaft points down
  return lay_out_gauze(exercise, level, n, {organ, nullptr, R_TI_rest});
}

/// A told instrument and told cuts; the exercise has begun.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels.front();
  Board board = board_of(exercise, level, 3);
  CutLine line{own_rules<GauzeBoard>(board).line, own_rules<GauzeLevel>(level).off_m};
  Director director{exercise, level, board};
  StylusState stylus;
  TissueFrame frame;

  Bench() {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = board.start_T;
    step(1.2);
  }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
    }
  }
  Vec3 on_gauze(const Eigen::Vector2d& at) const {
    return own_rules<GauzeBoard>(board).middle_T + Vec3(at.x(), at.y(), 0);
  }
  void cut(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    frame.sheet_cut[static_cast<std::size_t>(frame.sheet_cut_count++ % kMaxSheetCutsSeen)] = {0, on_gauze(from),
                                                                                              on_gauze(to)};
    step(kStep_s);
  }
  /// Along the line, so far outside it.
  void cut_along(double from_m, double to_m, double off_m = 0) {
    const double sense = own_rules<GauzeBoard>(board).line.sense;
    const auto at = [&](double arc_m) -> Eigen::Vector2d {
      const LinePlace place = line.at(arc_m);
      return place.at + off_m * sense * Eigen::Vector2d(place.along.y(), -place.along.x());
    };
    for (double arc = from_m; arc < to_m; arc += 0.003) cut(at(arc), at(std::min(arc + 0.003, to_m)));
  }
  double all_m() const { return line.way_in_m() + line.round_m(); }
  long count(EventType type) const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.type == type; });
  }
  std::optional<double> metric(const std::string& name) const {
    const ScoringContext context = scoring_context(exercise, level, board, director.events(), director.outcome());
    Trace trace;  // of an attempt that goes on still
    trace.samples.emplace_back().t_s = stylus.t_s + 1;
    for (const Metric& metric : compute_metrics(trace, director.events(), context))
      if (metric.name == name) return metric.value;
    return std::nullopt;
  }
};

TEST(GauzeTask, AWholeCutOnTheLineIsDoneWithoutAnError) {
  Bench bench;
  bench.cut_along(0, bench.all_m());
  EXPECT_TRUE(bench.director.finished());
  EXPECT_EQ(bench.count(event_type::kTargetHeld), static_cast<long>(bench.board.targets.size()));
  EXPECT_EQ(bench.count(event_type::kOffLine), 0);
  EXPECT_LT(bench.metric("cut_area_share").value_or(1), 0.012);
  EXPECT_EQ(bench.metric("cut_outside_share"), 0.0);
  EXPECT_EQ(bench.metric("hard_pulls"), 0.0);
}

TEST(GauzeTask, NothingIsDoneWithoutCuts) {
  Bench bench;
  bench.step(20);
  EXPECT_EQ(bench.count(event_type::kTargetHeld), 0);
  EXPECT_FALSE(bench.metric("cut_area_share")) << "who cuts nothing has no good cut";
  EXPECT_FALSE(bench.metric("hard_pulls"));
}

TEST(GauzeTask, OutsideTheBandIsAnErrorEachTime) {
  Bench bench;
  bench.cut_along(0, bench.line.way_in_m());
  bench.cut_along(bench.line.way_in_m(), bench.all_m(), 0.0025);
  EXPECT_TRUE(bench.director.finished());
  EXPECT_GT(bench.count(event_type::kOffLine), 30);
  EXPECT_GT(bench.metric("cut_outside_share").value_or(0), 0.95);
  const double exact = (0.0225 * 0.0225 - 0.020 * 0.020) / (0.020 * 0.020);
  EXPECT_NEAR(bench.metric("cut_area_share").value_or(0), exact, 0.02);
}

TEST(GauzeTask, CuttingAgainOnTheLineMendsNothing) {
  Bench bench;
  bench.cut_along(0, bench.line.way_in_m());
  bench.cut_along(bench.line.way_in_m(), bench.line.way_in_m() + 0.030, 0.003);
  ASSERT_GT(bench.metric("cut_area_share").value_or(0), 0.05);
  const auto area = bench.metric("cut_area_share"), outside = bench.metric("cut_outside_share");
  bench.cut_along(bench.line.way_in_m() + 0.003, bench.line.way_in_m() + 0.027);
  EXPECT_EQ(bench.metric("cut_area_share"), area);
  EXPECT_EQ(bench.metric("cut_outside_share"), outside);
}

TEST(GauzeTask, APullIsToldOnceUntilItHasEased) {
  Bench bench;
  bench.cut_along(0, 0.005);
  const auto pull = [&](double n, double seconds) {
    bench.frame.sheet_pull_n = n;
    bench.step(seconds);
  };
  pull(1.7, 1);
  EXPECT_EQ(bench.count(event_type::kPulledHard), 1) << "staying there is one";
  pull(1.4, 1);
  pull(1.7, 0.5);
  EXPECT_EQ(bench.count(event_type::kPulledHard), 1) << "1.4 N is not eased off";
  pull(1.2, 1);
  pull(1.7, 0.5);
  EXPECT_EQ(bench.count(event_type::kPulledHard), 2);
  pull(0, 1);
  EXPECT_EQ(bench.metric("hard_pulls"), 2.0);
}

TEST(GauzeTask, ATearIsCriticalOnce) {
  Bench bench;
  bench.frame.surgery.tears = 1;
  bench.step(0.1);
  bench.frame.surgery.tears = 3;
  bench.step(0.1);
  EXPECT_EQ(bench.count(event_type::kGauzeTorn), 1);
  EXPECT_EQ(bench.metric("critical_events"), 1.0);
}

TEST(GauzeTask, TimeInTheClutchIsTimeAndCutsNothing) {
  Bench bench;
  bench.stylus.clutched = true;
  bench.step(5);
  bench.stylus.clutched = false;
  bench.cut_along(0, bench.all_m());
  ASSERT_TRUE(bench.director.finished());
  EXPECT_GT(bench.metric("time_s").value_or(0), 5);
}

TEST(GauzeTask, WhatIsAskedForLiesAheadOfTheCut) {
  Bench bench;
  const double half = bench.line.way_in_m() + bench.line.round_m() / 2;
  bench.cut_along(0, half);
  const Demand& demand = bench.director.status().demand;
  const LinePlace ahead = bench.line.at(half + 0.00225);
  EXPECT_LT((demand.centre_T - bench.on_gauze(ahead.at)).norm(), 0.0025);
  const Vec3 along(ahead.along.x(), ahead.along.y(), 0);
  EXPECT_LT(std::abs(demand.R_TI.col(0).dot(along)), 0.12) << "the hinge lies across the line";
  EXPECT_EQ(bench.director.status().cue, Cue::kSnip);
}

TEST(GauzeLayout, EveryBoardOfEveryLevelHasItsLineOnTheGauze) {
  const Exercise exercise = shipped();
  for (const ExerciseLevel& level : exercise.levels)
    for (int n = 0; n < 20; ++n) {
      const Board board = board_of(exercise, level, n);
      EXPECT_GE(board.targets.size(), 25u);
      EXPECT_LE(board.targets.size(), 32u);
      const Vec3 shaft_room(0.047, 0.047, 1);
      for (const Target& target : board.targets) {
        EXPECT_LT(std::abs(target.centre_T.x()), shaft_room.x());
        EXPECT_LT(std::abs(target.centre_T.y()), shaft_room.y() + 0.001);
        EXPECT_NEAR(target.centre_T.z(), 0.030, 1e-9) << "so high over what lies beneath";
        EXPECT_NEAR(target.R_TI.determinant(), 1, 1e-9);
        const Vec3 to_port = (level.port_m - target.centre_T).normalized();
        EXPECT_GT(target.normal_T.dot(to_port), 0.999) << "the shaft passes the port";
      }
      // Where the way in begins no clip holds the rim.
      EXPECT_LT(std::abs(board.targets.front().centre_T.x()), 0.015);
    }
}

TEST(GauzeLayout, BoardsDifferInMiddleWayAndSense) {
  const Exercise exercise = shipped();
  int counter_clockwise = 0;
  double least = 1, most = -1;
  for (int n = 0; n < 20; ++n) {
    const Board board = board_of(exercise, exercise.levels.front(), n);
    const GauzeBoard& own = own_rules<GauzeBoard>(board);
    counter_clockwise += own.line.sense > 0;
    least = std::min(least, own.middle_T.x());
    most = std::max(most, own.middle_T.x());
  }
  EXPECT_GT(counter_clockwise, 3);
  EXPECT_LT(counter_clockwise, 17);
  EXPECT_GT(most - least, 0.004);
}

TEST(GauzeReader, NamesLineAndColumnOfWhatContradictsItself) {
  const std::string text = shipped().text;
  const auto refused = [&](const std::string& from, const std::string& to) {
    return test::refusal(test::edited(text, from, to));
  };
  EXPECT_NE(refused("press_n = [0.4, 0.9]", "press_n = [0.9, 0.4]").find("'press_n' must be"), std::string::npos);
  EXPECT_NE(refused("pull_n = 1.6", "pull_n = 0.8").find("'pull_n' must be above"), std::string::npos);
  EXPECT_NE(refused("across_mm = 40", "across_mm = 45").find("'across_mm' must not be above"), std::string::npos);
  EXPECT_NE(refused("long_mm = 40", "long_mm = 90").find("no room"), std::string::npos);
  EXPECT_NE(refused("material = \"gauze\"", "material = \"gauze\"\norgan = \"liver\"").find("must name no 'organ'"),
            std::string::npos);
  EXPECT_NE(refused("tissue = \"normal\"", "tissue = \"still\"").find("bad.toml:"), std::string::npos);
}

}  // namespace
}  // namespace trocar::gauze_task_test
