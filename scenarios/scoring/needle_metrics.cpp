#include <map>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// Mean over objects of the mean of what was told of each: a bite more at one pair weighs no other pair down.
std::optional<double> mean_of_pairs(const std::vector<Event>& events, EventType type) {
  struct Sum {
    double value = 0;
    int count = 0;
  };
  std::map<std::int32_t, Sum> pairs;
  for (const Event& event : events) {
    if (event.type != type) continue;
    Sum& sum = pairs[event.object];
    sum.value += event.value;
    ++sum.count;
  }
  if (pairs.empty()) return std::nullopt;
  double total = 0;
  for (const auto& [pair, sum] : pairs) total += sum.value / sum.count;
  return total / static_cast<double>(pairs.size());
}

}  // namespace

/// Redos are told from the first grip on: before it nothing has been tried.
void add_needle_metrics(const std::vector<Event>& events, MetricSink& sink) {
  int redos = 0;
  bool tried = false;
  for (const Event& event : events) {
    const bool grips = event.type == event_type::kNeedleGripped;
    tried = tried || grips;
    redos += (grips && event.severity != Severity::kInfo) || event.type == event_type::kBiteUndone ||
             event.type == event_type::kNeedleLost;
  }
  sink.push_back({"entry_error_m", mean_of_pairs(events, event_type::kBiteBegun), "m"});
  sink.push_back({"exit_error_m", mean_of_pairs(events, event_type::kBiteThrough), "m"});
  sink.push_back({"needle_angle_deg", mean_of_pairs(events, event_type::kNeedleDrawn), "deg"});
  sink.push_back({"needle_redos", tried ? std::optional<double>(redos) : std::nullopt, "1"});
}

}  // namespace trocar
