#include "tissue/solid/node_levels.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <tuple>

#include "tissue/solid/cell_lanes.h"

namespace trocar {
namespace {

constexpr std::size_t kMostLevels = 4;
constexpr std::size_t kFewestNodes = 40;  // of a level that is worth a coarser one
// Of the sum over the finer nodes. An element of twice the edge has 0.25; with every level taking the whole of its
// residual, fewest iterations with 0.4 (cells of 12.5 to 4 mm).
constexpr float kStiffnessCoarser = 0.4F;

/// Sets that grow together; the first member stands for all.
class Sets {
 public:
  explicit Sets(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0); }
  std::int32_t first(std::int32_t member) {
    while (at(member) != member) member = at(member) = at(at(member));
    return member;
  }
  void unite(std::int32_t a, std::int32_t b) {
    a = first(a);
    b = first(b);
    at(std::max(a, b)) = std::min(a, b);
  }

 private:
  std::int32_t& at(std::int32_t member) { return first_[static_cast<std::size_t>(member)]; }
  std::vector<std::int32_t> first_;
};

std::array<std::int32_t, 3> halved(const std::array<std::int32_t, 3>& place) {
  return {place[0] / 2, place[1] / 2, place[2] / 2};
}

/// Cells in the order of the coarser places in which they lie.
std::vector<std::size_t> by_coarser_place(std::span<const PlacedCell> cells) {
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::size_t i) {
    const auto [x, y, z] = halved(cells[i].place);
    return std::tuple(z, y, x, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

/// Which coarser cell each is a part of. The nodes of the coarser ones are not known yet.
std::vector<std::int32_t> join_cells(std::span<const PlacedCell> cells, std::size_t node_count,
                                     std::vector<PlacedCell>& coarser) {
  const std::vector<std::size_t> order = by_coarser_place(cells);
  Sets together(order.size());
  std::vector<std::int32_t> last_at(node_count, -1);  // of a node, where in the order it was met last
  const auto place = [&](std::int32_t at) { return halved(cells[order[static_cast<std::size_t>(at)]].place); };
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(order.size()); ++at)
    for (const std::int32_t node : cells[order[static_cast<std::size_t>(at)]].node) {
      std::int32_t& last = last_at[static_cast<std::size_t>(node)];
      if (last >= 0 && place(last) == place(at)) together.unite(last, at);
      last = at;
    }
  std::vector<std::int32_t> number(order.size()), part_of(cells.size());
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(order.size()); ++at) {
    const std::int32_t first = together.first(at);
    if (first == at) {
      number[static_cast<std::size_t>(at)] = static_cast<std::int32_t>(coarser.size());
      coarser.push_back({place(at), {}});
    }
    part_of[order[static_cast<std::size_t>(at)]] = number[static_cast<std::size_t>(first)];
  }
  return part_of;
}

/// The corner of a cell at b where a cell at a has its corner, or -1.
int same_corner(const std::array<std::int32_t, 3>& a, int corner, const std::array<std::int32_t, 3>& b) {
  int out = 0;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const int bit = a[axis] + (corner >> axis & 1) - b[axis];
    if (bit < 0 || bit > 1) return -1;
    out |= bit << axis;
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
  if (count == 0) return Row{};
  if (count == 1) return value(0);
  if (count == 2) return 0.5F * (value(0) + value(1));
  const Row four = (value(0) + value(1)) + (value(2) + value(3));
  if (count == 4) return 0.25F * four;
  return 0.125F * (four + ((value(4) + value(5)) + (value(6) + value(7))));
}

float inverse_or_none(float value) { return value > 0 ? 1 / value : 0; }

}  // namespace

NodeLevels::NodeLevels(std::span<const PlacedCell> cells, std::size_t node_count) {
  std::vector<PlacedCell> coarser;
  while (levels_.size() < kMostLevels && node_count > kFewestNodes) {
    Level level;
    coarser = find_parents(cells, node_count, level);
    find_children(level);
    cells = coarser;
    node_count = level.value.size();
    levels_.push_back(std::move(level));
  }
}

std::vector<PlacedCell> NodeLevels::find_parents(std::span<const PlacedCell> cells, std::size_t node_count,
                                                 Level& level) {
  std::vector<PlacedCell> coarser;
  const std::vector<std::int32_t> part_of = join_cells(cells, node_count, coarser);
  // Corners of coarser cells are one node where finer cells of both share a node.
  struct Seen {
    std::int32_t in = -1, where = 0;  // coarser cell; place in it, two bits an axis
  };
  Sets corners(kCubeCorners * coarser.size());
  std::vector<Seen> seen(node_count);
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int a = 0; a < kCubeCorners; ++a) {
      const std::int32_t here = part_of[i];
      const auto& place = coarser[static_cast<std::size_t>(here)].place;
      Seen& node = seen[static_cast<std::size_t>(cells[i].node[static_cast<std::size_t>(a)])];
      if (node.in < 0) {
        node.in = here;
        for (std::size_t axis = 0; axis < kAxes; ++axis)
          node.where |= (cells[i].place[axis] - 2 * place[axis] + (a >> axis & 1)) << 2 * axis;
      }
      for (int c = 0; c < kCubeCorners && node.in != here; ++c) {
        const int there = same_corner(place, c, coarser[static_cast<std::size_t>(node.in)].place);
        if (there >= 0) corners.unite(kCubeCorners * here + c, kCubeCorners * node.in + there);
      }
    }
  std::vector<std::int32_t> number(kCubeCorners * coarser.size(), -1);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const auto first = static_cast<std::size_t>(corners.first(static_cast<std::int32_t>(i)));
    if (first == i) number[i] = count++;
    coarser[i / kCubeCorners].node[i % kCubeCorners] = number[i] = number[first];
  }
  level.first_parent = {0};
  for (const Seen& node : seen) {
    for (int c = 0; c < kCubeCorners && node.in >= 0; ++c) {
      bool has_part = true;
      for (int axis = 0; axis < kAxes; ++axis) {
        const int where = node.where >> 2 * axis & 3;
        has_part = has_part && (where == 1 || where == 2 * (c >> axis & 1));
      }
      if (has_part)
        level.parent.push_back(coarser[static_cast<std::size_t>(node.in)].node[static_cast<std::size_t>(c)]);
    }
    level.first_parent.push_back(static_cast<std::int32_t>(level.parent.size()));
  }
  level.stiffness.resize(static_cast<std::size_t>(count));
  level.outside = level.inverse = level.stiffness;
  level.value.resize(static_cast<std::size_t>(count));
  return coarser;
}

void NodeLevels::find_children(Level& level) {
  level.first_child.assign(level.value.size() + 1, 0);
  for (const std::int32_t parent : level.parent) ++level.first_child[static_cast<std::size_t>(parent) + 1];
  for (std::size_t n = 0; n < level.value.size(); ++n) level.first_child[n + 1] += level.first_child[n];
  std::vector<std::int32_t> next = level.first_child;
  level.child.resize(level.parent.size());
  for (std::size_t n = 0; n + 1 < level.first_parent.size(); ++n) {
    const std::int32_t first = level.first_parent[n], end = level.first_parent[n + 1];
    if (first == end) continue;
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
