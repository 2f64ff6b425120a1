#include "tissue/mesh/surface/topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace trocar {
namespace {

using Index = std::int32_t;

/// Union-find over 0..n-1; the root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index root(Index item) {
    while (parent_[at(item)] != item) item = parent_[at(item)] = parent_[at(parent_[at(item)])];
    return item;
  }

  void join(Index a, Index b) {
    a = root(a), b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  static std::size_t at(Index item) { return static_cast<std::size_t>(item); }
  std::vector<Index> parent_;
};

struct HalfEdge {
  Index low, high;
  bool forward;  ///< runs from low to high
  Index triangle;
  auto key() const { return std::pair(low, high); }
};

std::vector<HalfEdge> sorted_half_edges(const TriangleSurface& surface) {
  std::vector<HalfEdge> edges;
  edges.reserve(surface.triangles.size() * 3);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n) {
      const Index from = surface.triangles[t][n], to = surface.triangles[t][(n + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), from < to, static_cast<Index>(t)});
    }
  std::stable_sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
  return edges;
}

void count_edges(const std::vector<HalfEdge>& edges, SurfaceTopology& facts, std::size_t& edge_count) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].key() == edges[begin].key()) ++end;
    ++edge_count;
    if (end - begin == 1) ++facts.boundary_edges;
    if (end - begin > 2) ++facts.nonmanifold_edges;
    if (end - begin == 2 && edges[begin].forward == edges[begin + 1].forward) ++facts.misoriented_edges;
  }
}

/// Corners (triangle, vertex) that share an edge belong to one fan; a vertex with two fans is not manifold.
std::size_t count_split_vertices(const TriangleSurface& surface, const std::vector<HalfEdge>& edges) {
  DisjointSets corners(surface.triangles.size() * 3);
  const auto corner = [&](Index triangle, Index vertex) {
    const auto& t = surface.triangles[static_cast<std::size_t>(triangle)];
    return 3 * triangle + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
  };
  for (std::size_t n = 1; n < edges.size(); ++n) {
    if (edges[n].key() != edges[n - 1].key()) continue;
    corners.join(corner(edges[n - 1].triangle, edges[n].low), corner(edges[n].triangle, edges[n].low));
    corners.join(corner(edges[n - 1].triangle, edges[n].high), corner(edges[n].triangle, edges[n].high));
  }
  std::vector<int> fans(surface.vertices.size(), 0);
  for (std::size_t n = 0; n < surface.triangles.size() * 3; ++n)
    if (corners.root(static_cast<Index>(n)) == static_cast<Index>(n))
      ++fans[static_cast<std::size_t>(surface.triangles[n / 3][n % 3])];
  return static_cast<std::size_t>(std::count_if(fans.begin(), fans.end(), [](int count) { return count > 1; }));
}

bool degenerate(const TriangleSurface& surface, const std::array<Index, 3>& triangle) {
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(triangle[n])];
  const double longest =
      std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
  return (p[1] - p[0]).cross(p[2] - p[0]).norm() <= 2e-6 * longest;
}

double six_volumes(const TriangleSurface& surface, const std::array<Index, 3>& t) {
  const auto& v = surface.vertices;
  return v[static_cast<std::size_t>(t[0])].dot(
      v[static_cast<std::size_t>(t[1])].cross(v[static_cast<std::size_t>(t[2])]));
}

