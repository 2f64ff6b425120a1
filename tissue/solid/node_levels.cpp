#include "tissue/solid/node_levels.h"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "tissue/solid/cell_lanes.h"

namespace trocar {
namespace {

constexpr std::size_t kMostLevels = 4;
constexpr std::size_t kFewestNodes = 40;  // of a level that is worth a coarser one
// Of the sum over the finer nodes. An element of twice the edge has 0.25; with every level taking the whole of its
// residual, fewest iterations with 0.4 (cells of 12.5 to 4 mm).
constexpr float kStiffnessCoarser = 0.4F;

using Place = std::array<std::int32_t, 3>;

/// The coarser grid points whose shares make up a grid point.
std::vector<Place> parents_of(const Place& at) {
  std::vector<Place> out{{at[0] / 2, at[1] / 2, at[2] / 2}};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (at[axis] % 2 == 0) continue;
    const std::size_t count = out.size();
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(out[i]);
      ++out.back()[axis];
    }
  }
  return out;
}

TROCAR_INLINE float share_of(unsigned halvings) {
  constexpr float kShare[] = {1, 0.5F, 0.25F, 0.125F};
  return kShare[halvings];
}

/// Mean of the values of a finer node's parents.
template <class Level>
TROCAR_INLINE Row coarser_mean(const Level& level, std::size_t n) {
  const std::int32_t* parent = level.parent.data() + level.first_parent[n];
  const std::int32_t count = level.first_parent[n + 1] - level.first_parent[n];
  const auto value = [&](int i) __attribute__((always_inline)) {
    return row(level.value[static_cast<std::size_t>(parent[i])]);
  };
  if (count == 1) return value(0);
  if (count == 2) return 0.5F * (value(0) + value(1));
  const Row four = (value(0) + value(1)) + (value(2) + value(3));
  if (count == 4) return 0.25F * four;
  return 0.125F * (four + ((value(4) + value(5)) + (value(6) + value(7))));
}

float inverse_or_none(float value) { return value > 0 ? 1 / value : 0; }

}  // namespace

NodeLevels::NodeLevels(std::span<const Place> place) {
  std::vector<Place> finer(place.begin(), place.end());
  const auto before = [](const Place& a, const Place& b) {
    return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
  };
  while (levels_.size() < kMostLevels && finer.size() > kFewestNodes) {
    std::vector<Place> coarser;
    for (const Place& at : finer)
      for (const Place& parent : parents_of(at)) coarser.push_back(parent);
    const std::vector<Place> parents = coarser;
    std::sort(coarser.begin(), coarser.end(), before);
    coarser.erase(std::unique(coarser.begin(), coarser.end()), coarser.end());
    Level level;
    for (const Place& at : parents)
      level.parent.push_back(
          static_cast<std::int32_t>(std::lower_bound(coarser.begin(), coarser.end(), at, before) - coarser.begin()));
    level.first_parent = {0};
    for (const Place& at : finer)
      level.first_parent.push_back(level.first_parent.back() + (1 << (at[0] % 2 + at[1] % 2 + at[2] % 2)));
    level.stiffness.resize(coarser.size());
    level.outside = level.inverse = level.stiffness;
    level.value.resize(coarser.size());
    find_children(level);
    levels_.push_back(std::move(level));
    finer = std::move(coarser);
  }
}

void NodeLevels::add_doubles(std::span<const std::int32_t> node) {
  if (levels_.empty()) return;
  Level& level = levels_.front();
  for (const std::int32_t original : node) {
    for (std::int32_t i = level.first_parent[static_cast<std::size_t>(original)];
         i < level.first_parent[static_cast<std::size_t>(original) + 1]; ++i)
      level.parent.push_back(level.parent[static_cast<std::size_t>(i)]);
    level.first_parent.push_back(static_cast<std::int32_t>(level.parent.size()));
  }
  find_children(level);
}

void NodeLevels::find_children(Level& level) {
  level.first_child.assign(level.value.size() + 1, 0);
  for (const std::int32_t parent : level.parent) ++level.first_child[static_cast<std::size_t>(parent) + 1];
  for (std::size_t n = 0; n < level.value.size(); ++n) level.first_child[n + 1] += level.first_child[n];
  std::vector<std::int32_t> next = level.first_child;
  level.child.resize(level.parent.size());
  for (std::size_t n = 0; n + 1 < level.first_parent.size(); ++n) {
    const std::int32_t first = level.first_parent[n], end = level.first_parent[n + 1];
    const auto halvings = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(end - first)) - 1);
    for (std::int32_t i = first; i < end; ++i) {
      std::int32_t& at = next[static_cast<std::size_t>(level.parent[static_cast<std::size_t>(i)])];
      level.child[static_cast<std::size_t>(at++)] = {static_cast<std::uint32_t>(n) & 0x3fffffffU, halvings & 3U};
    }
  }
}

