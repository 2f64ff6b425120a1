// Camera navigation: spheres in cups to be looked at through a scope, as an exercise file describes them.
//
// What every level shares stands in CameraRules, what a level changes in CameraLevel. Lengths m, angles rad, times s.
// Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

namespace trocar {

struct CameraRules : KindRules {
  double sphere_m = 0;                     ///< diameter
  double cup_depth_m = 0, cup_wall_m = 0;  ///< a sphere lies on the floor of its cup
  double nearest_m = 0, farthest_m = 0;    ///< lens to the sphere's middle, while it is held
  double drawn_m = 0;                      ///< that distance where the board has the scope stand
  double lost_s = 0;                       ///< so long rolled too far the horizon is lost
  double timeout_s = 0;                    ///< a lit sphere not held by then is an error and comes back at the end
  double counted_s = 0;                    ///< of the time with a level picture so much counts for a sphere
  double swing_rad = 0;                    ///< largest turn of the scope's shaft from the resting one; no port
  double steepest_rad = 0;                 ///< of the line of sight, below level: steeper there is no horizon
  double board_half_m = 0, board_z_m = 0;  ///< the cups' plate; its upper face
  double board_stiffness_n_per_m = 0;      ///< as displayed
};

struct CameraLevel : KindRules {
  double tilt_rad = 0;     ///< of the scope's tip: 0, or 30 degrees
  double centre_rad = 0;   ///< half opening of the circle in which the sphere's middle must lie
  double horizon_rad = 0;  ///< largest roll of the picture
  double bore_m = 0;       ///< inner diameter of a cup: the narrower, the more nearly along its axis must be looked
};

}  // namespace trocar
