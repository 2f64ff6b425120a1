// A cup with its sphere: where it stands, whether its wall hides the sphere, how near something is to it.
//
// A cup is an open cylinder with a floor; the sphere lies on the floor, its middle on the axis. Frame T, m. Thread:
// pure.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/kinds/camera/camera_rules.h"

namespace trocar {

struct Cup {
  Vec3 sphere_T = Vec3::Zero();  ///< middle of the sphere
  Vec3 axis_T = Vec3::UnitZ();   ///< unit, out of the opening
  double bore_m = 0, wall_m = 0, depth_m = 0, sphere_m = 0;

  double outer_radius_m() const { return bore_m / 2 + wall_m; }
  Vec3 rim_T() const { return sphere_T + (depth_m - sphere_m / 2) * axis_T; }  ///< middle of the opening
  Vec3 foot_T() const { return sphere_T - (sphere_m / 2 + wall_m) * axis_T; }  ///< middle of the floor's outside

  /// Is the whole sphere to be seen from there, past the rim?
  bool shows_sphere(const Vec3& eye_T) const;
  /// From a point to the cup's wall or floor.
  double distance_m(const Vec3& point_T) const;
};

/// The cup that a target of a board stands for: the target is the scope's pose, the sphere what it then looks at.
Cup cup_of(const Target& target, const CameraRules& rules, const CameraLevel& level);

}  // namespace trocar
