#include "scenarios/kinds/camera/cup.h"

#include <algorithm>
#include <cmath>

#include "scenarios/kinds/camera/scope_view.h"

namespace trocar {

bool Cup::shows_sphere(const Vec3& eye_T) const {
  const Vec3 way = eye_T - sphere_T;
  const double to_rim = depth_m - sphere_m / 2, along = way.dot(axis_T);
  if (along <= to_rim) return (way - along * axis_T).norm() < bore_m / 2;  // the lens is in the cup
  // The cone from the lens round the sphere, where it passes the rim's plane.
  const double share = to_rim / along;
  const double aside = share * (way - along * axis_T).norm(), half = (1 - share) * sphere_m / 2;
  return aside + half <= bore_m / 2;
}

double Cup::distance_m(const Vec3& point_T) const {
  const Vec3 way = point_T - rim_T();
  const double along = way.dot(axis_T);
  const Eigen::Vector2d at((way - along * axis_T).norm(), along);
  const Eigen::AlignedBox2d wall(Eigen::Vector2d(bore_m / 2, -depth_m - wall_m), Eigen::Vector2d(outer_radius_m(), 0));
  const Eigen::AlignedBox2d floor(Eigen::Vector2d(0, -depth_m - wall_m), Eigen::Vector2d(outer_radius_m(), -depth_m));
  return std::min(wall.exteriorDistance(at), floor.exteriorDistance(at));
}

Cup cup_of(const Target& target, const CameraRules& rules, const CameraLevel& level) {
  const Vec3 sight = (target.R_TI * picture_in_instrument(level.tilt_rad)).col(2);
  return {.sphere_T = target.centre_T + rules.drawn_m * sight,
          .axis_T = -sight,
          .bore_m = level.bore_m,
          .wall_m = rules.cup_wall_m,
          .depth_m = rules.cup_depth_m,
          .sphere_m = rules.sphere_m};
}

}  // namespace trocar
