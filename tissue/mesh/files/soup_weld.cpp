#include "tissue/mesh/files/soup_weld.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "tissue/mesh/files/surface_file.h"

namespace trocar {
namespace {

using Index = std::int32_t;
using Triangle = std::array<Index, 3>;

/// Merged vertices so far, found by place. Cells are 4 tolerances wide, so a cell holds few merged vertices and a
/// search looks into the neighbours only where it is within a tolerance of them.
class VertexGrid {
 public:
  explicit VertexGrid(double tolerance_m) : tolerance_(tolerance_m), cell_(4 * tolerance_m) {}

  Index merged(const Vec3& point) {
    std::array<std::int64_t, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      low[static_cast<std::size_t>(axis)] = cell_of(point[axis] - tolerance_);
      high[static_cast<std::size_t>(axis)] = cell_of(point[axis] + tolerance_);
    }
    Index best = -1;
    for (auto i = low[0]; i <= high[0]; ++i)
      for (auto j = low[1]; j <= high[1]; ++j)
        for (auto k = low[2]; k <= high[2]; ++k) {
          const Index found = first_near(key(i, j, k), point);
          if (found >= 0 && (best < 0 || found < best)) best = found;
        }
    return best >= 0 ? best : added(point);
  }

  std::vector<Vec3> vertices;

 private:
  std::int64_t cell_of(double coordinate) const { return static_cast<std::int64_t>(std::floor(coordinate / cell_)); }

  /// Cells that share a key only cost time.
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    const auto mix = [](std::uint64_t h, std::int64_t v) {
      return (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ULL;
    };
    std::uint64_t hash = mix(mix(mix(0x51ED270B, i) ^ 0x2545F491, j), k);
    return hash ^ hash >> 29;
  }

  Index first_near(std::uint64_t cell, const Vec3& point) const {
    const auto head = head_.find(cell);
    Index best = -1;
    if (head == head_.end()) return best;
    for (Index n = head->second; n >= 0; n = next_[static_cast<std::size_t>(n)])
      if ((vertices[static_cast<std::size_t>(n)] - point).squaredNorm() <= tolerance_ * tolerance_)
        best = n;  // the chain runs backwards
    return best;
  }

  Index added(const Vec3& point) {
    const auto index = static_cast<Index>(vertices.size());
    const auto [head, fresh] = head_.try_emplace(key(cell_of(point[0]), cell_of(point[1]), cell_of(point[2])), index);
    next_.push_back(fresh ? -1 : head->second);
    head->second = index;
    vertices.push_back(point);
    return index;
  }

  double tolerance_, cell_;
  std::unordered_map<std::uint64_t, Index> head_;  ///< looked up only, never walked
  std::vector<Index> next_;
};

struct Copy {
  Triangle sorted;
  Index triangle;
  bool odd;  ///< winding against the sorted order
};

Copy copy_of(const Triangle& t, std::size_t number) {
  Copy copy{t, static_cast<Index>(number), false};
  for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {0U, 1U}})
    if (copy.sorted[a] > copy.sorted[b]) std::swap(copy.sorted[a], copy.sorted[b]), copy.odd = !copy.odd;
  return copy;
}

/// Which triangles stay.
std::vector<bool> without_copies(const std::vector<Triangle>& triangles, WeldFacts& facts) {
  std::vector<Copy> copies;
  copies.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) copies.push_back(copy_of(triangles[t], t));
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle;
  });
  std::vector<bool> stays(triangles.size(), true);
  std::vector<Index> cancelled;  // the first of each group of which no side is in excess
  for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
    std::size_t odd = 0;
    for (; end < copies.size() && copies[end].sorted == copies[begin].sorted; ++end) {
      odd += copies[end].odd ? 1 : 0;
      stays[static_cast<std::size_t>(copies[end].triangle)] = end == begin;
    }
    const std::size_t count = end - begin;
    if (odd > 0 && odd < count)
      cancelled.push_back(copies[begin].triangle), facts.opposed += count;
    else
      facts.repeated += count - 1;
  }
  facts.double_sided = 2 * facts.opposed > triangles.size();
  if (!facts.double_sided)
    for (const Index triangle : cancelled) stays[static_cast<std::size_t>(triangle)] = false;
  return stays;
}

}  // namespace

TriangleSurface weld_soup(const TriangleSurface& soup, double tolerance_m, WeldFacts& facts) {
  VertexGrid grid(tolerance_m);
  std::vector<Index> target(soup.vertices.size(), -1);
  std::vector<Triangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (Triangle triangle : soup.triangles) {
    for (Index& vertex : triangle) {
      Index& merged = target[static_cast<std::size_t>(vertex)];
      if (merged < 0) merged = grid.merged(soup.vertices[static_cast<std::size_t>(vertex)]), ++facts.vertices_before;
      vertex = merged;
    }
    const bool whole = triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
    if (whole)
      triangles.push_back(triangle);
    else
      ++facts.collapsed;
  }
  const std::vector<bool> stays = without_copies(triangles, facts);
  TriangleSurface result;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (stays[t]) result.triangles.push_back(triangles[t]);
  std::vector<Index> scratch(grid.vertices.size(), -1);
  take_vertices(result, grid.vertices, scratch);
  facts.vertices_after = result.vertices.size();
  return result;
}

}  // namespace trocar
