#include <algorithm>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

constexpr double kPerRingLost = 100;  // s for all of them
constexpr double kBumpWeight = 0.5;

}  // namespace

void add_pegs_metrics(const std::vector<Event>& events, const ScoringContext& context, std::optional<double> time_s,
                      MetricSink& sink) {
  const auto count = [&](EventType type) -> double {
    return static_cast<double>(
        std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.type == type; }));
  };
  const double bumps = count(event_type::kBump);
  const bool pegs = !context.grip_windows.empty() && (bumps > 0 || count(event_type::kTargetHeld) > 0);
  const auto of_pegs = [&](double value) { return pegs ? std::optional<double>(value) : std::nullopt; };
  sink.push_back({"bumps", of_pegs(bumps), "1"});
  sink.push_back({"grip_marks", of_pegs(count(event_type::kGripExcess)), "1"});
  sink.push_back({"transfer_errors", of_pegs(count(event_type::kDrop) + kBumpWeight * bumps), "1"});
  const double lost_share = count(event_type::kLost) / std::max(1.0, context.objects_total / 2.0);
  const bool ended =
      time_s && (context.outcome == AttemptStatus::kCompleted || context.outcome == AttemptStatus::kTimeout);
  sink.push_back(
      {"time_left_less_lost_s",
       ended ? of_pegs(std::max(0.0, context.time_limit_s - *time_s - kPerRingLost * lost_share)) : std::nullopt, "s"});
}

}  // namespace trocar
