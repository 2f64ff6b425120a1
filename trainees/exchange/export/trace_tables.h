// Trace and events of an attempt as CSV (csv.h), numbers to the bit: what a score is made from. docs/exports.md says
// how another program makes it again. Pure. Thread: any.
#pragma once

#include <ostream>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

/// A line a tick: time, tip and shaft in T, virtual force, what the device was asked and gave, grip, jaws, flags.
void write_trace_csv(const Trace& trace, std::ostream& out);
/// A line an event, in order.
void write_events_csv(const std::vector<Event>& events, std::ostream& out);

}  // namespace trocar
