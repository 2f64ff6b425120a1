#include <algorithm>

#include "scenarios/scoring/metrics.h"

namespace trocar {

void add_palpate_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink) {
  int found = 0, wrong = 0;
  double off = 0;
  std::optional<double> searched, pressed_well;
  for (const Event& event : events) {
    if (event.type == event_type::kNoduleFound) {
      ++found;
      off += event.value;
    }
    wrong += event.type == event_type::kFalseMark;
    if (event.type == event_type::kSearchEnded) searched = event.value;
    if (event.type == event_type::kPlacePressed)
      pressed_well = pressed_well.value_or(0) + (event.severity == Severity::kInfo ? event.value : 0);
  }
  const bool marked = found + wrong > 0 || searched;
  const auto of_search = [&](double value) { return marked ? std::optional<double>(value) : std::nullopt; };
  const double total = std::max(1, context.objects_total);
  sink.push_back({"nodules_found", of_search(found), "1"});
  sink.push_back({"false_marks", of_search(wrong), "1"});
  sink.push_back({"search_share", of_search((found - wrong) / total), "1"});
  sink.push_back({"localisation_error_m", found > 0 ? std::optional<double>(off / found) : std::nullopt, "m"});
  sink.push_back({"pressed_well_share", pressed_well, "1"});
  sink.push_back({"searched_share", searched, "1"});
}

}  // namespace trocar
