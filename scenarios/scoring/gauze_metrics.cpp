#include <algorithm>

#include "scenarios/scoring/metrics.h"

namespace trocar {

/// From the first snip: before that nothing has been cut.
void add_gauze_metrics(const std::vector<Event>& events, MetricSink& sink) {
  int snips = 0, pulls = 0;
  double area = 0, outside = 0;
  for (const Event& event : events) {
    snips += event.type == event_type::kSnip;
    pulls += event.type == event_type::kPulledHard;
    if (event.type == event_type::kSnip) area += event.value;
    if (event.type == event_type::kOffLine) outside += event.value;
  }
  const auto of_cut = [&](double value) { return snips > 0 ? std::optional<double>(value) : std::nullopt; };
  sink.push_back({"cut_area_share", of_cut(area), "1"});
  sink.push_back({"cut_outside_share", of_cut(std::min(1.0, outside)), "1"});
  sink.push_back({"hard_pulls", of_cut(pulls), "1"});
  sink.push_back({"snips", of_cut(snips), "1"});
}

}  // namespace trocar
