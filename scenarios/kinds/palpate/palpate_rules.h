// Palpation: stiff balls hidden in an organ that gives way, to be felt with the tip and marked by a pinch, as an
// exercise file describes it.
//
// What every level shares stands in PalpateRules, what a level changes in PalpateLevel. Lengths m, forces N, times s.
// Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

#include <vector>

namespace trocar {

/// A hidden ball: how large, and how much tissue lies over it.
struct NodulePlan {
  double radius_m = 0, top_m = 0;
};

struct PalpateRules : KindRules {
  std::vector<NodulePlan> nodules;
  double hit_m = 0;        ///< beyond the ball's radius, along the surface, within which a mark is a hit
  double press_low_n = 0;  ///< with which tissue is judged well
  double press_high_n = 0;
  double mark_n = 0, mark_hold_s = 0;           ///< pinch that sets a mark, and for how long
  double pad_thickness_m = 0, pad_n_per_m = 0;  ///< of what is between the fingers
  double still_m = 0;                           ///< the tip may wander so far on the tissue during it
  double searched_cell_m = 0, searched_n = 0;   ///< grid of the region; a cell is searched when pressed so hard
};

/// What a level changes.
struct PalpateLevel : KindRules {
  double ratio = 1;          ///< of the balls' stiffness to that of what is round them
  int decoys = 0;            ///< balls that are nothing to be marked ...
  double decoy_ratio = 1;    ///< ... and less stiff
  bool found_shown = false;  ///< each mark tells at once whether it is right
};

}  // namespace trocar
