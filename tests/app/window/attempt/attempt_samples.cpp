#include "tests/app/window/attempt/attempt_samples.h"

#include <algorithm>
#include <cmath>

#include "app/window/attempt/metric_words.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"

namespace trocar::testing_support {
namespace {

constexpr double kStart_s = 2, kPress_s = 1.6;
constexpr int kDiscs = 12;

/// Second at which disc k is first pressed.
double press_at(int k, double length_s) { return kStart_s + 1 + k * (length_s - 12) / kDiscs; }

double pressed_n(double t, double length_s) {
  for (int k = 0; k < kDiscs; ++k) {
    const double since = t - press_at(k, length_s);
    if (since < 0 || since > kPress_s) continue;
    const double wanted = k == 3 ? 1.8 : 0.6;
    return wanted * std::min({1.0, since / 0.2, (kPress_s - since) / 0.2}) + 0.05 * std::sin(40 * since);
  }
  return 0;
}

}  // namespace

Exercise shipped_exercise(const std::string& id) {
  return find_exercise(id, std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios" / "exercises");
}

AttemptResult graded(const Exercise& exercise, const std::string& level_name,
                     const std::map<std::string, double>& changed) {
  const ExerciseLevel& level = *level_named(exercise, level_name);
  AttemptResult result;
  result.uuid = "0000-this";
  result.exercise_id = exercise.id;
  result.exercise_version = exercise.version;
  result.level = level_name;
  result.board = 4;
  result.trainee = "T-1";
  result.hand = "mouse";
  result.started_utc = "2026-03-01T09:30:00Z";
  result.rubric_sha256 = exercise.rubric.sha256;
  Grade& grade = result.grade;
  grade.status = AttemptStatus::kCompleted;
  double score = 0;
  for (const SubscoreRule& rule : level.rubric.subscores) {
    const auto at = changed.find(rule.metric);
    std::optional<double> raw = at == changed.end() ? rule.full_at : at->second;
    if (std::isnan(*raw)) raw.reset();
    const double share = raw ? std::clamp((*raw - rule.zero_at) / (rule.full_at - rule.zero_at), 0.0, 1.0) : 0;
    const std::string unit(find_metric(rule.metric)->unit);
    grade.subscores.push_back({rule.name, share, rule.weight, raw, unit, rule.full_at, rule.zero_at, rule.gate});
    grade.metrics.push_back({rule.metric, raw, unit});
    score += 100 * rule.weight * share;
  }
  grade.score = score;
  grade.passed = score >= level.rubric.pass_at;
  grade.grade = grade.passed ? "pass" : "below pass";
  return result;
}

void put_caps(AttemptResult& result, const Exercise& exercise, int done, int total) {
  const Rubric& rubric = level_named(exercise, result.level)->rubric;
  Grade& grade = result.grade;
  const auto apply = [&](const Cap& cap) {
    grade.score = std::min(*grade.score, cap.at_most);
    grade.caps.push_back(cap);
    grade.passed = false;
    grade.grade = "below pass";
  };
  for (const Subscore& s : grade.subscores)
    if (s.gate && s.value < 0.5)
      apply({.kind = CapKind::kGate, .subject = s.name, .below = 0.5, .at_most = rubric.gate_cap});
  for (const Event& e : result.events)
    if (e.severity == Severity::kCritical) apply({.kind = CapKind::kCritical, .at_most = rubric.critical_cap});
  if (done >= 0)
    apply(
        {.kind = CapKind::kUnfinished, .done = done, .total = total, .at_most = rubric.unfinished_cap * done / total});
}

Event event(double t_s, const std::string& type, Severity severity, double value, const std::string& unit) {
  return {t_s, type, severity, -1, value, unit, Vec3::Zero()};
}

Trace pressing_trace(double length_s) {
  Trace trace;
  const auto count = static_cast<int>(1000 * length_s);
  for (int i = 0; i < count; ++i) {
    TraceSample sample;
    sample.t_s = 1e-3 * i;
    sample.tip_T = 0.04 * Vec3(std::sin(0.8 * sample.t_s), std::cos(0.5 * sample.t_s), 0);
    sample.force_T = Vec3(0, 0, pressed_n(sample.t_s, length_s));
    sample.contact = sample.force_T.z() > 0;
    if (sample.t_s > length_s - 8) sample.grip_n = std::clamp((sample.t_s - length_s + 8) / 2, 0.0, 0.95);
    trace.samples.push_back(sample);
  }
  return trace;
}

std::vector<Event> pressing_events(double length_s) {
  std::vector<Event> events{event(kStart_s, "START")};
  for (int k = 0; k < kDiscs; ++k) {
    const double t = press_at(k, length_s);
    if (k == 7) events.push_back(event(t - 0.6, "WRONG_PLACE", Severity::kMinor, 0.004, "m"));
    events.push_back(event(t, "TARGET_TOUCHED"));
    if (k == 3) events.push_back(event(t + 0.3, "EXCESS_FORCE", Severity::kMajor, 1.6, "N"));
    events.push_back(event(t + 1.3, "TARGET_HELD"));
  }
  events.push_back(event(length_s - 4, "GRIP_HELD"));
  events.push_back(event(length_s - 1, "DONE"));
  return events;
}

PastAttempt past_run(const AttemptResult& like, int n, double score, bool passed,
                     const std::map<std::string, double>& metrics) {
  PastAttempt out = past_attempt(like);
  out.summary.uuid = "past-" + std::to_string(n);
  out.summary.board = n;
  out.summary.status = "completed";
  out.summary.score = score;
  out.summary.passed = passed;
  for (const auto& [name, value] : metrics) out.metrics[name] = value;
  return out;
}

}  // namespace trocar::testing_support
