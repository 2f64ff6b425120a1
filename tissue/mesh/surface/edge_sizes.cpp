#include "tissue/mesh/surface/edge_sizes.h"

#include <algorithm>
#include <cmath>

#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr double kEquilateral = 0.4330127018922193;  ///< area over edge^2
constexpr double kFlat = 1e-3;                       ///< curvatures below this share of the median count as this much

std::size_t size_at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Directed edges (every edge of a closed surface twice) grouped by their first vertex.
struct Neighbours {
  std::vector<std::size_t> begin;  ///< one a vertex, and the end
  std::vector<std::int32_t> vertex;
};

Neighbours neighbours_of(const TriangleSurface& surface) {
  Neighbours result;
  result.begin.assign(surface.vertices.size() + 1, 0);
  for (const auto& triangle : surface.triangles)
    for (const auto corner : triangle) ++result.begin[size_at(corner) + 1];
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) result.begin[v + 1] += result.begin[v];
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  result.vertex.resize(result.begin.back());
  for (const auto& triangle : surface.triangles)
    for (std::size_t n = 0; n < 3; ++n) result.vertex[next[size_at(triangle[n])]++] = triangle[(n + 1) % 3];
  return result;
}

/// Every value becomes the mean of itself and its neighbours, `rounds` times.
template <typename Value>
void diffuse(std::vector<Value>& values, const Neighbours& neighbours, int rounds) {
  std::vector<Value> next(values.size(), values.empty() ? Value() : values[0]);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t v = 0; v < values.size(); ++v) {
      Value sum = values[v];
      for (std::size_t n = neighbours.begin[v]; n < neighbours.begin[v + 1]; ++n)
        sum += values[size_at(neighbours.vertex[n])];
      next[v] = sum / static_cast<double>(neighbours.begin[v + 1] - neighbours.begin[v] + 1);
    }
    values.swap(next);
  }
}

double mean_edge_m(const TriangleSurface& surface, const Neighbours& neighbours) {
  double sum = 0;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    for (std::size_t n = neighbours.begin[v]; n < neighbours.begin[v + 1]; ++n)
      sum += (surface.vertices[v] - surface.vertices[size_at(neighbours.vertex[n])]).norm();
  return neighbours.vertex.empty() ? 0 : sum / static_cast<double>(neighbours.vertex.size());
}

/// Largest normal curvature along the edges at each vertex, 1/m.
std::vector<double> curvatures(const TriangleSurface& surface, const Neighbours& neighbours, int rounds) {
  std::vector<Vec3> normals = surface.vertex_normals();
  diffuse(normals, neighbours, rounds);
  for (Vec3& normal : normals) normal /= std::max(normal.norm(), 1e-12);
  std::vector<double> result(surface.vertices.size(), 0);
  for (std::size_t v = 0; v < result.size(); ++v)
    for (std::size_t n = neighbours.begin[v]; n < neighbours.begin[v + 1]; ++n) {
      const auto other = size_at(neighbours.vertex[n]);
      const Vec3 along = surface.vertices[other] - surface.vertices[v];
      const double squared = along.squaredNorm();
      if (squared > 0) result[v] = std::max(result[v], std::abs((normals[other] - normals[v]).dot(along)) / squared);
    }
  diffuse(result, neighbours, std::max(1, rounds / 2));
  return result;
}

/// Sweeps to and fro until nothing changes.
void limit_size_growth(std::vector<double>& sizes, const TriangleSurface& surface, const Neighbours& neighbours,
                       double growth) {
  std::vector<std::uint8_t> stale(sizes.size(), 1);  // a neighbour was lowered since this one was looked at
  const auto lower = [&](std::size_t v) {
    bool changed = false;
    for (std::size_t n = neighbours.begin[v]; n < neighbours.begin[v + 1]; ++n) {
      const auto other = size_at(neighbours.vertex[n]);
      if (sizes[v] <= sizes[other]) continue;
      const double most = sizes[other] + growth * (surface.vertices[v] - surface.vertices[other]).norm();
      if (sizes[v] > most * (1 + 1e-9)) sizes[v] = most, changed = true;
    }
    for (std::size_t n = neighbours.begin[v]; changed && n < neighbours.begin[v + 1]; ++n)
      stale[size_at(neighbours.vertex[n])] = 1;
    return changed;
  };
  constexpr int kSweeps = 40;
  bool changed = true;
  for (int sweep = 0; changed && sweep < kSweeps; ++sweep) {
    changed = false;
    for (std::size_t n = 0; n < sizes.size(); ++n) {
      const std::size_t v = sweep % 2 == 0 ? n : sizes.size() - 1 - n;
      if (stale[v] == 0) continue;
      stale[v] = 0;
      changed = lower(v) || changed;
    }
  }
}

std::vector<double> vertex_areas_m2(const TriangleSurface& surface) {
  std::vector<double> areas(surface.vertices.size(), 0);
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3& p = surface.vertices[size_at(a)];
    const double third = (surface.vertices[size_at(b)] - p).cross(surface.vertices[size_at(c)] - p).norm() / 6;
    for (const auto corner : {a, b, c}) areas[size_at(corner)] += third;
  }
  return areas;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void limit_growth(std::vector<double>& sizes, const TriangleSurface& surface, double growth) {
  limit_size_growth(sizes, surface, neighbours_of(surface), growth);
}

double even_edge_m(const TriangleSurface& surface, std::size_t triangles) {
  return std::sqrt(surface_area_m2(surface) / static_cast<double>(std::max<std::size_t>(triangles, 1)) / kEquilateral);
}

std::vector<double> edge_sizes(const TriangleSurface& surface, const EdgeSizeOptions& options) {
  if (surface.triangles.empty()) return {};
  const Neighbours neighbours = neighbours_of(surface);
  const double mean_edge = mean_edge_m(surface, neighbours), reach = options.smoothing_m / std::max(mean_edge, 1e-12);
  const int rounds = std::clamp(static_cast<int>(std::lround(1.5 * reach * reach)), 1, 40);
  std::vector<double> sizes = curvatures(surface, neighbours, rounds);
  const double even = even_edge_m(surface, static_cast<std::size_t>(options.triangles));
  const double reference = std::max(median(sizes), 1e-6);
  for (double& size : sizes)
    size =
        even * std::clamp(std::sqrt(reference / std::max(size, kFlat * reference)), options.shortest, options.longest);
  limit_size_growth(sizes, surface, neighbours, options.growth);
  const std::vector<double> areas = vertex_areas_m2(surface);
  double count = 0;
  for (std::size_t v = 0; v < sizes.size(); ++v) count += areas[v] / (kEquilateral * sizes[v] * sizes[v]);
  const double scale = std::sqrt(count / options.triangles);
  for (double& size : sizes) size *= scale;
  return sizes;
}

}  // namespace trocar
