// One explicit step of the bioheat equation on a block of cubes: what flows between neighbours, to the blood and to the
// gas.
//
//   C (T' - T) / dt = edge * sum over neighbours of (k + k_n) / 2 (T_n - T) - w (1 - Omega) T - g (open faces) T
//
// T above the body's temperature. Nothing flows through the surface but to the gas, nothing to blocks that are not
// there. What flows from one cube to another is the same number from either side, so that no heat is made. Thread:
// tissue task.
#pragma once

#include "tissue/interaction/heat_grid.h"

namespace trocar {

/// Of one cube.
struct ConductionTerms {
  double edge_m = 0;
  double blood_w_per_k = 0;  ///< unhurt
  double gas_w_per_k = 0;    ///< of an open face
};

/// What a block has given away, J.
struct HeatLoss {
  double perfused_j = 0, to_gas_j = 0;
};

/// Fills next_k of a block; neighbours are read as they are.
HeatLoss conduct(HeatBlock& block, const ConductionTerms& terms, double dt);

}  // namespace trocar
