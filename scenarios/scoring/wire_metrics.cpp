#include <algorithm>
#include <numbers>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

int number_of(const std::vector<Event>& events, EventType type) {
  return static_cast<int>(
      std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.type == type; }));
}

/// Gate by gate and against a fixed time, so that staying at a gate without touching buys nothing back.
std::optional<double> touch_share(const std::vector<TraceSample>& samples, const std::vector<Event>& events,
                                  double unhurried_s) {
  if (samples.size() < 2 || unhurried_s <= 0) return std::nullopt;
  double sum = 0;
  int gates = 0;
  std::size_t sample = 1;
  for (auto lit = events.begin(); lit != events.end(); ++lit) {
    if (lit->type != event_type::kTargetLit) continue;
    const auto next =
        std::find_if(lit + 1, events.end(), [](const Event& e) { return e.type == event_type::kTargetLit; });
    const double to_s = next == events.end() ? samples.back().t_s : next->t_s;
    double touching = 0;
    for (; sample < samples.size() && samples[sample].t_s <= to_s; ++sample)
      if (samples[sample].contact && samples[sample].t_s > lit->t_s)
        touching += samples[sample].t_s - samples[sample - 1].t_s;
    sum += std::min(1.0, touching / unhurried_s);
    ++gates;
  }
  return gates > 0 ? std::optional<double>(sum / gates) : std::nullopt;
}

std::optional<double> mean_angle_deg(const std::vector<Event>& events) {
  double sum = 0;
  for (const Event& event : events) sum += event.type == event_type::kAngleError ? event.value : 0;
  const int gates = number_of(events, event_type::kAngleError);
  return gates > 0 ? std::optional<double>(sum / gates * 180 / std::numbers::pi) : std::nullopt;
}

}  // namespace

void add_wire_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                      MetricSink& sink) {
  std::optional<double> share, touches, angle, product;
  if (context.ring_on_wire) {
    share = touch_share(trace.samples, events, context.counted_hold_s);
    touches = number_of(events, event_type::kWireTouched);
    angle = mean_angle_deg(events);
    if (!trace.samples.empty()) product = *touches * (trace.samples.back().t_s - trace.samples.front().t_s);
  }
  sink.push_back({"wire_touch_share", share, "1"});
  sink.push_back({"wire_touches", touches, "1"});
  sink.push_back({"ring_angle_deg", angle, "deg"});
  sink.push_back({"touches_times_time_s", product, "s"});
}

}  // namespace trocar
