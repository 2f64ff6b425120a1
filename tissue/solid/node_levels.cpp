#include "tissue/solid/node_levels.h"

#include <algorithm>
#include <map>

#include "tissue/solid/cell_lanes.h"

namespace trocar {
namespace {

constexpr std::size_t kMostLevels = 4;
constexpr std::size_t kFewestNodes = 40;   // of a level that is worth a coarser one
constexpr float kStiffnessCoarser = 0.4F;  // of the sum over the finer nodes

/// Sum over the links of one node.
template <class Links>
TROCAR_INLINE Row sum_of(const Links& links, const NodeRow* value, std::size_t n) {
  Row sum{};
  for (std::int32_t i = links.first[n]; i < links.first[n + 1]; ++i)
    sum += links.link[static_cast<std::size_t>(i)].share *
           row(value[static_cast<std::size_t>(links.link[static_cast<std::size_t>(i)].node)]);
  return sum;
}

}  // namespace

NodeLevels::NodeLevels(std::span<const std::array<std::int32_t, 3>> place) {
  std::vector<std::array<std::int32_t, 3>> finer(place.begin(), place.end());
  while (levels_.size() < kMostLevels && finer.size() > kFewestNodes) {
    Level level;
    std::map<std::array<std::int32_t, 3>, std::int32_t> number;  // by z, then y, then x
    const auto round = [&](const std::array<std::int32_t, 3>& at, auto&& visit) {
      for (int a = 0; a < kCubeCorners; ++a) {
        std::array<std::int32_t, 3> parent{};
        float share = 1;
        for (std::size_t axis = 0; axis < kAxes; ++axis) {
          const int upper = a >> axis & 1;
          if (at[axis] % 2 == 0 && upper != 0) share = 0;
          if (at[axis] % 2 != 0) share /= 2;
          parent[kAxes - 1 - axis] = at[axis] / 2 + upper;
        }
        if (share > 0) visit(parent, share);
      }
    };
    for (const auto& at : finer) round(at, [&](const auto& parent, float) { number[parent] = 0; });
    std::vector<std::array<std::int32_t, 3>> coarser;
    for (auto& [at, n] : number) {
      n = static_cast<std::int32_t>(coarser.size());
      coarser.push_back({at[2], at[1], at[0]});
    }
    std::vector<std::vector<Link>> children(coarser.size());
    level.parents.first = {0};
    for (std::size_t n = 0; n < finer.size(); ++n) {
      round(finer[n], [&](const auto& parent, float share) {
        level.parents.link.push_back({number[parent], share});
        children[static_cast<std::size_t>(number[parent])].push_back({static_cast<std::int32_t>(n), share});
      });
      level.parents.first.push_back(static_cast<std::int32_t>(level.parents.link.size()));
    }
    level.children.first = {0};
    for (const auto& of_node : children) {
      level.children.link.insert(level.children.link.end(), of_node.begin(), of_node.end());
      level.children.first.push_back(static_cast<std::int32_t>(level.children.link.size()));
    }
    level.stiffness.resize(coarser.size());
    level.outside = level.inverse = level.stiffness;
    level.value.resize(coarser.size());
    levels_.push_back(std::move(level));
    finer = std::move(coarser);
  }
}

void NodeLevels::set_diagonals(std::span<const float> stiffness, std::span<const float> outside) {
  for (Level& level : levels_) {
    for (std::size_t n = 0; n < level.value.size(); ++n) {
      float cells = 0, others = 0;
      for (std::int32_t i = level.children.first[n]; i < level.children.first[n + 1]; ++i) {
        const Link& link = level.children.link[static_cast<std::size_t>(i)];
        cells += link.share * stiffness[static_cast<std::size_t>(link.node)];
        others += link.share * outside[static_cast<std::size_t>(link.node)];
      }
      level.stiffness[n] = kStiffnessCoarser * cells;
      level.outside[n] = others;
    }
    stiffness = level.stiffness;
    outside = level.outside;
  }
}

void NodeLevels::reset() {
  for (Level& level : levels_)
    for (std::size_t n = 0; n < level.value.size(); ++n) {
      const float sum = level.stiffness[n] + level.outside[n];
      level.inverse[n] = sum > 0 ? 1 / sum : 0;
    }
}

void NodeLevels::add_spring(std::span<const std::int32_t> node, std::span<const float> share, float stiffness) {
  std::vector<Link> at;
  for (std::size_t i = 0; i < node.size(); ++i) at.push_back({node[i], share[i]});
  for (Level& level : levels_) {
    std::map<std::int32_t, float> here;
    for (const Link& finer : at)
      for (std::int32_t i = level.parents.first[static_cast<std::size_t>(finer.node)];
           i < level.parents.first[static_cast<std::size_t>(finer.node) + 1]; ++i) {
        const Link& link = level.parents.link[static_cast<std::size_t>(i)];
        here[link.node] += link.share * finer.share;
      }
    at.clear();
    for (const auto& [n, value] : here) {
      at.push_back({n, value});
      float& inverse = level.inverse[static_cast<std::size_t>(n)];
      if (inverse > 0) inverse = 1 / (1 / inverse + stiffness * value * value);
    }
  }
}

TROCAR_LANES_CLONED void NodeLevels::restrict_level(std::span<const NodeRow> finer, Level& level) {
  for (std::size_t n = 0; n < level.value.size(); ++n) set(level.value[n], sum_of(level.children, finer.data(), n));
}

double NodeLevels::restrict(std::span<const NodeRow> residual) {
  double rho = 0;
  for (Level& level : levels_) {
    restrict_level(residual, level);
    residual = level.value;
  }
  for (Level& level : levels_)
    for (std::size_t n = 0; n < level.value.size(); ++n) {
      const Row r = row(level.value[n]), z = level.inverse[n] * r, product = r * z;
      rho += static_cast<double>(product[0] + product[1] + product[2]);
      set(level.value[n], z);
    }
  return rho;
}

TROCAR_LANES_CLONED void NodeLevels::advance(std::span<const NodeRow> finest, float beta,
                                             std::span<NodeRow> direction) {
  for (std::size_t l = levels_.size(); l-- > 1;)
    for (std::size_t n = 0; n < levels_[l - 1].value.size(); ++n) {
      NodeRow& value = levels_[l - 1].value[n];
      set(value, row(value) + sum_of(levels_[l].parents, levels_[l].value.data(), n));
    }
  const std::size_t known = levels_.empty() ? 0 : levels_.front().parents.first.size() - 1;
  for (std::size_t n = 0; n < known; ++n)
    set(direction[n],
        row(finest[n]) + sum_of(levels_.front().parents, levels_.front().value.data(), n) + beta * row(direction[n]));
  for (std::size_t n = known; n < direction.size(); ++n) set(direction[n], row(finest[n]) + beta * row(direction[n]));
}

}  // namespace trocar
