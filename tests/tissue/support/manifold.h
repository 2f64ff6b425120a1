// That a surface is closed and a manifold.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::test {

/// Every edge in two triangles, once each way; every vertex with one fan; no two triangles the same.
inline void expect_manifold(const TriangleSurface& surface, int genus = 0) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  std::vector<int> round(surface.vertices.size(), 0);
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{t[k], t[(k + 1) % 3]}];
      ++round[std::size_t(t[k])];
    }
  for (const auto& [edge, times] : edges) {
    ASSERT_EQ(times, 1) << edge.first << " " << edge.second;
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  // One fan each: the walk round a vertex comes back after all of its triangles.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> next;
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) next[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  std::vector<std::int32_t> first(surface.vertices.size(), -1);
  for (const auto& [edge, third] : next) first[std::size_t(edge.first)] = edge.second;
  for (std::size_t v = 0; v < first.size(); ++v) {
    ASSERT_GE(first[v], 0) << "a vertex without a triangle";
    int steps = 0;
    std::int32_t at = first[v];
    do {
      at = next.at({std::int32_t(v), at});
      ++steps;
    } while (at != first[v] && steps <= round[v]);
    ASSERT_EQ(steps, round[v]) << "vertex " << v;
  }
  const auto euler =
      std::int64_t(surface.vertices.size()) - std::int64_t(edges.size() / 2) + std::int64_t(surface.triangles.size());
  EXPECT_EQ(euler, 2 - 2 * genus);
}

}  // namespace trocar::test
