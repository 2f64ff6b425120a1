#include "tissue/interaction/heat_looks.h"

#include <algorithm>
#include <utility>

namespace trocar {
namespace {

constexpr double kLeastReach = 0.0005, kMostReach = 0.006;  // m

}  // namespace

void HeatLooks::reset(const TriangleSurface& surface) {
  white_.clear();
  charred_.clear();
  looked_.clear();
  ++number_;
  grow(surface);
}

void HeatLooks::grow(const TriangleSurface& surface) {
  white_.resize(surface.vertices.size(), 0);
  charred_.resize(surface.vertices.size(), 0);
  looked_.resize(surface.vertices.size(), 0);
  set_reach(surface);
}

void HeatLooks::set_reach(const TriangleSurface& surface) {
  std::vector<double> sum(surface.vertices.size(), 0), count(surface.vertices.size(), 0);
  for (const auto& triangle : surface.triangles)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto a = static_cast<std::size_t>(triangle[corner]),
                 b = static_cast<std::size_t>(triangle[(corner + 1) % 3]);
      const double length = (surface.vertices[a] - surface.vertices[b]).norm();
      sum[a] += length;
      sum[b] += length;
      ++count[a];
      ++count[b];
    }
  reach_.resize(surface.vertices.size());
  for (std::size_t v = 0; v < reach_.size(); ++v)
    reach_[v] = static_cast<float>(std::clamp(count[v] > 0 ? sum[v] / count[v] : 0, kLeastReach, kMostReach));
}

bool HeatLooks::watch(HeatBlock& block, const HeatGrid& grid, std::size_t first_vertex) const {
  const double half = grid.edge_m() * HeatBlock::kEdge / 2;
  const Vec3 middle = 2 * half * (Vec3(block.index[0], block.index[1], block.index[2]) + Vec3::Constant(0.5));
  const auto& vertices = grid.surface().vertices;
  const std::size_t before = block.watchers.size();
  for (std::size_t v = first_vertex; v < vertices.size(); ++v)
    if ((vertices[v] - middle).cwiseAbs().maxCoeff() < half + reach_[v] + grid.edge_m())
      block.watchers.push_back(static_cast<std::int32_t>(v));
  return block.watchers.size() > before;
}

HeatLook HeatLooks::look_of(std::size_t vertex, const HeatGrid& grid) const {
  const Vec3& at = grid.surface().vertices[vertex];
  const double reach = reach_[vertex], edge = grid.edge_m();
  const Vec3 round = Vec3::Constant(reach + edge);
  HeatLook look;
  grid.for_cells(at - round, at + round, [&](const HeatBlock& block, std::size_t cell, const Vec3& middle) {
    const bool seen = block.skin[cell] || block.state[cell] == HeatCell::kVaporised;
    if (!seen || (block.damage[cell] <= 0 && block.charred[cell] <= 0)) return;
    const double away = std::max(0.0, (middle - at).norm() - edge) / reach;
    const auto share = static_cast<float>(std::max(0.0, 1 - away));
    look.white = std::max(look.white, share * std::min(1.0f, block.damage[cell]));
    look.charred = std::max(look.charred, share * block.charred[cell]);
  });
  return look;
}

void HeatLooks::renew(const HeatGrid& grid) {
  bool any = false;
  grid.for_blocks([&](HeatBlock& block) {
    if (!std::exchange(block.looks_different, false)) return;
    if (!std::exchange(any, true)) ++number_;
    for (const std::int32_t vertex : block.watchers) {
      const auto v = static_cast<std::size_t>(vertex);
      if (std::exchange(looked_[v], number_) == number_) continue;
      const HeatLook look = look_of(v, grid);
      white_[v] = look.white;
      charred_[v] = look.charred;
    }
  });
}

}  // namespace trocar
