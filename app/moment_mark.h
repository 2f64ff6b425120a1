// A moment that the trainee marked while it happened: an event of the recording that nobody grades.
//
// It comes from a person's key, not from the loop, so running the recording again does not make it: verifying leaves it out. Thread: any.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

inline constexpr const char* kMomentMark = "MARKED";

/// How often the key was pressed; window to tissue task.
using MarkCount = std::atomic<std::uint32_t>;

inline std::vector<Event> without_marks(std::vector<Event> events) {
  std::erase_if(events, [](const Event& event) { return event.type == kMomentMark; });
  return events;
}

}  // namespace trocar
