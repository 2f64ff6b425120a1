#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/smoothness.h"

namespace trocar {
namespace {

constexpr double kRestTime = 1.024;  // s before START: the tip rests in the start ball for at least a second

int count(const std::vector<Event>& events, EventType type) {
  return static_cast<int>(
      std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.type == type; }));
}

std::optional<double> mean_value(const std::vector<Event>& events, EventType type) {
  double sum = 0;
  for (const Event& event : events) sum += event.type == type ? event.value : 0;
  const int n = count(events, type);
  return n > 0 ? std::optional<double>(sum / n) : std::nullopt;
}

/// Share of the objects that were done before their time ran out.
std::optional<double> in_time_share(const std::vector<Event>& events, const ScoringContext& context) {
  if (context.objects_total <= 0) return std::nullopt;
  std::vector<std::int32_t> late, done;
  for (const Event& event : events) {
    const auto listed = [&](const std::vector<std::int32_t>& list) {
      return std::find(list.begin(), list.end(), event.object) != list.end();
    };
    if (event.type == event_type::kTargetTimeout) late.push_back(event.object);
    if (event.type == event_type::kTargetHeld && !listed(late) && !listed(done)) done.push_back(event.object);
  }
  return static_cast<double>(done.size()) / context.objects_total;
}

}  // namespace

void add_pose_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink) {
  // On a wire the same event tells of the ring alone: ring_angle_deg.
  const auto angle = context.ring_on_wire ? std::nullopt : mean_value(events, event_type::kAngleError);
  sink.push_back({"matched_in_time_share", in_time_share(events, context), "1"});
  sink.push_back({"position_error_m", mean_value(events, event_type::kPositionError), "m"});
  sink.push_back(
      {"angle_error_deg", angle ? std::optional<double>(*angle * 180 / std::numbers::pi) : std::nullopt, "deg"});
  sink.push_back({"target_timeouts", count(events, event_type::kTargetTimeout), "1"});
  sink.push_back({"device_limits", count(events, event_type::kDeviceLimit), "1"});
}

void add_rest_metric(const Trace& trace, const std::vector<Event>& events, MetricSink& sink) {
  const auto start =
      std::find_if(events.begin(), events.end(), [](const Event& event) { return event.type == event_type::kStart; });
  std::optional<double> rest;
  if (start != events.end()) {
    std::vector<Vec3> position;
    for (const TraceSample& sample : cut_trace(trace, start->t_s - kRestTime, start->t_s).samples)
      position.push_back(sample.tip_T);
    if (const auto noise = tremor(position, trace.rate_hz)) rest = noise->rms_m;
  }
  sink.push_back({"rest_tremor_rms_m", rest, "m"});
}

}  // namespace trocar
