#include "scenarios/director/exercise_task.h"

#include <array>
#include <cstdio>

#include "haptics/contact/instrument.h"

namespace trocar {
namespace {

/// Two decimals at most, no zeros at the end: a band of 0.45 to 0.75 N is not one of 0.5 to 0.8 N.
std::string band_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2f", value);
  std::string text = buffer;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

void EventLog::add(EventType type, Severity severity, std::int32_t object, double value, const std::string& unit) {
  events.push_back({t_s, std::string(type.name), severity, object, value, unit, tip_T});
}

void say(DirectorStatus& status, const std::string& message, const std::string& hint, bool warning) {
  status.message = message;
  status.hint = hint;
  status.warning = warning;
}

void say_take(DirectorStatus& status, InstrumentKind instrument) {
  constexpr std::array<const char*, kInstruments.size()> kTake{
      "Take the probe",        "Take the grasper", "Take the scissors",     "Take the hook",
      "Take the clip applier", "Take the suction", "Take the needle driver"};
  say(status, kTake[static_cast<std::size_t>(instrument)], "Draw back and exchange the instrument.");
}

bool force_shown(const std::string& display, bool outside) {
  return display == "always" || (display == "band" && outside);
}

std::string band_text(const WantedForce& band) {
  return band_number(band.low_n) + " to " + band_number(band.high_n) + " N";
}

}  // namespace trocar
