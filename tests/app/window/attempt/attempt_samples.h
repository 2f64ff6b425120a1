// Attempts as a grader would leave them, from metric values alone, and a trace of a hand that presses on discs.
// Seedless: same bytes.
#pragma once

#include <map>
#include <string>

#include "scenarios/exercise.h"
#include "scenarios/scoring/attempt_result.h"
#include "trainees/progress/past_attempts.h"

namespace trocar::testing_support {

/// The exercise of the source tree.
Exercise shipped_exercise(const std::string& id);

/// Values that earn full marks everywhere but where `changed` says otherwise; NaN stands for a metric without a value.
AttemptResult graded(const Exercise& exercise, const std::string& level,
                     const std::map<std::string, double>& changed = {});
/// The caps of a rubric put on: gates below their floor, then what is given.
void put_caps(AttemptResult& result, const Exercise& exercise, int done = -1, int total = 12);

Event event(double t_s, const std::string& type, Severity severity = Severity::kInfo, double value = 0,
            const std::string& unit = "");

/// Twelve presses of a second each, the fourth one too hard, then a squeeze; with its events. START at 2 s.
Trace pressing_trace(double length_s = 60);
std::vector<Event> pressing_events(double length_s = 60);

/// The same attempt in the past: `score`, passed or not.
PastAttempt past_run(const AttemptResult& like, int n, double score, bool passed,
                     const std::map<std::string, double>& metrics = {});

}  // namespace trocar::testing_support
