// Gauze circle cut: the line that is cut along, and how a cut is judged, as an exercise file describes it.
//
// Lengths m, forces N, angles rad. Frame G: on the gauze, its origin the middle of the closed line, x to the right and
// y away from the trainee as those of T. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

namespace trocar {

struct GauzeRules : KindRules {
  double step_m = 0;                         ///< along the line, from one place that is asked for to the next
  double line_m = 0;                         ///< width of the line, as it is seen
  double press_low_n = 0, press_high_n = 0;  ///< of the tips on the gauze, that lays it between the blades
  double most_pull_n = 0;                    ///< beyond it tension fails
  double shift_m = 0;                        ///< of the line's middle, by which boards differ, either way
  double way_in_rad = 0;                     ///< of the way in from straight ahead, the same
};

struct GauzeLevel : KindRules {
  double long_m = 0, across_m = 0;  ///< diameters of the closed line: a circle, or an ellipse
  double off_m = 0;                 ///< from the line: a cut further off lies outside
};

/// The line on one board.
struct GauzeLine {
  double long_m = 0, across_m = 0;  ///< half axes
  double turned_rad = 0;            ///< of the long one from x of G
  double from_rad = 0;              ///< direction from the middle in which the way in meets the closed line
  double way_in_m = 0;              ///< from the gauze's edge to there, towards the middle
  double sense = 1;                 ///< 1: counter-clockwise from there, -1: clockwise

  bool operator==(const GauzeLine&) const = default;
};

struct GauzeBoard : KindRules {
  Vec3 middle_T = Vec3::Zero();       ///< origin of G; its axes are those of T
  Mat3 R_TI_rest = Mat3::Identity();  ///< of the instrument, before it is turned to a place
  GauzeLine line;
};

}  // namespace trocar
