// Traces and events made by formula, for scoring tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenarios/scoring/metrics.h"

namespace trocar {

/// Trace at 1 kHz of a tip that moves as `position(t)`, from 0 to `seconds`.
inline Trace made_trace(double seconds, const std::function<Vec3(double)>& position, double rate_hz = 1000) {
  Trace trace;
  trace.rate_hz = rate_hz;
  const int ticks = static_cast<int>(seconds * rate_hz + 0.5);
  for (int i = 0; i <= ticks; ++i) {
    TraceSample sample;
    sample.t_s = i / rate_hz;
    sample.tip_T = position(sample.t_s);
    sample.shaft_T = -Vec3::UnitZ();
    trace.samples.push_back(sample);
  }
  return trace;
}

/// Sets the contact force (along z) of samples from `from` up to, not including, `to`.
inline void press(Trace& trace, double from, double to, double force_n) {
  for (TraceSample& sample : trace.samples) {
    if (sample.t_s < from || sample.t_s >= to) continue;
    sample.force_T = Vec3(0, 0, force_n);
    sample.contact = force_n > 0;
  }
}

inline Event made_event(double t_s, const std::string& type, std::int32_t object = -1,
                        Severity severity = Severity::kInfo) {
  Event event;
  event.t_s = t_s;
  event.type = type;
  event.object = object;
  event.severity = severity;
  return event;
}

/// START at 0 and DONE at `end`, with others between in order of time.
inline std::vector<Event> whole_run(double end, std::vector<Event> others = {}) {
  std::vector<Event> events = {made_event(0, "START")};
  events.insert(events.end(), others.begin(), others.end());
  events.push_back(made_event(end, "DONE"));
  return events;
}

inline std::optional<double> value_of(const std::vector<Metric>& metrics, const std::string& name) {
  for (const Metric& metric : metrics) {
    if (metric.name == name) return metric.value;
  }
  ADD_FAILURE() << "no metric " << name;
  return std::nullopt;
}

}  // namespace trocar
