// Is this record fit to be graded at all? A broken trace is void: it carries no number, only the reason.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

inline constexpr double kMaxTipSpeed = 50;        ///< m/s: 50 mm in one millisecond
inline constexpr double kMaxMissingShare = 0.01;  ///< of the expected ticks

/// Reason why trace and events cannot be graded, or "" when they can: a NaN or infinity, a tip step above
/// kMaxTipSpeed, time that does not increase, more than kMaxMissingShare of the ticks missing, events that are not in
/// order or not finite, no sample at all.
std::string integrity_fault(const Trace& trace, const std::vector<Event>& events);

}  // namespace trocar
