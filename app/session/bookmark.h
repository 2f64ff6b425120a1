// A moment that the trainee marked while it happened, or at which a teacher's message was shown: an event of the
// recording that nobody grades.
//
// They come from persons, not from the loop, so running the recording again does not make them: verifying leaves them
// out. Thread: any.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

/// How often it happened; window to tissue task.
using MarkCount = std::atomic<std::uint32_t>;

inline std::vector<Event> without_marks(std::vector<Event> events) {
  std::erase_if(events, [](const Event& event) {
    return event.type == event_type::kMarked || event.type == event_type::kMessage;
  });
  return events;
}

}  // namespace trocar
