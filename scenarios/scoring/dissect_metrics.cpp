#include <algorithm>
#include <vector>

#include "scenarios/scoring/metrics.h"

namespace trocar {

/// From the first strand that is divided on: before that nothing has been done.
void add_dissect_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                         MetricSink& sink) {
  const auto objects = static_cast<std::size_t>(std::max(0, context.objects_total));
  std::vector<double> safe_s(objects), unsafe_s(objects);
  std::optional<double> spurts_s, blood_ml;
  int divided = 0, lifted = 0, late = 0;
  double clearance = 0;
  for (const Event& event : events) {
    const auto object = static_cast<std::size_t>(event.object);
    if (event.type == event_type::kCurrentUsed && object < objects) safe_s[object] += event.value;
    if (event.type == event_type::kUnsafeCurrent && object < objects) unsafe_s[object] += event.value;
    if (event.type == event_type::kStrandDivided) {
      ++divided;
      lifted += event.severity == Severity::kInfo;
      if (event.severity != Severity::kMajor) clearance += std::clamp(event.value / context.strand_lift_m, 0.0, 1.0);
    }
    if (event.type == event_type::kSpurts) spurts_s = event.t_s;
    const bool bleeds = event.type == event_type::kBleeding || event.type == event_type::kSealed;
    if (event.type == event_type::kSpurts || (spurts_s && bleeds)) blood_ml = event.value;
    late += event.type == event_type::kSealedLate;
  }
  double share = 0, pedal_s = 0;
  for (std::size_t i = 0; i < objects; ++i)
    if (safe_s[i] > 0) share += safe_s[i] / (safe_s[i] + unsafe_s[i]) / context.objects_total;
  for (const TraceSample& sample : trace.samples)
    if (sample.pedal && (!spurts_s || sample.t_s < *spurts_s)) pedal_s += 1 / trace.rate_hz;
  const auto of_divided = [&](double value) { return divided > 0 ? std::optional<double>(value) : std::nullopt; };
  sink.push_back({"safe_energy_share", of_divided(share), "1"});
  sink.push_back({"strands_lifted_share", of_divided(static_cast<double>(lifted) / context.strands_total), "1"});
  sink.push_back({"strand_clearance_share", of_divided(clearance / context.strands_total), "1"});
  sink.push_back({"spurted_ml", blood_ml, "mL"});
  sink.push_back({"strand_current_s", of_divided(pedal_s / divided), "s"});
  sink.push_back({"sealed_late", of_divided(late), "1"});
}

}  // namespace trocar
