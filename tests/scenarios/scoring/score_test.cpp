// From metrics to a grade: ramps, weights, caps, and what may never raise a score.
#include "scenarios/scoring/score.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/made_traces.h"

namespace trocar::score_test {
namespace {

constexpr double kEnd = 20;

Rubric rubric_of_e02() {
  Rubric rubric;
  rubric.subscores = {{"time", "time_s", 0.15, 14, 60, false, 0.5},
                      {"place", "wrong_places", 0.20, 0, 6, false, 0.5},
                      {"force in band", "in_band_share", 0.35, 1.0, 0.3, true, 0.5},
                      {"excess force", "excess_events", 0.20, 0, 6, true, 0.5},
                      {"path ratio", "path_ratio", 0.10, 1.0, 2.2, false, 0.5}};
  return rubric;
}

ScoringContext finished_context() {
  ScoringContext context;
  context.outcome = AttemptStatus::kCompleted;
  context.band_low_n = 0.4;
  context.band_high_n = 0.8;
  context.retract_height_m = 0.01;
  context.waypoints = {Vec3(0, 0, 0.05), Vec3::Zero(), Vec3(0.03, 0, 0)};
  context.objects_total = context.objects_done = 3;
  return context;
}

/// A good, not perfect, run: two targets held, a path somewhat longer than ideal.
Trace good_trace() {
  Trace trace = made_trace(kEnd, [](double t) {
    return Vec3(0.03 * std::clamp((t - 6) / 6, 0.0, 1.0), 0.008 * std::sin(t), std::max(0.0, 0.05 - 0.025 * t));
  });
  press(trace, 4, 4.3, 0.3);
  press(trace, 4.3, 4.4, 0.9);
  press(trace, 4.4, 5.4, 0.6);
  press(trace, 14, 15, 0.6);
  return trace;
}

std::vector<Event> good_events() {
  return whole_run(kEnd, {made_event(4, "TARGET_TOUCHED", 0), made_event(5.4, "TARGET_HELD", 0),
                          made_event(14, "TARGET_TOUCHED", 1), made_event(15, "TARGET_HELD", 1)});
}

std::vector<Event> with(std::vector<Event> events, const Event& extra) {
  const auto later = std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.t_s > extra.t_s; });
  events.insert(later, extra);
  return events;
}

Grade graded(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context) {
  return score_attempt(trace, events, rubric_of_e02(), context);
}

Grade good_grade() { return graded(good_trace(), good_events(), finished_context()); }

TEST(Ramp, RunsBetweenItsAnchorsInBothDirections) {
  const SubscoreRule low{"", "", 1, 2, 6, false, 0.5}, high{"", "", 1, 1, 0.3, false, 0.5};
  EXPECT_DOUBLE_EQ(subscore_value(low, 1.0), 1);
  EXPECT_DOUBLE_EQ(subscore_value(low, 4.0), 0.5);
  EXPECT_DOUBLE_EQ(subscore_value(low, 9.0), 0);
  EXPECT_DOUBLE_EQ(subscore_value(high, 0.65), 0.5);
  EXPECT_DOUBLE_EQ(subscore_value(high, 0.1), 0);
  EXPECT_DOUBLE_EQ(subscore_value(high, std::nullopt), 0);
  EXPECT_DOUBLE_EQ(subscore_value(high, std::nan("")), 0);
}

TEST(Ramp, WorseningTheMetricNeverRaisesTheSubscore) {
  for (const SubscoreRule& rule : rubric_of_e02().subscores) {
    const double towards_worse = rule.zero_at > rule.full_at ? 1 : -1;
    double before = 1;
    for (int i = -50; i < 250; ++i) {
      const double x = rule.full_at + towards_worse * i * std::abs(rule.zero_at - rule.full_at) / 100;
      const double now = subscore_value(rule, x);
      EXPECT_LE(now, before) << rule.name << " at " << x;
      before = now;
    }
    EXPECT_EQ(before, 0) << rule.name;
  }
}

TEST(Score, IsTheWeightedSumOfItsSubscores) {
  const Grade grade = good_grade();
  ASSERT_TRUE(grade.score);
  double sum = 0, weights = 0;
  for (const Subscore& s : grade.subscores) {
    ASSERT_TRUE(s.raw) << s.name;
    EXPECT_NEAR(s.value, std::clamp((*s.raw - s.zero_at) / (s.full_at - s.zero_at), 0.0, 1.0), 1e-12) << s.name;
    sum += 100 * s.weight * s.value;
    weights += s.weight;
  }
  EXPECT_NEAR(*grade.score, sum, 1e-9);
  EXPECT_NEAR(weights, 1, 1e-12);
  EXPECT_TRUE(grade.passed);
  EXPECT_TRUE(grade.caps.empty());
  EXPECT_LT(*grade.score, 100);
}

