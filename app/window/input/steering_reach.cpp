#include "app/window/input/steering_reach.h"

#include <algorithm>
#include <cmath>

#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {
constexpr double kToSpare_m = 0.015;
constexpr double kRollThroughPort = 150 * std::numbers::pi / 180;
}  // namespace

SteeringReach steering_reach(const Exercise& exercise, const ExerciseLevel& level) {
  const TargetLayout& layout = exercise.layout;
  const Vec3 corner(0.5 * layout.region_x_m, 0.5 * layout.region_y_m, layout.relief_m);
  const double start = exercise.start_above_m.norm() + exercise.start_sphere_m;
  SteeringReach reach;
  reach.radius_m = std::max(corner.norm(), start) + kToSpare_m;
  if (level.mapping == Mapping::kFulcrum) {
    reach.port_T = level.port_m;
    reach.most_roll_rad = kRollThroughPort;
  } else if (kind_of(exercise).rolls_stylus) {
    reach.rolls_stylus = true;
    reach.most_roll_rad = kRollThroughPort;
  }
  return reach;
}

Vec3 within_ball(const Vec3& p_T, const Vec3& centre_T, double radius_m) {
  const Vec3 out = p_T - centre_T;
  const double r = out.norm();
  return r > radius_m ? Vec3(centre_T + out * (radius_m / r)) : p_T;
}

}  // namespace trocar
