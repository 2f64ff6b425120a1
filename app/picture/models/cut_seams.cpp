#include "app/picture/models/cut_seams.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

namespace trocar {
namespace {

constexpr double kCell_m = 0.006;     // triangles beside a lip are no longer than that
constexpr float kMillimetres = 1000;  // mm of a metre

using LipEdge = std::pair<Vec3, Vec3>;

double distance_to(const LipEdge& edge, const Vec3& point) {
  const Vec3 along = edge.second - edge.first;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - edge.first).dot(along) / length2, 0.0, 1.0) : 0;
  return (point - edge.first - share * along).norm();
}

/// Lips by cells of space, so that a vertex looks at those near it alone.
class LipCells {
 public:
  void add(const LipEdge& edge) {
    for (const auto& end : {edge.first, edge.second})
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) cells_[key(cell_of(end) + Eigen::Vector3i(x, y, z))].push_back(edge);
  }
  /// Infinite where no lip is near.
  double distance(const Vec3& point) const {
    double least = INFINITY;
    const auto found = cells_.find(key(cell_of(point)));
    if (found == cells_.end()) return least;
    for (const LipEdge& edge : found->second) least = std::min(least, distance_to(edge, point));
    return least;
  }

 private:
  static Eigen::Vector3i cell_of(const Vec3& point) { return (point / kCell_m).array().floor().cast<int>(); }
  static std::uint64_t key(const Eigen::Vector3i& cell) {
    std::uint64_t out = 0;
    for (const int i : cell) out = out << 21 | (static_cast<std::uint64_t>(i) & 0x1fffff);
    return out;
  }
  std::unordered_map<std::uint64_t, std::vector<LipEdge>> cells_;
};

/// The edges of the walls that no other wall shares.
std::vector<LipEdge> lips_of(const TriangleSurface& opened, const std::vector<bool>& inside) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  const auto each_edge = [&](const auto& visit) {
    for (std::size_t t = 0; t < inside.size(); ++t)
      for (std::size_t k = 0; inside[t] && k < 3; ++k) visit(opened.triangles[t][k], opened.triangles[t][(k + 1) % 3]);
  };
  each_edge([&](std::int32_t a, std::int32_t b) { edges.insert({a, b}); });
  std::vector<LipEdge> lips;
  each_edge([&](std::int32_t a, std::int32_t b) {
    if (!edges.contains({b, a}))
      lips.push_back({opened.vertices[static_cast<std::size_t>(a)], opened.vertices[static_cast<std::size_t>(b)]});
  });
  return lips;
}

}  // namespace

CutSeams open_seams(const SurfaceSnapshot& rest) {
  CutSeams out;
  out.surface = rest;
  if (rest.inside.empty()) return out;
  std::vector<bool> outer(rest.vertices.size(), false);
  out.straight.assign(rest.vertices.size(), false);
  for (std::size_t t = 0; t < rest.triangles.size(); ++t)
    for (const std::int32_t corner : rest.triangles[t])
      (rest.inside[t] ? out.straight : outer)[static_cast<std::size_t>(corner)] = true;
  std::unordered_map<std::int32_t, std::int32_t> twins;
  for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
    if (!rest.inside[t]) continue;
    for (std::int32_t& corner : out.surface.triangles[t]) {
      if (!outer[static_cast<std::size_t>(corner)]) continue;
      const auto next = static_cast<std::int32_t>(out.surface.vertices.size());
      const auto [twin, added] = twins.try_emplace(corner, next);
      if (added) {
        out.surface.vertices.push_back(rest.vertices[static_cast<std::size_t>(corner)]);
        out.twin_of.push_back(corner);
        out.straight.push_back(true);
      }
      corner = twin->second;
    }
  }
  return out;
}

std::vector<float> cut_places(const TriangleSurface& opened, const std::vector<bool>& inside) {
  LipCells lips;
  for (const LipEdge& edge : lips_of(opened, inside)) lips.add(edge);
  std::vector<bool> wall(opened.vertices.size(), false);
  for (std::size_t t = 0; t < inside.size(); ++t)
    for (std::size_t k = 0; inside[t] && k < 3; ++k) wall[static_cast<std::size_t>(opened.triangles[t][k])] = true;
  std::vector<float> out(opened.vertices.size(), kFarFromCut);
  for (std::size_t v = 0; v < out.size(); ++v) {
    const double distance = lips.distance(opened.vertices[v]);
    // The bottom of a deep cut may have no lip in reach.
    const float mm = kMillimetres * static_cast<float>(std::isfinite(distance) ? distance : 2 * kCell_m);
    if (wall[v])
      out[v] = kLipOfWall + mm;
    else if (std::isfinite(distance))
      out[v] = kLipOutside - mm;
  }
  return out;
}

}  // namespace trocar
