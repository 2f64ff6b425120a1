#include "app/picture/models/implicit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace trocar {
namespace {

/// The function on the corners of a grid, and the net's vertices in its cells.
struct Net {
  Net(const Distance& distance, const Eigen::AlignedBox3d& box, double cell_m) : cell(cell_m), origin(box.min()) {
    for (int k = 0; k < 3; ++k) n[k] = static_cast<int>(std::ceil(box.sizes()[k] / cell)) + 1;
    value.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]));
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) {
          const bool border = x == 0 || y == 0 || z == 0 || x == n[0] - 1 || y == n[1] - 1 || z == n[2] - 1;
          const double d = distance(corner(x, y, z));
          value.push_back(border ? std::max(d, 0.2 * cell) : d);  // what reaches the border is cut there: always closed
        }
    vertex.assign(value.size(), -1);
  }
  Vec3 corner(int x, int y, int z) const { return origin + cell * Vec3(x, y, z); }
  std::size_t index(int x, int y, int z) const { return static_cast<std::size_t>((z * n[1] + y) * n[0] + x); }
  double at(int x, int y, int z) const { return value[index(x, y, z)]; }

  double cell;
  Vec3 origin;
  int n[3];
  std::vector<double> value;
  std::vector<std::int32_t> vertex;
};

constexpr std::array<std::array<int, 2>, 12> kEdges = {
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

void add_vertex(Net& net, int x, int y, int z, TriangleSurface& out) {
  Vec3 sum = Vec3::Zero();
  int crossings = 0;
  for (const auto& [a, b] : kEdges) {
    const int ax = x + (a & 1), ay = y + ((a >> 1) & 1), az = z + (a >> 2), bx = x + (b & 1), by = y + ((b >> 1) & 1),
              bz = z + (b >> 2);
    const double va = net.at(ax, ay, az), vb = net.at(bx, by, bz);
    if ((va < 0) == (vb < 0)) continue;
    sum += net.corner(ax, ay, az) + va / (va - vb) * (net.corner(bx, by, bz) - net.corner(ax, ay, az));
    ++crossings;
  }
  if (crossings == 0) return;
  net.vertex[net.index(x, y, z)] = static_cast<std::int32_t>(out.vertices.size());
  out.vertices.push_back(sum / crossings);
}

/// The quad round the grid edge from (x, y, z) along `axis`, when the surface crosses it.
void add_quad(const Net& net, int x, int y, int z, int axis, TriangleSurface& out) {
  const std::array<int, 3> p = {x, y, z};
  std::array<int, 3> q = p;
  ++q[static_cast<std::size_t>(axis)];
  const double from = net.at(x, y, z), to = net.at(q[0], q[1], q[2]);
  if ((from < 0) == (to < 0)) return;
  const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
  if (p[u] == 0 || p[v] == 0) return;
  std::array<std::int32_t, 4> ring{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<int, 3> cell = p;
    cell[u] -= i == 0 || i == 3;
    cell[v] -= i == 0 || i == 1;
    ring[i] = net.vertex[net.index(cell[0], cell[1], cell[2])];
    if (ring[i] < 0) return;
  }
  if (from >= 0) std::swap(ring[1], ring[3]);
  out.triangles.push_back({ring[0], ring[1], ring[2]});
  out.triangles.push_back({ring[0], ring[2], ring[3]});
}

}  // namespace

TriangleSurface implicit_surface(const Distance& distance, const Eigen::AlignedBox3d& box, double cell_m) {
  Net net(distance, box, cell_m);
  TriangleSurface out;
  for (int z = 0; z + 1 < net.n[2]; ++z)
    for (int y = 0; y + 1 < net.n[1]; ++y)
      for (int x = 0; x + 1 < net.n[0]; ++x) add_vertex(net, x, y, z, out);
  for (int z = 0; z + 1 < net.n[2]; ++z)
    for (int y = 0; y + 1 < net.n[1]; ++y)
      for (int x = 0; x + 1 < net.n[0]; ++x)
        for (int axis = 0; axis < 3; ++axis) add_quad(net, x, y, z, axis, out);
  return out;
}

Vec3 first_hit(const Distance& distance, const Vec3& origin, const Vec3& direction, double reach_m) {
  double along = 0;
  while (along < reach_m) {
    const double d = distance(origin + along * direction);
    if (d < 1e-4) break;
    along += 0.5 * d;
  }
  return origin + std::min(along, reach_m) * direction;
}

Vec3 slope_of(const Distance& distance, const Vec3& at) {
  constexpr double e = 2e-4;
  Vec3 g;
  for (int k = 0; k < 3; ++k) g[k] = distance(at + e * Vec3::Unit(k)) - distance(at - e * Vec3::Unit(k));
  return g.norm() > 0 ? Vec3(g.normalized()) : Vec3(Vec3::UnitZ());
}

}  // namespace trocar
