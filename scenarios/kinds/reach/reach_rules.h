// Reach and orient: pens to be matched in place and direction, as an exercise file describes them.
//
// Lengths m, angles rad, times s. Thread: plain values, fixed after loading.
#pragma once

namespace trocar {

/// Pens to match, tips on a spherical cap that opens upwards round the region's centre.
struct PenRules {
  double shell_radius_m = 0;          ///< of the sphere on which the tips lie
  double cap_rad = 0;                 ///< half opening of the cap, about the downward axis
  double tilt_rad = 0, roll_rad = 0;  ///< largest turn of a pen's axis from the resting instrument, and about it
  double length_m = 0, radius_m = 0;  ///< as drawn
  double timeout_s = 0;               ///< a lit pen not matched by then is an error and comes back at the end
};

}  // namespace trocar
