// Blocks of equal cubes for the tests of the soft solid: nodes, cells and faces by index.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tissue/solid/soft_solid.h"

namespace trocar::test {

/// nx x ny x nz cubes with one corner in the origin.
struct SoftBlock {
  int nx = 1, ny = 1, nz = 1;
  double edge_m = 0.01;
  std::vector<Vec3> nodes;
  std::vector<SoftCell> cells;

  SoftBlock(int x, int y, int z, double edge) : nx(x), ny(y), nz(z), edge_m(edge) {
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) nodes.push_back(edge * Vec3(i, j, k));
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          SoftCell cell;
          for (int a = 0; a < 8; ++a) cell.node[std::size_t(a)] = id(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
          cells.push_back(cell);
        }
  }
  std::int32_t id(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }
  /// Nodes on the lower (`upper` false) or upper face across an axis.
  std::vector<std::int32_t> face(int axis, bool upper) const {
    std::vector<std::int32_t> out;
    const double at = upper ? edge_m * std::array{nx, ny, nz}[std::size_t(axis)] : 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (std::abs(nodes[n][axis] - at) < 1e-3 * edge_m) out.push_back(std::int32_t(n));
    return out;
  }
  /// Share that a node has of a uniform traction on the face that it lies in across the axis; sum 1.
  double face_share(std::int32_t node, int axis) const {
    double share = 1;
    for (int c = 0; c < 3; ++c) {
      if (c == axis) continue;
      const int count = std::array{nx, ny, nz}[std::size_t(c)];
      const double at = nodes[std::size_t(node)][c] / edge_m;
      share *= (at < 0.5 || at > count - 0.5 ? 0.5 : 1.0) / count;
    }
    return share;
  }
};

/// The solver far beyond what a step in real time asks for: what is left is the discretisation.
inline SoftSolidOptions tight(double edge_m) {
  SoftSolidOptions options;
  options.edge_m = edge_m;
  options.tolerance = 1e-6;
  options.most_iterations = 3000;
  return options;
}

inline TissueSolid elastic(double young_pa, double poisson) {
  TissueSolid material;
  material.young_pa = young_pa;
  material.poisson = poisson;
  return material;
}

inline SoftSolid solid_of(const SoftBlock& block, const TissueSolid& material, const SoftSolidOptions& options) {
  return SoftSolid(block.nodes, block.cells, std::span(&material, 1), options);
}

/// Every node moved by up to `most_m` in each direction.
inline std::vector<Vec3f> scrambled(std::span<const Vec3f> rest, double most_m, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3f> out(rest.begin(), rest.end());
  for (Vec3f& p : out)
    for (int c = 0; c < 3; ++c) p[c] += float(most_m * (double(random()) / 2147483648.0 - 1));
  return out;
}

/// Where a node is, less where it rested.
inline Vec3 moved(const SoftSolid& solid, std::int32_t node) {
  return (solid.position()[std::size_t(node)] - solid.rest()[std::size_t(node)]).cast<double>();
}

inline double furthest_moved(const SoftSolid& solid) {
  double most = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) most = std::max(most, moved(solid, std::int32_t(n)).norm());
  return most;
}

}  // namespace trocar::test
