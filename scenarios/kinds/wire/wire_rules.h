// Ring on wire: the wire and the ring, as an exercise file describes them.
//
// Lengths m, angles rad, forces N. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

namespace trocar {

/// What every level shares.
struct WireRules : KindRules {
  double radius_m = 0, length_m = 0;                   ///< of the wire
  double least_bend_m = 0, widest_bend_m = 0;          ///< radii of its three bends
  double least_heading_rad = 0, most_heading_rad = 0;  ///< of its four legs, up and down in turn, to the way across
  double ring_thickness_m = 0;                         ///< of the ring's own bar
  double ring_turn_rad = 0;      ///< of the ring's normal about the shaft, from x of frame I towards its y
  double stiffness_n_per_m = 0;  ///< of ring against wire, as displayed
  double damping_s_per_m = 0;    ///< Hunt-Crossley factor
  double holds_n = 0;            ///< pulled harder than this, the ring comes off the wire
  double unhurried_s = 0;        ///< from gate to gate: touching as long is touching all the way
};

struct WireLevel : KindRules {
  double ring_radius_m = 0;  ///< inner
};

}  // namespace trocar
