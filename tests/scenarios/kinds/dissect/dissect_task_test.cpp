// The rules of bleeders and hook against told states: what counts as lifted, divided, safe and sealed, and what tricks
// bring.
#include "scenarios/kinds/dissect/dissect_task.h"

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

namespace trocar::dissect_task_test {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kStrands = kMostStrands, kSpurters = kMostSpurters, kDissectAims = kStrands + kSpurters;  // of E13
constexpr double kHigh = 0.007, kLow = 0.003, kOn = 0.0;  // m of the tip off the organ

Exercise shipped() { return find_exercise("E13", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A told instrument and a told frame; the exercise has begun. Objects lie 12 mm apart along x.
struct Bench {
  Exercise exercise = shipped();
  ExerciseLevel level = exercise.levels.front();
  Director director;
  StylusState stylus;
  TissueFrame frame;
  Trace trace;

  Bench() : director(exercise, level, board()) {
    stylus.loop = LoopState::kActive;
    stylus.X_TI.p = Vec3(0, 0, 0.055);
    frame.tip_gap_m = 0.05;
    step(1.2);
  }
  static Vec3 place(int target) { return {0.012 * target - 0.04, 0, 0}; }
  /// 4 mm beside the board's place: where a vertex of the organ is.
  static Vec3 bleeds_at(int vessel) { return place(kStrands + vessel) + Vec3(0, 0.004, 0); }
  static Board board() {
    Board out;
    out.start_T = Vec3(0, 0, 0.055);
    for (int i = 0; i < kDissectAims; ++i) out.targets.push_back({place(i), Vec3::UnitZ(), 0.003});
    for (int i = 0; i < kStrands; ++i)
      out.ducts_T.push_back({place(i) - Vec3(0, 0.008, 0), place(i) + Vec3(0, 0.008, 0)});
    return out;
  }
  void step(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kStep_s) {
      stylus.t_s += kStep_s;
      director.update(stylus, &frame);
      TraceSample sample;
      sample.t_s = stylus.t_s;
      sample.tip_T = stylus.X_TI.p;
      sample.pedal = stylus.pedal;
      trace.samples.push_back(sample);
    }
  }
  void at(const Vec3& where, double gap_m) {
    stylus.X_TI.p = where;
    frame.tip_gap_m = gap_m;
  }
  void burn(double seconds) {
    stylus.pedal = true;
    step(seconds);
  }
  void let_go() {
    stylus.pedal = false;
    step(0.1);
  }
  void part(int strand, DuctMark::Kind kind = DuctMark::Kind::kCut) {
    frame.duct_mark[static_cast<std::size_t>(frame.duct_mark_count++)] = {.kind = kind, .duct = strand};
    step(kStep_s);
    frame.touched_duct = -1;
  }
  void divide(int strand, double gap_m, double seconds = 1) {
    at(place(strand), gap_m);
    frame.touched_duct = strand;
    burn(seconds);
    part(strand);
    let_go();
  }
  void spurt(double blood_ml = 0) {
    frame.wound_count = kSpurters;
    for (int i = 0; i < kSpurters; ++i) {
      WoundSeen& wound = frame.wound[static_cast<std::size_t>(i)];
      wound.place_T = bleeds_at(i);
      wound.open_vessels = 1;
    }
    frame.surgery.blood_ml = blood_ml;
    step(kStep_s);
  }
  void seal(int vessel, double seconds = 1.5, double blood_ml = 3) {
    at(bleeds_at(vessel), kOn);
    frame.surgery.contact_c = 100;
    burn(seconds);
    frame.surgery.blood_ml = blood_ml;
    frame.wound[static_cast<std::size_t>(vessel)].open_vessels = 0;
    step(kStep_s);
    frame.surgery.contact_c = 0;
    let_go();
  }
  long count(EventType type, Severity severity) const {
    const auto& events = director.events();
    return std::count_if(events.begin(), events.end(),
                         [&](const Event& e) { return e.type == type && e.severity == severity; });
  }
  double metric(const char* name) {
    const auto context = scoring_context(exercise, level, director.board(), director.events(), director.outcome());
    trace.rate_hz = 1 / kStep_s;
    for (const Metric& metric : compute_metrics(trace, director.events(), context))
      if (metric.name == name) return metric.value.value_or(-1);
    return -2;
  }
  Grade grade() {
    const auto context = scoring_context(exercise, level, director.board(), director.events(), director.outcome());
    trace.rate_hz = 1 / kStep_s;
    return grade_metrics(compute_metrics(trace, director.events(), context), level.rubric,
                         {director.outcome(), context.objects_done, context.objects_total});
  }
};

/// A quick run without unsafe current, with so many of the strands lifted.
Grade quick_run(int lifted) {
  Bench bench;
  for (int strand = 0; strand < kStrands; ++strand) bench.divide(strand, strand < lifted ? kHigh : kLow);
  bench.spurt();
  for (int vessel = 0; vessel < kSpurters; ++vessel) bench.seal(vessel, 1.5, 3.0 * (vessel + 1));
  return bench.grade();
}

TEST(DissectTask, IsDoneOnceAllStrandsAreDividedAndAllVesselsSealed) {
  Bench bench;
  EXPECT_EQ(bench.director.status().cue, Cue::kHook);
  for (int strand = 0; strand < kStrands; ++strand) bench.divide(strand, kHigh);
  bench.spurt();
  EXPECT_EQ(bench.director.status().cue, Cue::kSeal);
  for (int vessel = 0; vessel < kSpurters; ++vessel) bench.seal(vessel, 1.5, 3.0 * (vessel + 1));
  EXPECT_EQ(bench.director.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(bench.count(event_type::kStrandLifted, Severity::kInfo), kStrands);
  EXPECT_DOUBLE_EQ(bench.metric("strands_lifted_share"), 1);
  EXPECT_DOUBLE_EQ(bench.metric("safe_energy_share"), 1);
  EXPECT_DOUBLE_EQ(bench.metric("spurted_ml"), 9);
  EXPECT_NEAR(bench.metric("strand_current_s"), 1, 0.03);
  EXPECT_DOUBLE_EQ(bench.metric("sealed_late"), 0);
}

/// Torn, or divided, where no organ is near: an event that held no number would void the attempt.
TEST(DissectTask, AStrandPartedFarFromAnyOrganIsTold) {
  Bench bench;
  bench.divide(0, INFINITY);
  bench.at(bench.place(1), INFINITY);
  bench.part(1, DuctMark::Kind::kTorn);
  EXPECT_EQ(bench.count(event_type::kStrandDivided, Severity::kInfo), 1);
  EXPECT_EQ(bench.count(event_type::kStrandDivided, Severity::kMajor), 1);
  EXPECT_GE(bench.count(event_type::kStrandLifted, Severity::kInfo), 1);
  for (const Event& event : bench.director.events()) EXPECT_TRUE(std::isfinite(event.value)) << event.type;
}

TEST(DissectTask, AStrandDividedTooLowOrTornIsNotLifted) {
  Bench bench;
  bench.divide(0, kLow);
  EXPECT_EQ(bench.count(event_type::kStrandDivided, Severity::kMinor), 1);
  EXPECT_EQ(bench.director.status().message, "Divided too low");
  bench.at(Bench::place(1), kHigh);
  bench.part(1, DuctMark::Kind::kTorn);
  EXPECT_EQ(bench.count(event_type::kStrandDivided, Severity::kMajor), 1);
  EXPECT_EQ(bench.director.status().message, "A strand tore");
  EXPECT_DOUBLE_EQ(bench.metric("strands_lifted_share"), 0);
  EXPECT_EQ(bench.director.status().target_index, 2) << "what is divided is not asked for again";
}

/// Asked for are 6 mm of each of five strands: what one is too low counts by how much, more height buys nothing back,
/// and a torn one brings nothing however high.
TEST(DissectTask, HowFarOffTheOrganAStrandIsDividedCountsByDegrees) {
  Bench bench;
  bench.divide(0, 0.020);
  bench.divide(1, 0.0059);
  bench.divide(2, 0.003);
  EXPECT_NEAR(bench.metric("strand_clearance_share"), (1 + 0.0059 / 0.006 + 0.5) / kStrands, 1e-9);
  bench.at(Bench::place(3), kHigh);
  bench.part(3, DuctMark::Kind::kTorn);
  EXPECT_NEAR(bench.metric("strand_clearance_share"), (1 + 0.0059 / 0.006 + 0.5) / kStrands, 1e-9);
  EXPECT_DOUBLE_EQ(bench.metric("strands_lifted_share"), 1.0 / kStrands);
}

TEST(DissectTask, WhoDividesNearlyAllStrandsTooLowDoesNotPassHoweverQuick) {
  EXPECT_TRUE(quick_run(3).passed);
  for (const int lifted : {0, 1}) {
    const Grade grade = quick_run(lifted);
    EXPECT_FALSE(grade.passed) << lifted;
    EXPECT_LT(grade.score.value_or(100), 59) << lifted;
  }
}

TEST(DissectTask, CurrentNearTheOrganIsUnsafeButForAMoment) {
  Bench bench;
  bench.at(Bench::place(0), 0.001);
  bench.frame.touched_duct = 0;
  bench.burn(0.29);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 0);
  for (int tap = 0; tap < 4; ++tap) {  // taps that are each short enough add up
    bench.burn(0.25);
    bench.let_go();
  }
  EXPECT_GT(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 0);
  bench.divide(0, kHigh);
  EXPECT_NEAR(bench.metric("safe_energy_share"), 1 / (1 + 0.99) / kDissectAims, 0.02);
}

TEST(DissectTask, CurrentOutOfViewIsUnsafe) {
  Bench bench;
  bench.at({0.2, 0, 0.1}, 0.1);
  bench.burn(0.5);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 1);
  EXPECT_EQ(bench.director.status().message, "Current out of view");
}

TEST(DissectTask, CurrentInTheAirOrHeldOnBringsNothing) {
  Bench bench;
  bench.at(Bench::place(0), 0.001);
  bench.burn(1.3);  // 1 s unsafe
  bench.at(Bench::place(0) + Vec3(0, 0, 0.03), 0.03);
  bench.burn(20);
  bench.frame.touched_duct = 0;
  bench.burn(20);
  bench.let_go();
  bench.divide(0, kHigh);
  const double most = own_rules<DissectRules>(bench.exercise).counted_s;
  EXPECT_LE(bench.metric("safe_energy_share"), most / (most + 0.99) / kDissectAims + 1e-3);
  EXPECT_GT(bench.metric("strand_current_s"), 40) << "and it all counts as current";
}

TEST(DissectTask, TheClutchDoesNotHideALiveTip) {
  Bench bench;
  bench.at(Bench::place(0), 0.001);
  bench.stylus.clutched = true;
  bench.burn(2);
  bench.let_go();
  EXPECT_GT(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 0);
}

TEST(DissectTask, TheTipMayTouchBesideTheLitVesselAndNowhereElse) {
  Bench bench;
  for (int strand = 0; strand < kStrands; ++strand) bench.divide(strand, kHigh);
  bench.spurt();
  EXPECT_LT((bench.director.status().demand.centre_T - Bench::bleeds_at(0)).norm(), 1e-9) << "where it bleeds";
  bench.at(Bench::bleeds_at(1), kOn);  // another than the lit one
  bench.burn(1);
  bench.let_go();
  EXPECT_EQ(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 1);
  bench.seal(0);
  EXPECT_EQ(bench.count(event_type::kUnsafeCurrent, Severity::kMinor), 1);
}

TEST(DissectTask, AVesselThatBleedsTooLongIsToldOnceAndStillToBeSealed) {
  Bench bench;
  for (int strand = 0; strand < kStrands; ++strand) bench.divide(strand, kHigh);
  bench.spurt(1);
  bench.at({0, 0, 0.05}, 0.05);
  bench.step(20);
  EXPECT_EQ(bench.count(event_type::kSealedLate, Severity::kMinor), 1) << "only the lit one has a clock";
  EXPECT_EQ(bench.director.status().target_index, kStrands);
  bench.seal(0, 1.5, 12);
  EXPECT_EQ(bench.director.status().target_index, kStrands + 1);
  EXPECT_DOUBLE_EQ(bench.metric("spurted_ml"), 12);
}

TEST(DissectTask, CuttingIntoTheOrganIsCriticalOnce) {
  Bench bench;
  bench.frame.surgery.cut_m2 = 8e-6;
  bench.step(0.1);
  bench.frame.surgery.cut_m2 = 16e-6;
  bench.step(0.1);
  EXPECT_EQ(bench.count(event_type::kPerforated, Severity::kCritical), 1);
}

TEST(DissectTask, NothingIsJudgedBeforeAStrandIsDivided) {
  Bench bench;
  bench.step(5);
  EXPECT_DOUBLE_EQ(bench.metric("safe_energy_share"), -1);
  EXPECT_DOUBLE_EQ(bench.metric("spurted_ml"), -1) << "who stops before it bleeds has no blood to be proud of";
}

TEST(DissectTask, TheGoalLiesOverTheLitStrand) {
  Bench bench;
  const Demand& demand = bench.director.status().demand;
  EXPECT_LT((demand.centre_T - Bench::place(0) - Vec3(0, 0, 0.0045)).norm(), 1e-9);
  EXPECT_GT(demand.goal_T.z(), 0.006);
  EXPECT_EQ(bench.director.status().exposure, 0);
  bench.frame.touched_duct = 0;
  bench.at(Bench::place(0), 0.003);
  bench.step(0.05);
  EXPECT_NEAR(bench.director.status().exposure, 0.5, 1e-9);
}

}  // namespace
}  // namespace trocar::dissect_task_test
