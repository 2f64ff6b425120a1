// The head of a report: verdict, the ONE main reason, and what to try next. Safety before accuracy, time last.
//
// Thread: any.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"

namespace trocar {

struct Verdict {
  enum class Kind { kPass, kNotYet, kNotGraded } kind = Kind::kNotGraded;
  std::string headline;  ///< "PASS", "NOT YET", "NOT GRADED"
  std::string reason;    ///< one sentence
  std::string advice;    ///< "Try next: ..."; empty when there is nothing to say
};

/// @param pass_mark score that passes, 0..100.
Verdict judge(const AttemptResult& result, double pass_mark);

/// Points (0..100 scale) that a sub-score cost: 100 * weight * (1 - value).
double points_lost(const Subscore& subscore);

/// Sub-scores in the order of the report: gates first, time last, otherwise by points lost.
std::vector<Subscore> in_report_order(std::vector<Subscore> subscores);

}  // namespace trocar
