// What happened in a run, in words, and how it is marked on a time line.
#pragma once

#include <string>
#include <vector>

#include "app/window/ui/ui.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// A moment worth jumping to.
struct ReplayEvent {
  double clock_s = 0;  ///< since RUN began
  Severity severity = Severity::kInfo;
  std::string words;
  bool own = false;  ///< the trainee marked it
};

/// Those that a person saw happen; what only the grade reads is left out. @param begin_s loop time of RUN's beginning.
std::vector<ReplayEvent> replay_events(const std::vector<Event>& events, double begin_s, const Translator& words);

/// By shape and colour: a disc, a diamond, a warning triangle; a ring for one's own mark.
void paint_event(Ui& ui, const ReplayEvent& event, double x, double y, double radius);

}  // namespace trocar
