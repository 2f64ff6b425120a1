// Limited grasp: foam blocks to be picked, lifted, carried and set within rings, as an exercise file describes them.
//
// What every level shares stands in GraspRules, what a level changes in GraspLevel. Lengths m, forces N, angles rad.
// Thread: plain values, fixed after loading.
#pragma once

#include <string>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

/// One kind of foam. Below slip_below_n a carried block slips, above crush_above_n it is crushed.
struct FoamKind {
  std::string name;  ///< of its colour
  double stiffness_n_per_m = 0;
  double slip_below_n = 0, crush_above_n = 0;
};

struct GraspRules {
  Vec3 block_m = Vec3::Zero();  ///< extents
  double block_mass_kg = 0;
  std::vector<FoamKind> kinds;     ///< dealt out evenly to the blocks
  int rows = 0, columns = 0;       ///< of blocks, and of rings
  double row_m = 0, column_m = 0;  ///< spacing
  double carry_m = 0;              ///< from a block to its ring, along x
  double lift_m = 0;               ///< a block must have been this high over the board
  double ring_radius_m = 0;        ///< inner radius as printed
  double drop_m = 0;               ///< a block that falls further than this was dropped
  double lost_margin_m = 0;        ///< beyond the board's edge: there a block is lost
  double board_half_m = 0;
  double board_stiffness_n_per_m = 0;  ///< as displayed
  int critical_crushed = 0;            ///< so many crushed blocks are a critical error
};

/// What a level changes.
struct GraspLevel {
  bool colour_cue = true;                         ///< blocks show their kind
  double window_margin = 0.2;                     ///< wanted grip: from slip (1 + m) to crush (1 - m)
  double place_tolerance_m = 0;                   ///< of the block's middle from the ring's centre
  double yaw_rad = 0;                             ///< blocks face the pads of the resting jaws
  double yaw_spread_rad = 0, place_spread_m = 0;  ///< drawn by the board
};

/// The wanted grip of a kind at a level, N.
struct GripWindow {
  double low_n = 0, high_n = 0;
  bool operator==(const GripWindow&) const = default;
};
inline GripWindow grip_window(const FoamKind& kind, const GraspLevel& level) {
  return {kind.slip_below_n * (1 + level.window_margin), kind.crush_above_n * (1 - level.window_margin)};
}

}  // namespace trocar
