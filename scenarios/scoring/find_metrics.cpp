#include <set>

#include "scenarios/scoring/metrics.h"

namespace trocar {

void add_find_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink) {
  std::set<std::int32_t> right;
  bool any = false;
  for (const Event& event : events) {
    const bool is_right = event.type == event_type::kAnswered;
    any = any || is_right || event.type == event_type::kWrongAnswer;
    if (is_right) right.insert(event.object);
  }
  any = any && context.objects_total > 0;
  sink.push_back({"right_answers_share",
                  any ? std::optional<double>(static_cast<double>(right.size()) / context.objects_total) : std::nullopt,
                  "1"});
}

}  // namespace trocar
