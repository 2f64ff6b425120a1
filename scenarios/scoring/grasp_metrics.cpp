#include <algorithm>

#include "scenarios/scoring/band_time.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// From each LIFTED to what ends it for that object, or to the end. Only of objects that have a window.
std::vector<BandWindow> carries_of(const std::vector<Event>& events, const ScoringContext& context, double end_s) {
  std::vector<BandWindow> carries;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::int32_t object = events[i].object;
    if (events[i].type != event_type::kLifted || object < 0) continue;
    if (static_cast<std::size_t>(object) >= context.grip_windows.size()) continue;
    const auto down = std::find_if(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(), [&](const Event& e) {
      return e.type == event_type::kSetDown && e.object == object;
    });
    const auto& [low, high] = context.grip_windows[static_cast<std::size_t>(object)];
    carries.push_back({object, events[i].t_s, down == events.end() ? end_s : down->t_s, {low, high}});
  }
  return carries;
}

struct WindowShares {
  std::optional<double> pooled, of_objects;  ///< empty when nothing was carried
};

/// Of the carrying time with the grip in the object's window.
WindowShares window_shares(const std::vector<TraceSample>& samples, const std::vector<Event>& events,
                           const ScoringContext& context) {
  if (context.grip_windows.empty() || samples.size() < 2) return {};
  const double end_s = samples.back().t_s;
  BandTimes of_objects{FrozenTimes(events, end_s)};
  double inside = 0, total = 0;
  for (const BandWindow& carry : carries_of(events, context, end_s)) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i].t_s <= carry.from_s || samples[i].t_s > carry.to_s) continue;
      const double step = samples[i].t_s - samples[i - 1].t_s, grip = samples[i].grip_n;
      total += step;
      if (grip >= carry.band.low_n && grip <= carry.band.high_n) inside += step;
      of_objects.add(carry, samples[i].t_s, step, grip);
    }
  }
  return {total > 0 ? std::optional<double>(inside / total) : std::nullopt,
          of_objects.mean_share(context.counted_hold_s)};
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
  const WindowShares shares = window_shares(trace.samples, events, context);
  sink.push_back({"grip_window_share", shares.pooled, "1"});
  sink.push_back({"object_grip_window_share", shares.of_objects, "1"});
  sink.push_back({"crushed", count(event_type::kCrush), "1"});
  sink.push_back({"block_regrasps", count(event_type::kRegrasp), "1"});
  sink.push_back({"slips", count(event_type::kSlip), "1"});
  sink.push_back({"drops", count(event_type::kDrop), "1"});
  sink.push_back({"misplaced", count(event_type::kMisplaced), "1"});
}

}  // namespace trocar
