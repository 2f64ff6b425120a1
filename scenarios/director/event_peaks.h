// Events of force say how far it went: the largest value of their excursion, not the one at which it crossed the limit.
//
// The director logs an event when a limit is crossed, and a recording keeps that. What an attempt is judged and shown
// by takes the rest from the trace. Pure. Thread: any.
#pragma once

#include <vector>

#include "scenarios/scoring/scoring_context.h"

namespace trocar {

/// Raises the value of EXCESS_FORCE of the limits watch, CRITICAL_FORCE and GRIP_EXCESS to the peak, N, between the
/// event and the moment in which the limit could be crossed anew: 0.2 s below 0.8 of it, or the next such event of the
/// same object. Counts, times and severities stay. @param trace at its full rate; without samples nothing changes.
void raise_to_peaks(std::vector<Event>& events, const Trace& trace, const ScoringContext& context);

}  // namespace trocar
