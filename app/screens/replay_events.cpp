#include "app/screens/replay_events.h"

namespace trocar {
namespace {

std::string words_of(const std::string& type, const Words& w) {
  if (type == "START") return w("Start");
  if (type == "TARGET_HELD") return w("Held");
  if (type == "TARGET_TIMEOUT") return w("Out of time");
  if (type == "GRIP_TOUCHED") return w("Block touched");
  if (type == "GRIP_HELD") return w("Grip held");
  if (type == "GRIP_EXCESS") return w("Gripped too hard");
  if (type == "EXCESS_FORCE") return w("Too much force");
  if (type == "CRITICAL_FORCE") return w("Dangerous force");
  if (type == "WRONG_PLACE") return w("Wrong place");
  if (type == "WRONG_BLOCK") return w("Wrong block");
  if (type == "TOOL_COLLISION") return w("Instrument hit something");
  if (type == "GRASPED") return w("Grasped");
  if (type == "SET_DOWN") return w("Set down");
  if (type == "DROP") return w("Dropped");
  if (type == "PLACED") return w("Placed");
  if (type == "MISPLACED") return w("Set down in the wrong place");
  if (type == "REGRASP") return w("Grasped again");
  if (type == "LOST") return w("Lost");
  if (type == "CRUSH") return w("Crushed");
  if (type == "SLIP") return w("Slipped");
  if (type == "REMOVED") return w("Taken away again");
  if (type == "PORT_HOLD") return w("Held near the port");
  if (type == "DONE") return w("Done");
  if (type == "TIMEOUT") return w("Time is over");
  if (type == "DEVICE_LIMIT") return w("Device at its limit");
  if (type == "DEVICE_FAULT") return w("Device fault");
  if (type == "DEADMAN_OPEN") return w("Handle let go");
  return "";
}

}  // namespace

std::vector<ReplayEvent> replay_events(const std::vector<Event>& events, double begin_s, const Words& words) {
  std::vector<ReplayEvent> out;
  for (const Event& event : events) {
    std::string said = words_of(event.type, words);
    if (said.empty() && event.severity != Severity::kInfo) said = event.type;
    if (!said.empty()) out.push_back({event.t_s - begin_s, event.severity, said});
  }
  return out;
}

void paint_event(Ui& ui, Severity severity, double x, double y, double r) {
  switch (severity) {
    case Severity::kInfo: return ui.paint_disc(x, y, 0.8 * r, Ink::kGood);
    case Severity::kMinor:
    case Severity::kMajor:
      ui.paint_triangle(x - r, y, x + r, y, x, y - r, Ink::kCaution);
      return ui.paint_triangle(x - r, y, x + r, y, x, y + r, Ink::kCaution);
    case Severity::kCritical: return ui.paint_mark(Mark::kWarning, x - 1.2 * r, y - 1.2 * r, 2.4 * r);
  }
}

}  // namespace trocar
