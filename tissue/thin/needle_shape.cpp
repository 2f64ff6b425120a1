#include "tissue/thin/needle_shape.h"

#include <cmath>

namespace trocar {

Vec3 NeedleShape::place(double arc_m) const {
  const double angle = arc_m / radius_m();
  return radius_m() * Vec3(std::cos(angle), std::sin(angle), 0);
}

Vec3 NeedleShape::tangent(double arc_m) const {
  const double angle = arc_m / radius_m();
  return {-std::sin(angle), std::cos(angle), 0};
}

double NeedleShape::radius_at(double arc_m) const {
  const double before_tip = std::clamp(length_m - arc_m, 0.0, taper_m);
  return tip_radius_m + (wire_radius_m - tip_radius_m) * before_tip / taper_m;
}

BesideNeedle beside_needle(const NeedleShape& shape, const Vec3& place_N) {
  // The gap of the circle lies opposite the needle's middle: there the arc jumps.
  const double middle = shape.length_m / (2 * shape.radius_m());
  const double turned = std::atan2(place_N.y(), place_N.x()) - middle;
  const double angle = middle + std::remainder(turned, 2 * std::numbers::pi);
  return {angle * shape.radius_m(), std::hypot(place_N.x(), place_N.y()) - shape.radius_m(), place_N.z()};
}

TriangleSurface needle_tube(const NeedleShape& shape, int sides, int rings) {
  TriangleSurface out;
  for (int r = 0; r < rings; ++r) {
    const double arc = shape.length_m * r / (rings - 1), angle = arc / shape.radius_m();
    const Vec3 outward(std::cos(angle), std::sin(angle), 0);
    for (int s = 0; s < sides; ++s) {
      const double turn = 2 * std::numbers::pi * s / sides;
      out.vertices.push_back(shape.place(arc) +
                             shape.radius_at(arc) * (std::cos(turn) * outward + std::sin(turn) * Vec3::UnitZ()));
    }
  }
  const auto id = [sides](int r, int s) { return r * sides + s % sides; };
  for (int r = 0; r + 1 < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      out.triangles.push_back({id(r, s), id(r, s + 1), id(r + 1, s + 1)});
      out.triangles.push_back({id(r, s), id(r + 1, s + 1), id(r + 1, s)});
    }
  const auto swage = static_cast<std::int32_t>(out.vertices.size());
  out.vertices.push_back(shape.place(0));
  out.vertices.push_back(shape.place(shape.length_m));
  for (int s = 0; s < sides; ++s) {
    out.triangles.push_back({swage, id(0, s + 1), id(0, s)});
    out.triangles.push_back({swage + 1, id(rings - 1, s), id(rings - 1, s + 1)});
  }
  return out;
}

SurfacePtr needle_surface(const SurfacePtr& tube_N, const Pose& X_TN) {
  std::vector<Vec3> vertices;
  vertices.reserve(tube_N->vertices.size());
  for (const Vec3& vertex : tube_N->vertices) vertices.push_back(X_TN * vertex);
  return moved_surface(tube_N, std::move(vertices));
}

}  // namespace trocar
