// The time line of a replay: force over time of one or two runs, what happened, where the film stands. It is the scrub
// bar too.
//
// Own run: filled ranges per px; the run beside: a line. Thread: the window's, within a frame.
#pragma once

#include <string>
#include <vector>

#include "app/session/playback/recorded_run.h"
#include "app/window/replay/replay_clock.h"
#include "app/window/replay/replay_events.h"

namespace trocar {

struct ReplayPlotContent {
  const RecordedRun& run;
  const RecordedRun* beside = nullptr;
  const std::vector<ReplayEvent>& events;
  bool grip = false;      ///< grip force instead of the contact force
  WantedForce band = {};  ///< wanted force, 0 to 0: none
  double limit_n = 0;     ///< 0: none
};

/// Fills the area; puts the clock where it is clicked or dragged. @param area of the last drawing().
void replay_plot(Ui& ui, const Area& area, const ReplayPlotContent& content, ReplayClock& clock);

}  // namespace trocar
