// What happened in an attempt, counted from its events, for the sentences that name it.
//
// Graded are the metrics; these counts tell apart what a metric pools (contact and squeeze above their limits) and what
// never happened (no disc touched), where a metric has no value. Pure. Thread: any.
#pragma once

#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

struct EventCounts {
  bool started = false;         ///< the clock ran
  bool deadman_opened = false;  ///< while it ran
  int held = 0;                 ///< different discs or pens
  int touched = 0;              ///< different discs
  int wrong_places = 0;         ///< contacts beside the lit disc
  int pressed_hard = 0, squeezed_hard = 0;
  int out_of_time = 0;          ///< of pens, as often as it happened
  int grasped = 0, lifted = 0;  ///< different blocks
  int placed = 0;               ///< blocks that stand in their rings
  int crushed = 0, slips = 0, drops = 0, misplaced = 0, regrasps = 0;
};

EventCounts counted(const std::vector<Event>& events);

}  // namespace trocar
