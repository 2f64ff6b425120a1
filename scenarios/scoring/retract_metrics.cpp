#include <map>

#include "scenarios/scoring/metrics.h"

namespace trocar {

void add_retract_metrics(const std::vector<Event>& events, MetricSink& sink) {
  std::map<std::int32_t, double> exposed_s;  // of each object, when it first was
  std::optional<double> lost;
  for (const Event& event : events) {
    if (event.type == event_type::kExposed) exposed_s.emplace(event.object, event.value);
    if (event.type == event_type::kTissueTaken && !lost) lost = 0;
    const bool loses =
        event.type == event_type::kSlip || event.type == event_type::kLetGo || event.type == event_type::kCovered;
    if (lost && loses) ++*lost;
  }
  double sum_s = 0;
  for (const auto& [object, time_s] : exposed_s) sum_s += time_s;
  const bool any = !exposed_s.empty();
  sink.push_back({"time_to_expose_s",
                  any ? std::optional<double>(sum_s / static_cast<double>(exposed_s.size())) : std::nullopt, "s"});
  sink.push_back({"holds_lost", lost, "1"});
}

}  // namespace trocar
