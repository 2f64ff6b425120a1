#include <set>

#include "scenarios/scoring/metrics.h"

namespace trocar {

/// From the first touch that named, or the first clip or cut: before that nothing has been tried.
void add_clip_metrics(const std::vector<Event>& events, MetricSink& sink) {
  constexpr double kClipsAsked = 6;
  std::set<std::int32_t> good;  // places that bear a clip which counts
  int wasted = 0, errors = 0, divided = 0, set = 0;
  double off_m = 0, askew_deg = 0;
  bool tried = false;
  for (const Event& event : events) {
    const bool wastes = event.type == event_type::kClipWasted, divides = event.type == event_type::kDivided;
    const bool sets = event.type == event_type::kClipSet;
    tried = tried || wastes || divides || sets || event.type == event_type::kNamed;
    if (sets) good.insert(event.object);
    if (wastes) good.erase(event.object);
    wasted += wastes;
    errors += wastes || event.type == event_type::kWrongStructure || (divides && event.severity != Severity::kInfo);
    divided += divides;
    set += sets;
    if (sets) askew_deg += event.value;
    if (divides) off_m += event.value;
  }
  const auto of_tried = [&](double value) { return tried ? std::optional<double>(value) : std::nullopt; };
  sink.push_back({"clips_correct_share", of_tried(static_cast<double>(good.size()) / kClipsAsked), "1"});
  sink.push_back({"clips_wasted", of_tried(wasted), "1"});
  sink.push_back({"clip_errors", of_tried(errors), "1"});
  sink.push_back({"clip_angle_deg", set > 0 ? std::optional<double>(askew_deg / set) : std::nullopt, "deg"});
  sink.push_back({"cut_off_middle_m", divided > 0 ? std::optional<double>(off_m / divided) : std::nullopt, "m"});
}

}  // namespace trocar
