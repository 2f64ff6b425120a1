#include "scenarios/scoring/score.h"

#include <algorithm>
#include <cmath>

#include "scenarios/scoring/integrity.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

const Metric* metric_named(const std::vector<Metric>& metrics, const std::string& name) {
  const auto it = std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == name; });
  return it == metrics.end() ? nullptr : &*it;
}

/// Writes down a cap and holds the score down to what it leaves. It is listed even when the score lies below already.
void apply_cap(Grade& grade, const Cap& cap, double left) {
  grade.score = std::min(*grade.score, left);
  grade.caps.push_back(cap);
}

void apply_caps(Grade& grade, const Rubric& rubric, const AttemptEnd& end) {
  const double uncapped = *grade.score;
  const auto danger = [&](const Cap& cap) {
    apply_cap(grade, cap, rubric.caps_scale ? uncapped * cap.at_most / 100 : cap.at_most);
  };
  for (std::size_t k = 0; k < rubric.subscores.size(); ++k) {
    const SubscoreRule& rule = rubric.subscores[k];
    if (rule.gate && grade.subscores[k].value < rule.gate_below)
      danger({.kind = CapKind::kGate, .subject = rule.name, .below = rule.gate_below, .at_most = rubric.gate_cap});
  }
  const Metric* critical = metric_named(grade.metrics, "critical_events");
  if (critical && critical->value.value_or(0) > 0) danger({.kind = CapKind::kCritical, .at_most = rubric.critical_cap});
  // An attempt may also end with something undone: a lost object cannot be fetched back.
  const bool undone = end.objects_done < end.objects_total;
  if (end.outcome != AttemptStatus::kTimeout && !undone) return;
  const double share = end.objects_total > 0 ? 1.0 * end.objects_done / end.objects_total : 0;
  const double at_most = rubric.unfinished_cap * std::clamp(share, 0.0, 1.0);
  apply_cap(grade,
            {.kind = CapKind::kUnfinished, .done = end.objects_done, .total = end.objects_total, .at_most = at_most},
            at_most);
}

std::string grade_name(double score, const Rubric& rubric) {
  if (score >= rubric.expert_at) return "expert";
  if (score >= rubric.proficient_at) return "proficient";
  return score >= rubric.pass_at ? "pass" : "below pass";
}

}  // namespace

Grade void_grade(const std::string& reason) {
  Grade grade;
  grade.status = AttemptStatus::kVoid;
  grade.grade = "not graded";
  grade.caps.push_back({.kind = CapKind::kVoid, .subject = reason});
  return grade;
}

double subscore_value(const SubscoreRule& rule, const std::optional<double>& metric) {
  if (!metric || !std::isfinite(*metric)) return 0;
  return std::clamp((*metric - rule.zero_at) / (rule.full_at - rule.zero_at), 0.0, 1.0) + 0.0;  // -0 becomes 0
}

Grade score_attempt(const Trace& trace, const std::vector<Event>& events, const Rubric& rubric,
                    const ScoringContext& context) {
  Grade grade;
  grade.status = context.outcome;
  grade.grade = "not graded";
  if (context.outcome != AttemptStatus::kCompleted && context.outcome != AttemptStatus::kTimeout) {
    if (integrity_fault(trace, events).empty()) grade.metrics = compute_metrics(trace, events, context);
    return grade;
  }
  if (const std::string fault = integrity_fault(trace, events); !fault.empty()) return void_grade(fault);
  if (context.outcome == AttemptStatus::kCompleted && !graded_window(trace, events))
    return void_grade("completed without a START event");

  return grade_metrics(compute_metrics(trace, events, context), rubric,
                       {context.outcome, context.objects_done, context.objects_total});
}

Grade grade_metrics(std::vector<Metric> metrics, const Rubric& rubric, const AttemptEnd& end) {
  Grade grade;
  grade.status = end.outcome;
  grade.metrics = std::move(metrics);
  double total = 0;
  for (const SubscoreRule& rule : rubric.subscores) {
    const Metric* metric = metric_named(grade.metrics, rule.metric);
    const std::optional<double> raw = metric ? metric->value : std::nullopt;
    const double value = subscore_value(rule, raw);
    total += rule.weight * value;
    grade.subscores.push_back(
        {rule.name, value, rule.weight, raw, metric ? metric->unit : "", rule.full_at, rule.zero_at, rule.gate});
  }
  grade.score = 100 * total;
  apply_caps(grade, rubric, end);
  grade.passed = grade.caps.empty() && end.outcome == AttemptStatus::kCompleted && *grade.score >= rubric.pass_at;
  grade.grade = grade.caps.empty() ? grade_name(*grade.score, rubric) : "below pass";
  return grade;
}

}  // namespace trocar
