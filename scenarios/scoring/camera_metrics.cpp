#include <algorithm>
#include <map>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// Mean over objects of what was last told of each.
std::optional<double> mean_of_last(const std::vector<Event>& events, EventType type) {
  std::map<std::int32_t, double> last;
  for (const Event& event : events)
    if (event.type == type) last[event.object] = event.value;
  if (last.empty()) return std::nullopt;
  double sum = 0;
  for (const auto& [object, value] : last) sum += value;
  return sum / static_cast<double>(last.size());
}

}  // namespace

void add_camera_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                        MetricSink& sink) {
  const std::optional<double> level = mean_of_last(events, event_type::kHorizonKept);
  const bool camera = level.has_value();  // told of every sphere, never an error
  const auto count = [&](EventType type) -> std::optional<double> {
    if (!camera) return std::nullopt;
    return static_cast<double>(
        std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.type == type; }));
  };
  std::optional<double> pace;
  if (camera && context.objects_done > 0 && !trace.samples.empty())
    pace = (trace.samples.back().t_s - trace.samples.front().t_s) / context.objects_done;
  sink.push_back({"time_per_target_s", pace, "s"});
  sink.push_back({"horizon_share", level, "1"});
  sink.push_back({"horizon_losses", count(event_type::kHorizonLost), "1"});
  sink.push_back({"wall_contacts", count(event_type::kWallContact), "1"});
  sink.push_back({"view_jerks", mean_of_last(events, event_type::kViewJerks), "1"});
}

}  // namespace trocar
