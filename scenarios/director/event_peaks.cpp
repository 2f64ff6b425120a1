#include "scenarios/director/event_peaks.h"

#include <algorithm>

#include "scenarios/director/threshold_monitor.h"

namespace trocar {
namespace {

double grip(const TraceSample& sample) { return sample.grip_n; }
double force(const TraceSample& sample) { return sample.force_T.norm(); }

struct Excursion {
  double (*signal)(const TraceSample&) = nullptr;  ///< nullptr: the event is of no such limit
  double limit_n = 0;
};

/// Of a grip the limit is the block's: the event comes within a tick of it.
Excursion excursion_of(const Event& event, const ScoringContext& context) {
  if (event.type == event_type::kExcessForce && event.severity == Severity::kMajor)
    return {force, context.hard_force_n};
  if (event.type == event_type::kCriticalForce) return {force, context.critical_force_n};
  if (event.type == event_type::kGripExcess) return {grip, event.value};
  return {};
}

}  // namespace

void raise_to_peaks(std::vector<Event>& events, const Trace& trace, const ScoringContext& context) {
  const double dt_s = 1 / trace.rate_hz;
  for (auto event = events.begin(); event != events.end(); ++event) {
    const auto [signal, limit_n] = excursion_of(*event, context);
    if (signal == nullptr) continue;
    const auto next = std::find_if(std::next(event), events.end(), [&event](const Event& later) {
      return later.type == event->type && later.object == event->object;
    });
    auto sample = std::lower_bound(trace.samples.begin(), trace.samples.end(), event->t_s,
                                   [](const TraceSample& s, double t_s) { return s.t_s < t_s; });
    for (double below_s = 0; sample != trace.samples.end() && below_s < kRearmTime; ++sample) {
      if (next != events.end() && sample->t_s >= next->t_s) break;
      const double value = signal(*sample);
      event->value = std::max(event->value, value);
      below_s = value < kRearmShare * limit_n ? below_s + dt_s : 0;
    }
  }
}

}  // namespace trocar
