#include "tissue/mesh/surface/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b) {
  return std::atan2((a - at).cross(b - at).norm(), (a - at).dot(b - at)) * 180 / std::numbers::pi;
}

/// @param sorted ascending, not empty
double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(rank, sorted.size() - 1)];
}

/// Every edge of a closed surface once; on an open one its border edges too when they run upwards.
std::vector<double> edge_lengths_m(const TriangleSurface& surface) {
  std::vector<double> lengths;
  for (const auto& triangle : surface.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      const auto from = triangle[n], to = triangle[(n + 1) % 3];
      if (from < to)
        lengths.push_back(
            (surface.vertices[static_cast<std::size_t>(to)] - surface.vertices[static_cast<std::size_t>(from)]).norm());
    }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

}  // namespace

std::vector<double> smallest_angles_deg(const TriangleSurface& surface) {
  std::vector<double> angles;
  angles.reserve(surface.triangles.size());
  for (const auto& triangle : surface.triangles) {
    const Vec3& a = surface.vertices[static_cast<std::size_t>(triangle[0])];
    const Vec3& b = surface.vertices[static_cast<std::size_t>(triangle[1])];
    const Vec3& c = surface.vertices[static_cast<std::size_t>(triangle[2])];
    const bool flat = (b - a).cross(c - a).norm() <= 0;
    angles.push_back(flat ? 0 : std::min({angle_deg(a, b, c), angle_deg(b, c, a), angle_deg(c, a, b)}));
  }
  return angles;
}

MeshQuality mesh_quality(const TriangleSurface& surface) {
  MeshQuality quality;
  if (surface.triangles.empty()) return quality;
  std::vector<double> angles = smallest_angles_deg(surface);
  std::sort(angles.begin(), angles.end());
  quality.min_angle_deg = angles.front();
  quality.p01_angle_deg = quantile(angles, 0.01);
  const auto sharp = std::lower_bound(angles.begin(), angles.end(), 15.0) - angles.begin();
  quality.share_above_15 = 1 - static_cast<double>(sharp) / static_cast<double>(angles.size());
  const std::vector<double> edges = edge_lengths_m(surface);
  if (edges.empty()) return quality;
  quality.edge_min_m = edges.front();
  quality.edge_p05_m = quantile(edges, 0.05);
  quality.edge_median_m = quantile(edges, 0.5);
  quality.edge_p95_m = quantile(edges, 0.95);
  quality.edge_max_m = edges.back();
  return quality;
}

}  // namespace trocar
