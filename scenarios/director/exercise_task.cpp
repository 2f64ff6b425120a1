#include "scenarios/director/exercise_task.h"

#include <cstdio>

namespace trocar {

void EventLog::add(EventType type, Severity severity, std::int32_t object, double value, const std::string& unit) {
  events.push_back({t_s, std::string(type.name), severity, object, value, unit, tip_T});
}

void say(DirectorStatus& status, const std::string& message, const std::string& hint, bool warning) {
  status.message = message;
  status.hint = hint;
  status.warning = warning;
}

bool force_shown(const std::string& display, bool outside) {
  return display == "always" || (display == "band" && outside);
}

std::string band_text(const WantedForce& band) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f to %.1f N", band.low_n, band.high_n);
  return text;
}

}  // namespace trocar
