// The wrap of rescue.h. The input may be any triangles: distances to it go through a tree of single triangles.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/cgal_mesh.h"
#include "tissue/mesh/surface/distance_samples.h"
#include "tissue/mesh/surface/rescue.h"

namespace trocar {
namespace {

using Triangles = std::vector<SurfaceKernel::Triangle_3>;
using TriangleTree = CGAL::AABB_tree<
    CGAL::AABB_traits<SurfaceKernel, CGAL::AABB_triangle_primitive<SurfaceKernel, Triangles::const_iterator>>>;

const Vec3& corner(const TriangleSurface& surface, const std::array<std::int32_t, 3>& triangle, std::size_t n) {
  return surface.vertices[static_cast<std::size_t>(triangle[n])];
}

Triangles single_triangles(const TriangleSurface& surface) {
  Triangles result;
  for (const auto& triangle : surface.triangles) {
    const SurfaceKernel::Triangle_3 single(to_point(corner(surface, triangle, 0)),
                                           to_point(corner(surface, triangle, 1)),
                                           to_point(corner(surface, triangle, 2)));
    if (!single.is_degenerate()) result.push_back(single);
  }
  return result;
}

/// Centroid and corners of each triangle, sharing its area.
SurfaceDistance distances(const TriangleSurface& from, const TriangleTree& to) {
  std::vector<DistanceSample> samples;
  for (const auto& triangle : from.triangles) {
    std::array<Vec3, 4> p{corner(from, triangle, 0), corner(from, triangle, 1), corner(from, triangle, 2),
                          Vec3::Zero()};
    p[3] = (p[0] + p[1] + p[2]) / 3;
    const double share = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 8;
    for (const Vec3& q : p) samples.push_back({std::sqrt(to.squared_distance(to_point(q))), share});
  }
  return weighted_by_area(std::move(samples));
}

TriangleSurface wrap(const TriangleSurface& soup, double alpha_m, double offset_m) {
  const SurfaceSoup all(soup);
  SurfaceMesh mesh;
  CGAL::alpha_wrap_3(all.points, all.faces, alpha_m, offset_m, mesh);
  mesh.collect_garbage();
  return plain_surface(mesh);
}

/// Each vertex goes the same share of the way to the nearest point of the input, as far as nothing cuts itself.
TriangleSurface pulled_back(const TriangleSurface& laid, const TriangleTree& input, double& share) {
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
  TriangleTree input(triangles.begin(), triangles.end());
  input.build();
  const TriangleSurface laid = wrap(soup, alpha_m, offset_m);
  if (laid.triangles.empty()) throw InputError(file + ": the wrap encloses nothing: choose a smaller alpha");
  facts.volume_outside_m3 = laid.volume_m3();
  TriangleSurface result = pulled_back(laid, input, facts.pulled_back);
  facts.volume_m3 = result.volume_m3();
  facts.to_input = distances(result, input);
  const Triangles wrapped_triangles = single_triangles(result);
  TriangleTree output(wrapped_triangles.begin(), wrapped_triangles.end());
  output.build();
  facts.from_input = distances(soup, output);
  return result;
}

}  // namespace trocar