void NodeLevels::set_diagonals(std::span<const float> stiffness, std::span<const float> outside) {
  for (Level& level : levels_) {
    for (std::size_t n = 0; n < level.value.size(); ++n) {
      float cells = 0, others = 0;
      for (std::int32_t i = level.first_child[n]; i < level.first_child[n + 1]; ++i) {
        const Child child = level.child[static_cast<std::size_t>(i)];
        cells += share_of(child.halvings) * stiffness[child.node];
        others += share_of(child.halvings) * outside[child.node];
      }
      level.stiffness[n] = kStiffnessCoarser * cells;
      level.outside[n] = others;
    }
    stiffness = level.stiffness;
    outside = level.outside;
  }
  reset();
}

void NodeLevels::reset() {
  for (Level& level : levels_)
    for (std::size_t n = 0; n < level.value.size(); ++n)
      level.inverse[n] = inverse_or_none(level.stiffness[n] + level.outside[n]);
}

void NodeLevels::add_spring(std::span<const std::int32_t> node, std::span<const float> share, float stiffness) {
  std::map<std::int32_t, float> finer, here;
  for (std::size_t i = 0; i < node.size(); ++i) finer[node[i]] += share[i];
  for (Level& level : levels_) {
    here.clear();
    for (const auto& [n, value] : finer) {
      const std::int32_t first = level.first_parent[static_cast<std::size_t>(n)];
      const std::int32_t end = level.first_parent[static_cast<std::size_t>(n) + 1];
      for (std::int32_t i = first; i < end; ++i)
        here[level.parent[static_cast<std::size_t>(i)]] += value / static_cast<float>(end - first);
    }
    for (const auto& [n, value] : here) {
      float& inverse = level.inverse[static_cast<std::size_t>(n)];
      if (inverse > 0) inverse = 1 / (1 / inverse + stiffness * value * value);
    }
    finer.swap(here);
  }
}

TROCAR_LANES_CLONED void NodeLevels::coarsen_onto(Level& level, const NodeRow* finer) {
  const Child* child = level.child.data();
  for (std::size_t n = 0; n < level.value.size(); ++n) {
    Row sum{};
    for (const Child* end = level.child.data() + level.first_child[n + 1]; child != end; ++child)
      sum += share_of(child->halvings) * row(finer[child->node]);
    set(level.value[n], sum);
  }
}

double NodeLevels::coarsen(std::span<const NodeRow> residual) {
  const NodeRow* finer = residual.data();
  for (Level& level : levels_) {
    coarsen_onto(level, finer);
    finer = level.value.data();
  }
  double gained = 0;
  for (Level& level : levels_)
    for (std::size_t n = 0; n < level.value.size(); ++n) {
      const Row r = row(level.value[n]), z = level.inverse[n] * r, product = r * z;
      gained += static_cast<double>(product[0] + product[1] + product[2]);
      set(level.value[n], z);
    }
  return gained;
}

TROCAR_LANES_CLONED void NodeLevels::advance(std::span<const float> inverse, std::span<const NodeRow> residual,
                                             float beta, std::span<const float> shift, std::span<NodeRow> direction,
                                             std::span<NodeRow> product) {
  for (std::size_t l = levels_.size(); l-- > 1;)
    for (std::size_t n = 0; n < levels_[l - 1].value.size(); ++n) {
      NodeRow& value = levels_[l - 1].value[n];
      set(value, row(value) + coarser_mean(levels_[l], n));
    }
  const std::size_t known = levels_.empty() ? 0 : levels_.front().first_parent.size() - 1;
  for (std::size_t n = 0; n < direction.size(); ++n) {
    Row z = inverse[n] * row(residual[n]);
    if (n < known) z += coarser_mean(levels_.front(), n);
    z += beta * row(direction[n]);
    set(direction[n], z);
    set(product[n], shift[n] * z);
  }
}

}  // namespace trocar
