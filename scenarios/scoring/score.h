// Trace and events in, grade out: sub-scores, total, caps, grade. The only place where a score is made.
//
// s_k = clamp((x - zero_at) / (full_at - zero_at), 0, 1), S = 100 sum w_k s_k, then the caps (docs/scoring.md):
//   a gate below its floor            S <= rubric.gate_cap
//   an event of critical severity     S <= rubric.critical_cap
//   not finished                      S <= rubric.unfinished_cap * objects done / objects
// Aborted, fault and void attempts carry no number. Pure: live scoring and regrading agree to the bit.
#pragma once

#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/rubric.h"
#include "scenarios/scoring/scoring_context.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// Value of one linear ramp, 0..1; 0 for an undefined metric.
double subscore_value(const SubscoreRule& rule, const std::optional<double>& metric);

Grade score_attempt(const Trace& trace, const std::vector<Event>& events, const Rubric& rubric,
                    const ScoringContext& context);

/// What the caps ask of an attempt beside its metrics.
struct AttemptEnd {
  AttemptStatus outcome = AttemptStatus::kCompleted;  ///< or timeout: others carry no number
  int objects_done = 0, objects_total = 0;
};

/// Grade of metrics that are known already, so that another rubric needs neither trace nor another run.
Grade grade_metrics(std::vector<Metric> metrics, const Rubric& rubric, const AttemptEnd& end);

/// Not to be graded: no number, and the reason among the caps.
Grade void_grade(const std::string& reason);

}  // namespace trocar