TEST(Score, NamesTheGradeByItsThresholds) {
  Rubric rubric = rubric_of_e02();
  const double score = *good_grade().score;
  const auto name_with = [&](double pass, double proficient, double expert) {
    rubric.pass_at = pass;
    rubric.proficient_at = proficient;
    rubric.expert_at = expert;
    return score_attempt(good_trace(), good_events(), rubric, finished_context()).grade;
  };
  EXPECT_EQ(name_with(10, 20, score), "expert");
  EXPECT_EQ(name_with(10, score, score + 0.1), "proficient");
  EXPECT_EQ(name_with(score, score + 0.1, score + 0.2), "pass");
  EXPECT_EQ(name_with(score + 0.1, 99, 100), "below pass");
}

TEST(Caps, CriticalEventHoldsAnyRunAtFortyNine) {
  const auto events = with(good_events(), made_event(9, "CRITICAL_FORCE", 0, Severity::kCritical));
  const Grade grade = graded(good_trace(), events, finished_context());
  EXPECT_DOUBLE_EQ(*grade.score, 49);
  EXPECT_FALSE(grade.passed);
  EXPECT_EQ(grade.grade, "below pass");
  EXPECT_EQ(grade.caps, (std::vector<Cap>{{.kind = CapKind::kCritical, .at_most = 49}}));
}

TEST(Caps, FailedGateHoldsAtFiftyNine) {
  auto events = good_events();
  for (int i = 0; i < 4; ++i) events = with(events, made_event(7 + i, "EXCESS_FORCE", 1, Severity::kMajor));
  const Grade grade = graded(good_trace(), events, finished_context());
  EXPECT_DOUBLE_EQ(*grade.score, 59);
  EXPECT_FALSE(grade.passed);
  EXPECT_EQ(grade.caps,
            (std::vector<Cap>{{.kind = CapKind::kGate, .subject = "excess force", .below = 0.5, .at_most = 59}}));
}

TEST(Caps, ScaledTheyKeepWhoIsBetter) {
  Rubric scaled = rubric_of_e02();
  scaled.caps_scale = true;
  const auto danger = made_event(9, "CRITICAL_FORCE", 0, Severity::kCritical);
  const auto scored = [&](const std::vector<Event>& events) {
    return *score_attempt(good_trace(), events, scaled, finished_context()).score;
  };
  const double free = scored(good_events()), once = scored(with(good_events(), danger));
  EXPECT_DOUBLE_EQ(once, 0.49 * free);
  const double worse = scored(with(with(good_events(), made_event(8, "WRONG_PLACE", 1, Severity::kMinor)), danger));
  EXPECT_LT(worse, once) << "cut off, both would score 49";
  EXPECT_GT(worse, 0.9 * once);
  auto both = with(good_events(), danger);
  for (int i = 0; i < 4; ++i) both = with(both, made_event(7 + i, "EXCESS_FORCE", 1, Severity::kMajor));
  const Grade grade = score_attempt(good_trace(), both, scaled, finished_context());
  EXPECT_EQ(grade.caps.size(), 2u);
  EXPECT_LT(*grade.score, once) << "the lower of two caps holds, of a score that is lower too";
}

TEST(Caps, UnfinishedRunsEarnAtMostTheirShare) {
  ScoringContext context = finished_context();
  context.outcome = AttemptStatus::kTimeout;
  auto events = good_events();
  events.back().type = "TIMEOUT";
  context.objects_done = 1;
  EXPECT_NEAR(*graded(good_trace(), events, context).score, 49.0 / 3, 1e-12);
  EXPECT_EQ(graded(good_trace(), events, context).caps.back(),
            (Cap{.kind = CapKind::kUnfinished, .done = 1, .total = 3, .at_most = 49.0 / 3}));
  context.objects_done = 0;
  EXPECT_EQ(*graded(good_trace(), events, context).score, 0);
  context.objects_done = 3;
  EXPECT_DOUBLE_EQ(*graded(good_trace(), events, context).score, 49) << "all done but not finished";
}

TEST(Caps, SayInASentenceWhatTheyHeldDown) {
  EXPECT_EQ(cap_sentence({.kind = CapKind::kGate, .subject = "force in band", .below = 0.5, .at_most = 59}),
            "safety: force in band below 0.5: at most 59");
  EXPECT_EQ(cap_sentence({.kind = CapKind::kCritical, .at_most = 49}), "critical event: at most 49");
  EXPECT_EQ(cap_sentence({.kind = CapKind::kUnfinished, .done = 7, .total = 12, .at_most = 49.0 * 7 / 12}),
            "not finished: 7 of 12: at most 28.5833");
  EXPECT_EQ(cap_sentence({.kind = CapKind::kVoid, .subject = "no samples"}), "void: no samples");
}

TEST(Caps, DroppingThemWouldLetDangerPass) {
  Rubric uncapped = rubric_of_e02();
  uncapped.critical_cap = uncapped.gate_cap = 100;
  const auto events = with(good_events(), made_event(9, "CRITICAL_FORCE", 0, Severity::kCritical));
  EXPECT_GT(*score_attempt(good_trace(), events, uncapped, finished_context()).score, 75);
}

