#include "tissue/mesh/surface/surface_check.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "tissue/mesh/surface/cgal_mesh.h"
#include "tissue/mesh/surface/distance_samples.h"
#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/mesh/surface/triangle_crossing.h"

namespace trocar {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
constexpr std::size_t kDenseTriangles = 20000;  ///< from here on a triangle is small enough for one sample
constexpr std::size_t kMostSamples = 60000;     ///< of a denser surface every second, third, ... triangle is sampled

/// Centroid and, on coarse surfaces, edge midpoints of each triangle, sharing its area.
std::vector<DistanceSample> distance_samples(const TriangleSurface& from, const NearestSurface& to) {
  std::vector<DistanceSample> samples;
  std::size_t last = 0;  // neighbouring samples follow each other: the last answer is a good guess
  const auto measure = [&](const Vec3& place, double area) {
    const NearestSurface::Hit hit = to.nearest(place, last);
    last = hit.triangle;
    samples.push_back({(place - hit.place).norm(), area});
  };
  const std::size_t stride = std::max<std::size_t>(1, (from.triangles.size() + kMostSamples - 1) / kMostSamples);
  for (std::size_t t = 0; t < from.triangles.size(); t += stride) {
    const auto& triangle = from.triangles[t];
    std::array<Vec3, 3> p;
    for (std::size_t n = 0; n < 3; ++n) p[n] = from.vertices[static_cast<std::size_t>(triangle[n])];
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    const bool dense = from.triangles.size() >= kDenseTriangles;
    measure((p[0] + p[1] + p[2]) / 3, dense ? area : area / 4);
    for (std::size_t n = 0; n < 3 && !dense; ++n) measure((p[n] + p[(n + 1) % 3]) / 2, area / 4);
  }
  return samples;
}

std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> cutting_pairs(const TriangleSurface& surface) {
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  pmp::self_intersections(half_edge_mesh(surface), std::back_inserter(pairs));
  return pairs;
}

/// A triangle of one of several surfaces, its corners numbered by their coordinates: equal ones have one number.
struct OwnedTriangle {
  std::size_t surface = 0;
  NumberedTriangle triangle;
};

std::vector<OwnedTriangle> owned_triangles(const std::vector<const TriangleSurface*>& surfaces) {
  std::map<std::array<double, 3>, std::int32_t> numbers;
  std::vector<OwnedTriangle> owned;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (const auto& triangle : surfaces[s]->triangles) {
      OwnedTriangle one{s, {}};
      for (std::size_t n = 0; n < 3; ++n) {
        const Vec3& p = surfaces[s]->vertices[static_cast<std::size_t>(triangle[n])];
        one.triangle.corners[n] =
            numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::int32_t>(numbers.size())).first->second;
        one.triangle.points[n] = p;
      }
      if (has_area(one.triangle)) owned.push_back(one);
    }
  return owned;
}

CGAL::Bbox_3 box_of(const NumberedTriangle& triangle) {
  return to_point(triangle.points[0]).bbox() + to_point(triangle.points[1]).bbox() +
         to_point(triangle.points[2]).bbox();
}

}  // namespace

std::vector<SurfaceCrossing> surface_crossings(const std::vector<const TriangleSurface*>& surfaces) {
  const std::vector<OwnedTriangle> owned = owned_triangles(surfaces);
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> boxes;
  for (std::size_t n = 0; n < owned.size(); ++n) boxes.emplace_back(box_of(owned[n].triangle), n);
  std::map<std::array<std::size_t, 2>, std::size_t> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& p, const Box& q) {
    const OwnedTriangle &a = owned[p.info()], &b = owned[q.info()];
    if (a.surface != b.surface && triangles_cross(a.triangle, b.triangle))
      ++found[{std::min(a.surface, b.surface), std::max(a.surface, b.surface)}];
  });
  std::vector<SurfaceCrossing> crossings;
  for (const auto& [which, pairs] : found) crossings.push_back({which[0], which[1], pairs});
  return crossings;
}

std::size_t count_self_intersections(const TriangleSurface& surface) { return cutting_pairs(surface).size(); }

std::vector<std::int32_t> self_intersecting(const TriangleSurface& surface) {
  std::vector<std::int32_t> faces;
  for (const auto& [a, b] : cutting_pairs(surface))
    for (const auto face : {a, b}) faces.push_back(static_cast<std::int32_t>(face.idx()));
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::size_t orient_outward(TriangleSurface& surface) {
  SurfaceSoup soup(surface);
  if (!pmp::orient_polygon_soup(soup.points, soup.faces) || soup.points.size() != surface.vertices.size())
    throw std::invalid_argument("orient_outward: the surface is not manifold");
  SurfaceMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);
  if (!CGAL::is_closed(mesh)) throw std::invalid_argument("orient_outward: the surface is open");
  pmp::orient_to_bound_a_volume(mesh);
  std::size_t turned = 0;
  for (const auto face : mesh.faces()) {
    std::array<std::int32_t, 3> triangle = corners_of(mesh, face);
    auto& old = surface.triangles[face.idx()];
    const auto first = std::find(triangle.begin(), triangle.end(), old[0]);
    std::rotate(triangle.begin(), first, triangle.end());
    turned += triangle == old ? 0 : 1;
    old = triangle;
  }
  return turned;
}

SurfaceDistance weighted_by_area(std::vector<DistanceSample> samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const DistanceSample& a, const DistanceSample& b) { return a.distance_m < b.distance_m; });
  double area = 0;
  for (const DistanceSample& sample : samples) area += sample.area_m2;
  SurfaceDistance result;
  double below = 0;
  for (const DistanceSample& sample : samples) {
    result.mean_m += sample.distance_m * sample.area_m2 / area;
    result.rms_m += sample.distance_m * sample.distance_m * sample.area_m2 / area;
    if (below < 0.99 * area) result.p99_m = sample.distance_m;
    below += sample.area_m2;
  }
  result.rms_m = std::sqrt(result.rms_m);
  result.max_m = samples.empty() ? 0 : samples.back().distance_m;
  return result;
}

SurfaceDistance distance_from_to(const TriangleSurface& from, const TriangleSurface& to) {
  return weighted_by_area(distance_samples(from, NearestSurface(to)));
}

}  // namespace trocar
