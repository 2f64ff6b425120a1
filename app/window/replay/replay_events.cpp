#include "app/window/replay/replay_events.h"

#include "app/window/attempt/debrief_facts.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
std::vector<ReplayEvent> replay_events(const std::vector<Event>& events, double begin_s, const Translator& words) {
  std::vector<ReplayEvent> out;
  for (const Event& event : events) {
    const std::string said = event_words(words, event);
    if (!said.empty()) out.push_back({event.t_s - begin_s, event.severity, said, event.type == event_type::kMarked});
  }
  return out;
}

void paint_event(Ui& ui, const ReplayEvent& event, double x, double y, double r) {
  if (event.own) return ui.paint_ring(x, y, r, Ink::kText);
  switch (event.severity) {
    case Severity::kInfo:
      return ui.paint_disc(x, y, 0.8 * r, Ink::kGood);
    case Severity::kMinor:
    case Severity::kMajor:
      ui.paint_triangle(x - r, y, x + r, y, x, y - r, Ink::kCaution);
      return ui.paint_triangle(x - r, y, x + r, y, x, y + r, Ink::kCaution);
    case Severity::kCritical:
      return ui.paint_mark(Mark::kWarning, x - 1.2 * r, y - 1.2 * r, 2.4 * r);
  }
}

}  // namespace trocar
