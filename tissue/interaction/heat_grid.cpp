#include "tissue/interaction/heat_grid.h"

#include "tissue/mesh/surface/column_samples.h"

namespace trocar {
namespace {

using HeatIndex = HeatBlock::Index;

}  // namespace

void HeatGrid::set_surface(SurfacePtr rest_T) {
  rest_T_ = std::move(rest_T);
  extent_.clear();
  for (const auto& [a, b, c] : rest_T_->triangles) {
    const Vec3 &p = rest_T_->vertices[static_cast<std::size_t>(a)], &q = rest_T_->vertices[static_cast<std::size_t>(b)],
               &r = rest_T_->vertices[static_cast<std::size_t>(c)];
    const auto [x_low, x_high] = std::minmax({p.x(), q.x(), r.x()});
    const auto [y_low, y_high] = std::minmax({p.y(), q.y(), r.y()});
    extent_.push_back({x_low, x_high, y_low, y_high});
  }
}

Vec3 HeatGrid::middle(const HeatBlock& block, std::size_t cell) const {
  const int c = static_cast<int>(cell), e = HeatBlock::kEdge;
  return middle(e * block.index[0] + c % e, e * block.index[1] + c / e % e, e * block.index[2] + c / (e * e));
}

HeatBlock* HeatGrid::find(const HeatIndex& index) const {
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? nullptr : found->second.get();
}

HeatBlock* HeatGrid::need(const HeatIndex& index, bool& fresh) {
  fresh = false;
  const auto found = blocks_.find(index);
  if (found != blocks_.end()) return found->second.get();
  auto block = std::make_unique<HeatBlock>();
  block->index = index;
  block->water.fill(1);
  examine(*block);
  if (std::find(block->state.begin(), block->state.end(), HeatCell::kTissue) == block->state.end()) block.reset();
  HeatBlock* const made = (blocks_[index] = std::move(block)).get();
  fresh = made != nullptr;
  if (fresh) join(*made);
  return made;
}

void HeatGrid::join(HeatBlock& block) {
  for (std::size_t side = 0; side < block.beside.size(); ++side) {
    HeatBlock* const other = find(HeatBlock::beside_index(block.index, side));
    block.beside[side] = other;
    if (other != nullptr) other->beside[side ^ 1] = &block;
  }
}

void HeatGrid::free(HeatBlock& block) {
  for (std::size_t side = 0; side < block.beside.size(); ++side)
    if (block.beside[side] != nullptr) block.beside[side]->beside[side ^ 1] = nullptr;
  blocks_.erase(block.index);
}

void HeatGrid::forget_empty() {
  std::erase_if(blocks_, [](const auto& entry) { return entry.second == nullptr; });
}

std::size_t HeatGrid::blocks() const {
  std::size_t count = 0;
  for_blocks([&](const HeatBlock&) { ++count; });
  return count;
}

/// The triangles that columns through the block and one cube round it can cross.
TriangleSurface HeatGrid::over(const HeatBlock& block) const {
  const double reach = edge_m_ * (HeatBlock::kEdge + 1);
  const double x0 = edge_m_ * (HeatBlock::kEdge * block.index[0] - 1), x1 = x0 + edge_m_ + reach;
  const double y0 = edge_m_ * (HeatBlock::kEdge * block.index[1] - 1), y1 = y0 + edge_m_ + reach;
  TriangleSurface some;
  for (std::size_t t = 0; t < extent_.size(); ++t) {
    const auto& [x_low, x_high, y_low, y_high] = extent_[t];
    if (x_high < x0 || x_low > x1 || y_high < y0 || y_low > y1) continue;
    for (const std::int32_t corner : rest_T_->triangles[t])
      some.vertices.push_back(rest_T_->vertices[static_cast<std::size_t>(corner)]);
    const auto end = static_cast<std::int32_t>(some.vertices.size());
    some.triangles.push_back({end - 3, end - 2, end - 1});
  }
  return some;
}

void HeatGrid::examine(HeatBlock& block) const {
  constexpr int kEdge = HeatBlock::kEdge, kPadded = kEdge + 2;
  std::array<bool, kPadded * kPadded * kPadded> inside{};
  const auto padded = [](int i, int j, int k) { return static_cast<std::size_t>(i + kPadded * (j + kPadded * k)); };
  const Vec3 first = middle(kEdge * block.index[0] - 1, kEdge * block.index[1] - 1, kEdge * block.index[2] - 1);
  for_inside_samples(over(block), first, edge_m_, {kPadded, kPadded, kPadded},
                     [&](int i, int j, int k) { inside[padded(i, j, k)] = true; });
  for (int k = 0; k < kEdge; ++k)
    for (int j = 0; j < kEdge; ++j)
      for (int i = 0; i < kEdge; ++i) {
        const std::size_t c = HeatBlock::cell(i, j, k);
        const bool in = inside[padded(i + 1, j + 1, k + 1)];
        if (block.state[c] != HeatCell::kVaporised) block.state[c] = in ? HeatCell::kTissue : HeatCell::kOutside;
        const bool buried = inside[padded(i, j + 1, k + 1)] && inside[padded(i + 2, j + 1, k + 1)] &&
                            inside[padded(i + 1, j, k + 1)] && inside[padded(i + 1, j + 2, k + 1)] &&
                            inside[padded(i + 1, j + 1, k)] && inside[padded(i + 1, j + 1, k + 2)];
        block.skin[c] = block.skin[c] || (in && !buried);
      }
}

HeatCube HeatGrid::beside(HeatBlock& block, std::size_t cell, std::size_t side) const {
  constexpr int kEdge = HeatBlock::kEdge;
  const int c = static_cast<int>(cell);
  std::array<int, 3> to{c % kEdge, c / kEdge % kEdge, c / (kEdge * kEdge)};
  int& along = to[side / 2];
  along += side % 2 == 0 ? -1 : 1;
  HeatBlock* const other = along < 0 || along >= kEdge ? block.beside[side] : &block;
  along = (along + kEdge) % kEdge;
  return {other, HeatBlock::cell(to[0], to[1], to[2])};
}

void HeatGrid::vaporise(HeatBlock& block, std::size_t cell) {
  block.state[cell] = HeatCell::kVaporised;
  block.conductivity[cell] = 0;
  for (std::size_t side = 0; side < block.beside.size(); ++side)
    if (const HeatCube near = beside(block, cell, side); near.block != nullptr) near.block->skin[near.cell] = true;
}

}  // namespace trocar
