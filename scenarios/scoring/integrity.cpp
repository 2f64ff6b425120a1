#include "scenarios/scoring/integrity.h"

#include <cmath>
#include <sstream>

namespace trocar {
namespace {

bool finite(const TraceSample& sample) {
  return std::isfinite(sample.t_s) && sample.tip_T.allFinite() && sample.shaft_T.allFinite() &&
         sample.force_T.allFinite() && std::isfinite(sample.rendered_n) && std::isfinite(sample.grip_n) &&
         std::isfinite(sample.jaw_opening_m);
}

std::string at(const char* what, std::size_t index, double t_s) {
  std::ostringstream text;
  text << what << " at sample " << index << " (t = " << t_s << " s)";
  return text.str();
}

std::string event_fault(const std::vector<Event>& events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    if (!std::isfinite(event.t_s) || !std::isfinite(event.value) || !event.tip_T.allFinite())
      return "event " + std::to_string(i) + " (" + event.type + ") is not finite";
    if (i > 0 && event.t_s < events[i - 1].t_s)
      return "event " + std::to_string(i) + " (" + event.type + ") is earlier than the one before it";
  }
  return "";
}

}  // namespace

std::string integrity_fault(const Trace& trace, const std::vector<Event>& events) {
  if (trace.samples.empty()) return "the trace has no samples";
  if (!(trace.rate_hz > 0) || !std::isfinite(trace.rate_hz)) return "the trace has no valid rate";
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    const TraceSample& sample = trace.samples[i];
    if (!finite(sample)) return at("value that is not finite", i, sample.t_s);
    if (i == 0) continue;
    const TraceSample& before = trace.samples[i - 1];
    const double dt = sample.t_s - before.t_s;
    if (dt <= 0) return at("time does not increase", i, sample.t_s);
    const double step = (sample.tip_T - before.tip_T).norm();
    if (step > kMaxTipSpeed * dt * (1 + 1e-9)) return at("the tip jumps", i, sample.t_s);
  }
  const double span = trace.samples.back().t_s - trace.samples.front().t_s;
  const double expected = std::round(span * trace.rate_hz) + 1;
  const double missing = expected - static_cast<double>(trace.samples.size());
  if (missing > kMaxMissingShare * expected) {
    std::ostringstream text;
    text << missing << " of " << expected << " ticks are missing";
    return text.str();
  }
  return event_fault(events);
}

}  // namespace trocar