/// The triangles for which `keep` says yes, with the vertices they use.
template <typename Predicate>
TriangleSurface subset(const TriangleSurface& surface, Predicate keep) {
  TriangleSurface part;
  std::vector<Index> renumbered(surface.vertices.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!keep(t)) continue;
    auto triangle = surface.triangles[t];
    for (Index& vertex : triangle) {
      Index& target = renumbered[static_cast<std::size_t>(vertex)];
      if (target < 0) {
        target = static_cast<Index>(part.vertices.size());
        part.vertices.push_back(surface.vertices[static_cast<std::size_t>(vertex)]);
      }
      vertex = target;
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace

std::vector<Index> triangle_components(const TriangleSurface& surface) {
  DisjointSets sets(surface.vertices.size());
  for (const auto& [a, b, c] : surface.triangles) sets.join(a, b), sets.join(b, c);
  std::map<Index, Index> number_of_root;
  std::vector<Index> component;
  component.reserve(surface.triangles.size());
  for (const auto& triangle : surface.triangles)
    component.push_back(
        number_of_root.try_emplace(sets.root(triangle[0]), static_cast<Index>(number_of_root.size())).first->second);
  return component;
}

SurfaceTopology analyse_topology(const TriangleSurface& surface) {
  SurfaceTopology facts;
  facts.triangles = surface.triangles.size();
  const auto edges = sorted_half_edges(surface);
  std::size_t edge_count = 0;
  count_edges(edges, facts, edge_count);
  facts.nonmanifold_vertices = count_split_vertices(surface, edges);
  std::vector<bool> used(surface.vertices.size(), false);
  for (const auto& triangle : surface.triangles) {
    facts.degenerate_triangles += degenerate(surface, triangle) ? 1 : 0;
    for (const Index vertex : triangle) used[static_cast<std::size_t>(vertex)] = true;
  }
  facts.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  const auto components = triangle_components(surface);
  facts.components =
      components.empty() ? 0 : static_cast<std::size_t>(*std::max_element(components.begin(), components.end())) + 1;
  const auto euler =
      static_cast<std::int64_t>(facts.vertices + facts.triangles) - static_cast<std::int64_t>(edge_count);
  facts.genus = static_cast<int>((2 * static_cast<std::int64_t>(facts.components) - euler) / 2);
  return facts;
}

TriangleSurface some_triangles(const TriangleSurface& surface, const std::vector<bool>& keep) {
  return subset(surface, [&](std::size_t t) { return keep[t]; });
}

void append_turned(TriangleSurface& surface, const TriangleSurface& more) {
  const auto shift = static_cast<Index>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles) surface.triangles.push_back({a + shift, c + shift, b + shift});
}

TriangleSurface without_specks(const TriangleSurface& surface, double least_m3, std::vector<double>* lost_volumes_m3) {
  const auto component = triangle_components(surface);
  std::vector<double> volumes;
  for (std::size_t t = 0; t < component.size(); ++t) {
    const auto number = static_cast<std::size_t>(component[t]);
    if (number >= volumes.size()) volumes.resize(number + 1, 0);
    volumes[number] += six_volumes(surface, surface.triangles[t]) / 6;
  }
  if (lost_volumes_m3 != nullptr) {
    lost_volumes_m3->clear();
    for (const double volume : volumes)
      if (volume > 0 && volume < least_m3) lost_volumes_m3->push_back(volume);
    std::sort(lost_volumes_m3->rbegin(), lost_volumes_m3->rend());
  }
  return subset(surface, [&](std::size_t t) { return volumes[static_cast<std::size_t>(component[t])] >= least_m3; });
}

TriangleSurface welded(const TriangleSurface& surface, double tolerance_m) {
  std::map<std::array<std::int64_t, 3>, Index> cells;
  std::vector<Index> target;
  TriangleSurface merged;
  for (const Vec3& vertex : surface.vertices) {
    std::array<std::int64_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] = std::llround(vertex[axis] / tolerance_m);
    const auto [entry, fresh] = cells.try_emplace(cell, static_cast<Index>(merged.vertices.size()));
    if (fresh) merged.vertices.push_back(vertex);
    target.push_back(entry->second);
  }
  std::set<std::array<Index, 3>> seen;
  for (auto triangle : surface.triangles) {
    for (Index& vertex : triangle) vertex = target[static_cast<std::size_t>(vertex)];
    auto sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second) continue;
    merged.triangles.push_back(triangle);
  }
  return subset(merged, [](std::size_t) { return true; });
}

double surface_area_m2(const TriangleSurface& surface) {
  double doubled = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3& p = surface.vertices[static_cast<std::size_t>(a)];
    doubled += (surface.vertices[static_cast<std::size_t>(b)] - p)
                   .cross(surface.vertices[static_cast<std::size_t>(c)] - p)
                   .norm();
  }
  return doubled / 2;
}

Vec3 volume_centroid_m(const TriangleSurface& surface) {
  Vec3 moment = Vec3::Zero();
  double volume = 0;
  for (const auto& triangle : surface.triangles) {
    const double part = six_volumes(surface, triangle) / 6;
    volume += part;
    for (const Index vertex : triangle) moment += part / 4 * surface.vertices[static_cast<std::size_t>(vertex)];
  }
  return moment / volume;
}

}  // namespace trocar
