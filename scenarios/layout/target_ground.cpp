#include "scenarios/layout/target_ground.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kSurroundings = 0.006;  // m round a target in which the surface must stay near its tangent plane
constexpr double kUnevenness = 0.003;    // m, "near"
constexpr double kStep = 0.004;          // m, raster of the area
constexpr double kOpenJaws = 0.014;      // m to the sides: half of what they open, and as much as they lean

}  // namespace

bool TargetGround::is_even(const SurfacePoint& point) const {
  if (point.slope_rad > layout.max_slope_rad || std::abs(point.position.z() - centre_z) > layout.relief_m) return false;
  if (std::acos(std::clamp(point.normal.z(), -1.0, 1.0)) > layout.max_slope_rad) return false;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * M_PI / 4;
    const auto near = field.top(point.position.x() + kSurroundings * std::cos(angle),
                                point.position.y() + kSurroundings * std::sin(angle));
    if (!near || std::abs((near->position - point.position).dot(point.normal)) > kUnevenness) return false;
  }
  return true;
}

bool TargetGround::carries(const SurfacePoint& point) const {
  const auto near = [&](const Vec3& strand) { return (strand - point.position).head<2>().norm() < kOpenJaws; };
  return is_even(point) && std::none_of(strands_T.begin(), strands_T.end(), near) &&
         (room == nullptr || room->free(point.position, point.normal));
}

double closest_spacing(const TargetLayout& layout) { return 2 * (layout.radius_m + layout.wrong_place_m); }

GroundArea ground_area(const TargetGround& ground) {
  const double margin = closest_spacing(ground.layout) / 2;
  const double half_x = ground.layout.region_x_m / 2 - margin, half_y = ground.layout.region_y_m / 2 - margin;
  GroundArea area;
  for (double x = -half_x; x <= half_x; x += kStep)
    for (double y = -half_y; y <= half_y; y += kStep) {
      const auto point = ground.field.top(x, y);
      if (!point || !ground.is_even(*point)) continue;
      area.even_m2 += kStep * kStep;
      if (ground.carries(*point)) area.free_m2 += kStep * kStep;
    }
  return area;
}

}  // namespace trocar
