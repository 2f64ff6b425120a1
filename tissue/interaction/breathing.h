// What an organ lies on moves: up and down with the ventilator, and a little with the heart.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct Breathing {
  double per_min = 0, depth_m = 0;       ///< breaths; 0: it lies still
  double beats_per_min = 0, beat_m = 0;  ///< of the heart, felt through the diaphragm
};

/// How far the bed has moved at a time, m, frame T; nothing at 0. A breath goes in over two fifths of its time, towards
/// the feet and down; a beat lasts two fifths of its own and lifts.
Vec3 bed_shift(const Breathing& breathing, double t_s);

}  // namespace trocar
