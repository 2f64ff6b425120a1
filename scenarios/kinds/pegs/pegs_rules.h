// Peg transfer: pegs and rings, as an exercise file describes them.
//
// Lengths m, forces N, angles rad. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

namespace trocar {

/// What every level shares.
struct PegsRules : KindRules {
  int rows = 0, columns = 0;       ///< of the pegs of one side
  double column_m = 0, row_m = 0;  ///< spacing; every other column stands half a row further
  double peg_radius_m = 0, peg_height_m = 0;
  double ring_side_m = 0;  ///< of its triangle
  double ring_height_m = 0, hole_radius_m = 0, ring_mass_kg = 0;
  double ring_stiffness_n_per_m = 0;  ///< between the jaws
  double slip_below_n = 0;            ///< a lighter grip does not hold a ring
  WantedForce wanted;                 ///< grip that is asked for, between these two
  double mark_above_n = 0;            ///< a harder grip leaves a mark
  double lift_m = 0;                  ///< of the ideal path, over the pegs
  double drop_m = 0;                  ///< a ring that falls further, and not down a peg, was dropped
  double board_half_m = 0, lost_margin_m = 0;
  double board_stiffness_n_per_m = 0;  ///< as displayed

  int rings() const { return rows * columns; }
};

/// What a level changes.
struct PegsLevel : KindRules {
  double least_gap_m = 0, widest_gap_m = 0;  ///< between the two sides, drawn by the board
  double place_tolerance_m = 0;              ///< of the hole's middle from the peg's, when it meets or passes its top
};

}  // namespace trocar
