#include <algorithm>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

struct Carry {
  std::int32_t object = 0;
  double from_s = 0, to_s = 0;
};

/// From each LIFTED to what ends it for that object, or to the end.
std::vector<Carry> carries_of(const std::vector<Event>& events, double end_s) {
  std::vector<Carry> carries;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].type != event_type::kLifted) continue;
    const auto down = std::find_if(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(), [&](const Event& e) {
      return e.type == event_type::kSetDown && e.object == events[i].object;
    });
    carries.push_back({events[i].object, events[i].t_s, down == events.end() ? end_s : down->t_s});
  }
  return carries;
}

/// Share of the carrying time in which the grip lies in the object's window; empty when nothing was carried.
std::optional<double> window_share(const std::vector<TraceSample>& samples, const std::vector<Event>& events,
                                   const ScoringContext& context) {
  if (context.grip_windows.empty() || samples.size() < 2) return std::nullopt;
  double inside = 0, total = 0;
  for (const Carry& carry : carries_of(events, samples.back().t_s)) {
    if (carry.object < 0 || static_cast<std::size_t>(carry.object) >= context.grip_windows.size()) continue;
    const auto& [low, high] = context.grip_windows[static_cast<std::size_t>(carry.object)];
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i].t_s <= carry.from_s || samples[i].t_s > carry.to_s) continue;
      const double step = samples[i].t_s - samples[i - 1].t_s, grip = samples[i].grip_n;
      total += step;
      if (grip >= low && grip <= high) inside += step;
    }
  }
  return total > 0 ? std::optional<double>(inside / total) : std::nullopt;
}

}  // namespace

void add_grasp_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                       MetricSink& sink) {
  const bool grasp = !context.grip_windows.empty();
  const auto count = [&](EventType type) -> std::optional<double> {
    if (!grasp) return std::nullopt;
    return static_cast<double>(
        std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.type == type; }));
  };
  sink.push_back({"grip_window_share", window_share(trace.samples, events, context), "1"});
  sink.push_back({"crushed", count(event_type::kCrush), "1"});
  sink.push_back({"block_regrasps", count(event_type::kRegrasp), "1"});
  sink.push_back({"slips", count(event_type::kSlip), "1"});
  sink.push_back({"drops", count(event_type::kDrop), "1"});
  sink.push_back({"misplaced", count(event_type::kMisplaced), "1"});
}

}  // namespace trocar
