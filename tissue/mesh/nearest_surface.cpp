#include "tissue/mesh/nearest_surface.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>

namespace trocar {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct NearestSurface::Parts {
  std::vector<Triangle> triangles;
  Tree tree;
};

NearestSurface::NearestSurface(const TriangleSurface& surface) : parts_(std::make_unique<Parts>()) {
  if (surface.triangles.empty()) throw std::invalid_argument("NearestSurface: no triangles");
  const auto corner = [&](std::int32_t index) {
    const Vec3& p = surface.vertices[static_cast<std::size_t>(index)];
    return Point(p.x(), p.y(), p.z());
  };
  for (const auto& [a, b, c] : surface.triangles) parts_->triangles.emplace_back(corner(a), corner(b), corner(c));
  parts_->tree.insert(parts_->triangles.cbegin(), parts_->triangles.cend());
  parts_->tree.build();
}

NearestSurface::~NearestSurface() = default;
NearestSurface::NearestSurface(NearestSurface&&) noexcept = default;
NearestSurface& NearestSurface::operator=(NearestSurface&&) noexcept = default;

NearestSurface::Hit NearestSurface::nearest(const Vec3& point) const {
  const auto [q, primitive] = parts_->tree.closest_point_and_primitive(Point(point.x(), point.y(), point.z()));
  const auto index = static_cast<std::size_t>(primitive - parts_->triangles.cbegin());
  const Triangle& t = parts_->triangles[index];
  const auto vec = [](const Point& p) { return Vec3(p.x(), p.y(), p.z()); };
  const Vec3 a = vec(t[0]);
  return {vec(q), (vec(t[1]) - a).cross(vec(t[2]) - a), index};
}

}  // namespace trocar
