#include "tissue/mesh/surface_fit.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace trocar {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;  // nearest points need no exact predicates: twice as fast
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point to_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

std::array<Vec3, 3> corners(const TriangleSurface& surface, std::size_t triangle) {
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(surface.triangles[triangle][n])];
  return p;
}

/// Shares of the three corners at a point of the triangle, by areas.
Vec3 barycentric(const std::array<Vec3, 3>& p, const Vec3& point) {
  Vec3 shares;
  for (std::size_t n = 0; n < 3; ++n)
    shares[static_cast<Eigen::Index>(n)] = (p[(n + 1) % 3] - point).cross(p[(n + 2) % 3] - point).norm();
  const double sum = shares.sum();
  return sum > 0 ? Vec3(shares / sum) : Vec3::Constant(1.0 / 3);
}

/// Samples used at each sweep: of a denser target every second, third, ... vertex.
std::size_t sample_stride(const TriangleSurface& surface, const TriangleSurface& target) {
  constexpr std::size_t kSamplesPerTriangle = 8;
  return std::max<std::size_t>(1, target.vertices.size() / (kSamplesPerTriangle * surface.triangles.size() + 1));
}

void sweep(TriangleSurface& surface, const TriangleSurface& target, const std::vector<Vec3>& target_normals) {
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto p = corners(surface, t);
    triangles.emplace_back(to_point(p[0]), to_point(p[1]), to_point(p[2]));
  }
  const Tree tree(triangles.cbegin(), triangles.cend());
  std::vector<Vec3> moments(surface.vertices.size(), Vec3::Zero());
  std::vector<double> weights(surface.vertices.size(), 0.0);
  auto nearest =
      tree.any_reference_point_and_id();  // neighbouring samples follow each other: the last answer is a good guess
  const std::size_t stride = sample_stride(surface, target);
  for (std::size_t n = 0; n < target.vertices.size(); n += stride) {
    const Vec3& sample = target.vertices[n];
    nearest = tree.closest_point_and_primitive(to_point(sample), nearest);
    const auto& [point, primitive] = nearest;
    const auto triangle = static_cast<std::size_t>(primitive - triangles.cbegin());
    const Vec3 closest(point.x(), point.y(), point.z());
    const auto p = corners(surface, triangle);
    if ((p[1] - p[0]).cross(p[2] - p[0]).dot(target_normals[n]) <= 0) continue;  // the other side of something thin
    const Vec3 shares = barycentric(p, closest);
    for (std::size_t m = 0; m < 3; ++m) {
      const auto vertex = static_cast<std::size_t>(surface.triangles[triangle][m]);
      moments[vertex] += shares[static_cast<Eigen::Index>(m)] * (sample - closest);
      weights[vertex] += shares[static_cast<Eigen::Index>(m)];
    }
  }
  const std::vector<Vec3> normals = surface.vertex_normals();
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (weights[v] > 0) surface.vertices[v] += normals[v] * normals[v].dot(moments[v]) / weights[v];
}

}  // namespace

TriangleSurface fitted(const TriangleSurface& surface, const TriangleSurface& target, int sweeps) {
  TriangleSurface result = surface;
  const std::vector<Vec3> normals = target.vertex_normals();
  for (int n = 0; n < sweeps; ++n) sweep(result, target, normals);
  return result;
}

}  // namespace trocar
