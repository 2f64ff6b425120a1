#include "tissue/mesh/surface/surface_check.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "tissue/mesh/surface/nearest_surface.h"

namespace trocar {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

std::vector<Point> points_of(const TriangleSurface& surface) {
  std::vector<Point> points;
  for (const Vec3& p : surface.vertices) points.emplace_back(p.x(), p.y(), p.z());
  return points;
}

std::vector<std::vector<std::size_t>> soup_of(const TriangleSurface& surface) {
  std::vector<std::vector<std::size_t>> soup;
  for (const auto& [a, b, c] : surface.triangles)
    soup.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  return soup;
}

Mesh to_cgal(const TriangleSurface& surface) {
  Mesh mesh;
  for (const Point& point : points_of(surface)) mesh.add_vertex(point);
  const auto vertex = [](std::int32_t index) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(index)); };
  for (const auto& [a, b, c] : surface.triangles)
    if (mesh.add_face(vertex(a), vertex(b), vertex(c)) == Mesh::null_face())
      throw std::invalid_argument("the surface is not an oriented manifold");
  return mesh;
}

struct Sample {
  double distance_m;
  double area_m2;
};

constexpr std::size_t kDenseTriangles = 20000;  ///< from here on a triangle is small enough for one sample
constexpr std::size_t kMostSamples = 60000;     ///< of a denser surface every second, third, ... triangle is sampled

/// Centroid and, on coarse surfaces, edge midpoints of each triangle, sharing its area; nearest first.
std::vector<Sample> sorted_samples(const TriangleSurface& from, const NearestSurface& to) {
  std::vector<Sample> samples;
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
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.distance_m < b.distance_m; });
  return samples;
}

}  // namespace

std::size_t count_self_intersections(const TriangleSurface& surface) {
  const Mesh mesh = to_cgal(surface);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

std::vector<std::int32_t> self_intersecting(const TriangleSurface& surface) {
  const Mesh mesh = to_cgal(surface);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<std::int32_t> faces;
  for (const auto& [a, b] : pairs)
    for (const auto face : {a, b}) faces.push_back(static_cast<std::int32_t>(face.idx()));
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::size_t orient_outward(TriangleSurface& surface) {
  auto points = points_of(surface);
  auto soup = soup_of(surface);
  if (!pmp::orient_polygon_soup(points, soup) || points.size() != surface.vertices.size())
    throw std::invalid_argument("orient_outward: the surface is not manifold");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, soup, mesh);
  if (!CGAL::is_closed(mesh)) throw std::invalid_argument("orient_outward: the surface is open");
  pmp::orient_to_bound_a_volume(mesh);
  std::size_t turned = 0;
  for (const auto face : mesh.faces()) {
    std::array<std::int32_t, 3> triangle{};
    std::size_t n = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle.at(n++) = static_cast<std::int32_t>(vertex.idx());
    auto& old = surface.triangles[face.idx()];
    const auto first = std::find(triangle.begin(), triangle.end(), old[0]);
    std::rotate(triangle.begin(), first, triangle.end());
    turned += triangle == old ? 0 : 1;
    old = triangle;
  }
  return turned;
}

SurfaceDistance distance_from_to(const TriangleSurface& from, const TriangleSurface& to) {
  const std::vector<Sample> samples = sorted_samples(from, NearestSurface(to));
  double area = 0;
  for (const Sample& sample : samples) area += sample.area_m2;
  SurfaceDistance result;
  double below = 0;
  for (const Sample& sample : samples) {
    result.mean_m += sample.distance_m * sample.area_m2 / area;
    result.rms_m += sample.distance_m * sample.distance_m * sample.area_m2 / area;
    if (below < 0.99 * area) result.p99_m = sample.distance_m;
    below += sample.area_m2;
  }
  result.rms_m = std::sqrt(result.rms_m);
  result.max_m = samples.empty() ? 0 : samples.back().distance_m;
  return result;
}

}  // namespace trocar