TEST(Outcome, AbortedAndFaultCarryNoNumber) {
  for (const AttemptStatus outcome : {AttemptStatus::kAborted, AttemptStatus::kFault, AttemptStatus::kVoid}) {
    ScoringContext context = finished_context();
    context.outcome = outcome;
    const Grade grade = graded(good_trace(), good_events(), context);
    EXPECT_EQ(grade.status, outcome);
    EXPECT_FALSE(grade.score);
    EXPECT_FALSE(grade.passed);
    EXPECT_EQ(grade.grade, "not graded");
  }
}

TEST(Outcome, BrokenTraceIsVoidWithItsReason) {
  const std::vector<std::pair<std::string, std::function<void(Trace&)>>> breaks = {
      {"not finite", [](Trace& t) { t.samples[500].tip_T.x() = std::nan(""); }},
      {"jumps", [](Trace& t) { t.samples[500].tip_T.x() += 0.2; }},
      {"time", [](Trace& t) { t.samples[500].t_s = t.samples[400].t_s; }},
      {"missing", [](Trace& t) { t.samples.erase(t.samples.begin() + 100, t.samples.begin() + 500); }},
      {"no samples", [](Trace& t) { t.samples.clear(); }}};
  for (const auto& [reason, apply] : breaks) {
    Trace trace = good_trace();
    apply(trace);
    const Grade grade = graded(trace, good_events(), finished_context());
    EXPECT_EQ(grade.status, AttemptStatus::kVoid) << reason;
    EXPECT_FALSE(grade.score) << reason;
    ASSERT_EQ(grade.caps.size(), 1u) << reason;
    EXPECT_EQ(grade.caps[0].kind, CapKind::kVoid);
    EXPECT_NE(grade.caps[0].subject.find(reason), std::string::npos) << grade.caps[0].subject;
  }
}

TEST(Outcome, CompletionWithoutAStartIsVoid) {
  auto events = good_events();
  events.erase(events.begin());
  EXPECT_EQ(graded(good_trace(), events, finished_context()).status, AttemptStatus::kVoid);
}

TEST(Metamorphic, AddingAnErrorEventNeverRaisesTheScore) {
  const std::vector<std::pair<std::string, Severity>> errors = {{"WRONG_PLACE", Severity::kMinor},
                                                                {"EXCESS_FORCE", Severity::kMajor},
                                                                {"GRIP_EXCESS", Severity::kMajor},
                                                                {"CRITICAL_FORCE", Severity::kCritical},
                                                                {"TOOL_COLLISION", Severity::kMinor}};
  for (const auto& [type, severity] : errors) {
    auto events = good_events();
    double before = *good_grade().score;
    for (int i = 0; i < 8; ++i) {
      events = with(events, made_event(1 + 2 * i, type, 0, severity));
      const double now = *graded(good_trace(), events, finished_context()).score;
      EXPECT_LE(now, before) << type << " number " << i + 1;
      before = now;
    }
  }
}

TEST(Metamorphic, TouchingAHeldTargetAgainGainsNothing) {
  auto events = good_events();
  for (int i = 0; i < 5; ++i) {
    events = with(events, made_event(7 + i, "TARGET_TOUCHED", 0));
    events = with(events, made_event(7.5 + i, "TARGET_HELD", 0));
  }
  EXPECT_LE(*graded(good_trace(), events, finished_context()).score, *good_grade().score);
}

TEST(Metamorphic, IdleTimeNeverRaisesTheScore) {
  for (const double pause_at : {2.0, 4.35, 8.0, 17.0}) {
    double before = *good_grade().score;
    for (const double pause : {1.0, 5.0, 20.0}) {
      Trace trace;
      for (const TraceSample& sample : good_trace().samples) {
        if (sample.t_s > pause_at && (trace.samples.empty() || trace.samples.back().t_s <= pause_at)) {
          TraceSample resting = trace.samples.back();
          for (int i = 1; i <= static_cast<int>(pause * 1000); ++i) {
            resting.t_s = pause_at + i * 1e-3;
            trace.samples.push_back(resting);
          }
        }
        trace.samples.push_back(sample);
        if (sample.t_s > pause_at) trace.samples.back().t_s += pause;
      }
      auto events = good_events();
      for (Event& event : events)
        if (event.t_s > pause_at) event.t_s += pause;
      const Grade grade = graded(trace, events, finished_context());
      ASSERT_TRUE(grade.score) << cap_sentence(grade.caps.at(0));
      EXPECT_LE(*grade.score, before + 1e-9) << pause << " s at " << pause_at;
      before = *grade.score;
    }
  }
}

TEST(Determinism, SameInputSameBits) {
  const Grade one = good_grade(), two = good_grade();
  EXPECT_EQ(*one.score, *two.score);
  for (std::size_t i = 0; i < one.metrics.size(); ++i) EXPECT_EQ(one.metrics[i].value, two.metrics[i].value);
}

}  // namespace
}  // namespace trocar::score_test
