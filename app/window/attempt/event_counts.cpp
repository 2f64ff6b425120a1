#include "app/window/attempt/event_counts.h"

#include <algorithm>
#include <set>

#include "scenarios/scoring/event_types.h"

namespace trocar {

EventCounts counted(const std::vector<Event>& events) {
  const auto count = [&](EventType type) {
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.type == type; }));
  };
  const auto different = [&](EventType type) {
    std::set<std::int32_t> objects;
    for (const Event& e : events)
      if (e.type == type) objects.insert(e.object);
    return static_cast<int>(objects.size());
  };
  return {.started = count(event_type::kStart) > 0,
          .deadman_opened = count(event_type::kDeadmanOpen) > 0,
          .held = different(event_type::kTargetHeld),
          .touched = different(event_type::kTargetTouched),
          .wrong_places = count(event_type::kWrongPlace),
          .pressed_hard = count(event_type::kExcessForce),
          .squeezed_hard = count(event_type::kGripExcess),
          .out_of_time = count(event_type::kTargetTimeout),
          .grasped = different(event_type::kGrasped),
          .lifted = different(event_type::kLifted),
          .placed = count(event_type::kPlaced) - count(event_type::kRemoved),
          .crushed = count(event_type::kCrush),
          .slips = count(event_type::kSlip),
          .drops = count(event_type::kDrop),
          .misplaced = count(event_type::kMisplaced),
          .regrasps = count(event_type::kRegrasp)};
}

}  // namespace trocar
