#include "tissue/collision/surface_walk.h"

#include <algorithm>
#include <limits>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

constexpr double kSameFoot = 1e-7;  // m: feet on an edge that triangles share

}  // namespace

SurfaceWalk::SurfaceWalk(const TriangleSurface& surface)
    : triangles_(surface.triangles), first_(surface.vertices.size() + 1, 0) {
  for (const auto& triangle : triangles_)
    for (const std::int32_t v : triangle) ++first_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  at_vertex_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const std::int32_t v : triangles_[t])
      at_vertex_[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<std::int32_t>(t);
}

std::span<const std::int32_t> SurfaceWalk::round(std::int32_t vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return std::span(at_vertex_)
      .subspan(static_cast<std::size_t>(first_[v]), static_cast<std::size_t>(first_[v + 1] - first_[v]));
}

std::int32_t SurfaceWalk::nearest(std::span<const Vec3> vertices, const Vec3& place, std::int32_t from) const {
  const auto distance = [&](std::int32_t v) { return (vertices[static_cast<std::size_t>(v)] - place).squaredNorm(); };
  std::int32_t best = from;
  if (best < 0 || best + 1 >= static_cast<std::int32_t>(first_.size())) {
    best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t v = 0; v + 1 < static_cast<std::int32_t>(first_.size()); ++v) {
      const double here = distance(v);
      if (here < least) least = here, best = v;
    }
    return best;
  }
  double least = distance(best);
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const std::int32_t t : round(best))
      for (const std::int32_t v : triangles_[static_cast<std::size_t>(t)])
        if (const double here = distance(v); here < least) least = here, from = v, nearer = true;
    best = from;
  }
  return best;
}

SurfaceFoot SurfaceWalk::foot(std::span<const Vec3> vertices, const Vec3& place, std::int32_t& vertex) const {
  vertex = nearest(vertices, place, vertex);
  // A foot may lie beyond the triangles at the nearest vertex: those of its neighbours too.
  std::vector<std::int32_t> near;
  for (const std::int32_t t : round(vertex))
    for (const std::int32_t v : triangles_[static_cast<std::size_t>(t)])
      near.insert(near.end(), round(v).begin(), round(v).end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  SurfaceFoot out;
  double least = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();
  for (const std::int32_t t : near) {
    const auto& [a, b, c] = triangles_[static_cast<std::size_t>(t)];
    const std::array<Vec3, 3> corner{vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)],
                                     vertices[static_cast<std::size_t>(c)]};
    const Vec3 point = closest_point_on_triangle(place, corner);
    const double distance = (point - place).norm();
    if (distance > least + kSameFoot) continue;
    if (distance < least - kSameFoot) normal = Vec3::Zero();
    normal += (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    if (distance >= least) continue;
    least = distance;
    out.place = {t, barycentric_of(point, corner)};
    out.point = point;
  }
  if (normal.norm() > 0) out.normal = normal.normalized();
  out.height_m = (place - out.point).dot(out.normal) < 0 ? -least : least;
  return out;
}

}  // namespace trocar
