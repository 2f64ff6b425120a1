// Bleeders and hook: strands over the bed of a gallbladder are lifted on a hook and divided by current, then the
// vessels that spurt are coagulated, as an exercise file describes it.
//
// Every duct of the exercise is a strand; a board says where they run and where the vessels open. The targets of a
// board are the strands' places on the organ, then those of the vessels. SI. Thread: plain values, fixed after loading.
#pragma once

#include <array>

#include "scenarios/exercise.h"

namespace trocar {

inline constexpr int kMostStrands = 5, kMostSpurters = 3;
inline constexpr int kMostDissectAims = kMostStrands + kMostSpurters;

struct DissectRules : KindRules {
  int strands = kMostStrands;                ///< of the targets, the first
  double bed_along_m = 0, bed_across_m = 0;  ///< of the bed, along the strands and across them
  double span_m = 0, bow_m = 0;              ///< of a strand; how far its middle stands off the organ
  double lift_m = 0;                         ///< of the tip off the organ, at least, as a strand is divided
  double near_m = 0;                         ///< of the live tip to the organ: nearer is unsafe ...
  double forgiven_s = 0;                     ///< ... but for so long, of each object
  double counted_s = 0;                      ///< of each object's safe current at most so much counts
  double beside_m = 0;                       ///< from the lit vessel, within which the live tip may touch
  double field_m = 0;                        ///< from the middle of the bed: beyond it the tip is out of view
  double seal_s = 0;                         ///< since a vessel lit: later is late
  double vessel_radius_m = 0, feed_m = 0;    ///< as VesselSize
  double perforated_m2 = 0;                  ///< of the organ's cuts: a critical error beyond
  double turn_rad = 0, shift_m = 0;          ///< by which strands are turned, and boards shifted, either way
};

}  // namespace trocar
