// The wrap of rescue.h. The input may be any triangles: distances to it go through a tree of single triangles.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/plain_surface.h"
#include "tissue/mesh/surface/rescue.h"

namespace trocar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

Point to_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 to_vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

const Vec3& corner(const TriangleSurface& surface, const std::array<std::int32_t, 3>& triangle, std::size_t n) {
  return surface.vertices[static_cast<std::size_t>(triangle[n])];
}

Triangles single_triangles(const TriangleSurface& surface) {
  Triangles result;
  for (const auto& triangle : surface.triangles) {
    const Kernel::Triangle_3 single(to_point(corner(surface, triangle, 0)), to_point(corner(surface, triangle, 1)),
                                    to_point(corner(surface, triangle, 2)));
    if (!single.is_degenerate()) result.push_back(single);
  }
  return result;
}

struct Sample {
  double distance_m, area_m2;
};

/// Centroid and corners of each triangle, sharing its area.
SurfaceDistance distances(const TriangleSurface& from, const Tree& to) {
  std::vector<Sample> samples;
  double area = 0, below = 0;
  for (const auto& triangle : from.triangles) {
    std::array<Vec3, 4> p{corner(from, triangle, 0), corner(from, triangle, 1), corner(from, triangle, 2),
                          Vec3::Zero()};
    p[3] = (p[0] + p[1] + p[2]) / 3;
    const double share = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 8;
    for (const Vec3& q : p) samples.push_back({std::sqrt(to.squared_distance(to_point(q))), share}), area += share;
  }
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.distance_m < b.distance_m; });
  SurfaceDistance result;
  for (const Sample& sample : samples) {
    result.mean_m += sample.distance_m * sample.area_m2 / area;
    if (below < 0.99 * area) result.p99_m = sample.distance_m;
    below += sample.area_m2;
  }
  result.max_m = samples.empty() ? 0 : samples.back().distance_m;
  return result;
}

TriangleSurface wrap(const TriangleSurface& soup, double alpha_m, double offset_m) {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  for (const Vec3& p : soup.vertices) points.push_back(to_point(p));
  for (const auto& [a, b, c] : soup.triangles)
    faces.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  Mesh mesh;
  CGAL::alpha_wrap_3(points, faces, alpha_m, offset_m, mesh);
  mesh.collect_garbage();
  return plain_surface(mesh);
}

/// Each vertex goes the same share of the way to the nearest point of the input, as far as nothing cuts itself.
TriangleSurface pulled_back(const TriangleSurface& laid, const Tree& input, double& share) {
  std::vector<Vec3> nearest;
  for (const Vec3& vertex : laid.vertices) nearest.push_back(to_vec(input.closest_point(to_point(vertex))));
  for (const double trial : {0.98, 0.9, 0.75, 0.5, 0.25}) {
    TriangleSurface moved = laid;
    for (std::size_t v = 0; v < nearest.size(); ++v) moved.vertices[v] += trial * (nearest[v] - moved.vertices[v]);
    if (count_self_intersections(moved) > 0) continue;
    share = trial;
    return moved;
  }
  share = 0;
  return laid;
}

void check_settings(const TriangleSurface& soup, double alpha_m, double offset_m, const std::string& file) {
  constexpr double kFinest = 250,
                   kThinnest = 100;  // of the diagonal by alpha, of alpha by offset: bound time and memory
  const double diagonal_m = soup.bounds().diagonal().norm();
  if (alpha_m < diagonal_m / kFinest)
    throw InputError(file + ": a wrap alpha of " + std::to_string(alpha_m * 1e3) + " mm is too fine: at least " +
                     std::to_string(diagonal_m / kFinest * 1e3) + " mm is wanted for a surface of this size");
  if (offset_m < alpha_m / kThinnest || offset_m > alpha_m)
    throw InputError(file + ": the wrap offset must lie between a hundredth of alpha and alpha");
}

}  // namespace

TriangleSurface shrink_wrapped(const TriangleSurface& soup, double alpha_m, double offset_m, WrapFacts& facts,
                               const std::string& file) {
  check_settings(soup, alpha_m, offset_m, file);
  const Triangles triangles = single_triangles(soup);
  if (triangles.empty()) throw InputError(file + ": nothing to wrap: every triangle is without area");
  Tree input(triangles.begin(), triangles.end());
  input.build();
  const TriangleSurface laid = wrap(soup, alpha_m, offset_m);
  if (laid.triangles.empty()) throw InputError(file + ": the wrap encloses nothing: choose a smaller alpha");
  facts.volume_outside_m3 = laid.volume_m3();
  TriangleSurface result = pulled_back(laid, input, facts.pulled_back);
  facts.volume_m3 = result.volume_m3();
  facts.to_input = distances(result, input);
  const Triangles wrapped_triangles = single_triangles(result);
  Tree output(wrapped_triangles.begin(), wrapped_triangles.end());
  output.build();
  facts.from_input = distances(soup, output);
  return result;
}

}  // namespace trocar
