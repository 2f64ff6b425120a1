#include "tissue/mesh/surface/triangle_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

using CrossingKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CrossingPoint = CrossingKernel::Point_3;

constexpr double kDoubt = 1e-10;  ///< of the lengths multiplied: nearer to 0 a sign is left to exact predicates

CrossingPoint exact(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

CrossingKernel::Triangle_3 exact(const NumberedTriangle& t) {
  return {exact(t.points[0]), exact(t.points[1]), exact(t.points[2])};
}

Vec3 normal_of(const NumberedTriangle& t) { return (t.points[1] - t.points[0]).cross(t.points[2] - t.points[0]); }

/// Whether all corners of b lie surely on one side of the plane of a.
bool surely_beside(const NumberedTriangle& a, const NumberedTriangle& b) {
  const Vec3 normal = normal_of(a);
  int above = 0, below = 0;
  for (const Vec3& p : b.points) {
    const Vec3 from = p - a.points[0];
    const double height = normal.dot(from), doubt = kDoubt * normal.norm() * from.norm();
    above += height > doubt ? 1 : 0, below += height < -doubt ? 1 : 0;
  }
  return above == 3 || below == 3;
}

/// Whether the angles of two triangles at their common first corner surely have a plane between them.
bool surely_apart_at_corner(const NumberedTriangle& a, const NumberedTriangle& b) {
  std::array<Vec3, 4> ray;
  for (std::size_t n = 0; n < 2; ++n) {
    ray[n] = (a.points[n + 1] - a.points[0]).normalized();
    ray[n + 2] = (b.points[n + 1] - b.points[0]).normalized();
  }
  const Vec3 across = (ray[0] + ray[1]).normalized() - (ray[2] + ray[3]).normalized();
  return ray[0].dot(across) > kDoubt && ray[1].dot(across) > kDoubt && ray[2].dot(across) < -kDoubt &&
         ray[3].dot(across) < -kDoubt;
}

bool cross_at_corner(const NumberedTriangle& a, const NumberedTriangle& b) {
  const CrossingKernel::Segment_3 of_a(exact(a.points[1]), exact(a.points[2])),
      of_b(exact(b.points[1]), exact(b.points[2]));
  return !surely_apart_at_corner(a, b) && (CGAL::do_intersect(of_a, exact(b)) || CGAL::do_intersect(of_b, exact(a)));
}

/// Triangles of one edge overlap only when they lie in one plane, on one side of it.
bool overlap_at_edge(const NumberedTriangle& a, const NumberedTriangle& b) {
  const Vec3 edge = a.points[1] - a.points[0], of_a = a.points[2] - a.points[0], of_b = b.points[2] - a.points[0];
  if (std::abs(edge.cross(of_a).dot(of_b)) > kDoubt * edge.norm() * of_a.norm() * of_b.norm()) return false;
  const CrossingPoint p = exact(a.points[0]), q = exact(a.points[1]), r = exact(a.points[2]), s = exact(b.points[2]);
  return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
}

/// Of triangles of the same corners: back to back they are the common border of two bodies, alike one lies in the
/// other.
bool face_alike(const NumberedTriangle& a, const NumberedTriangle& b) { return normal_of(a).dot(normal_of(b)) > 0; }

}  // namespace

bool has_area(const NumberedTriangle& t) {
  return !CGAL::collinear(exact(t.points[0]), exact(t.points[1]), exact(t.points[2]));
}

bool triangles_cross(NumberedTriangle a, NumberedTriangle b) {
  const bool alike = face_alike(a, b);
  std::size_t shared = 0;  // the common corners are moved to the front of both
  for (std::size_t n = 0; n < 3; ++n) {
    const auto same = std::find(b.corners.begin() + static_cast<std::ptrdiff_t>(shared), b.corners.end(), a.corners[n]);
    if (same == b.corners.end()) continue;
    const auto m = static_cast<std::size_t>(same - b.corners.begin());
    std::swap(b.corners[m], b.corners[shared]), std::swap(b.points[m], b.points[shared]);
    std::swap(a.corners[n], a.corners[shared]), std::swap(a.points[n], a.points[shared]);
    ++shared;
  }
  if (shared == 0) return !surely_beside(a, b) && !surely_beside(b, a) && CGAL::do_intersect(exact(a), exact(b));
  if (shared == 1) return cross_at_corner(a, b);
  return shared == 2 ? overlap_at_edge(a, b) : alike;
}

}  // namespace trocar
