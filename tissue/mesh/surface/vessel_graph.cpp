#include "tissue/mesh/surface/vessel_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/mesh/surface/label_surface.h"

namespace trocar {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kCoverRadius = 1.3;  ///< a path covers what lies within so many radii, and a voxel
constexpr double kLeastBranch = 1.5;  ///< a branch is longer than so many radii of the vessel that it leaves

/// The label's voxels as a graph over 26 neighbours, with distances to the wall.
class VoxelTree {
 public:
  VoxelTree(const LabelMask& mask, const Vec3& spacing_mm) : mask_(mask), spacing_(spacing_mm) {
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          if (i != 0 || j != 0 || k != 0)
            steps_.push_back(
                {i + static_cast<std::ptrdiff_t>(mask.size[0]) * (j + static_cast<std::ptrdiff_t>(mask.size[1]) * k),
                 Vec3(i, j, k).cwiseProduct(spacing_mm).norm()});
    wall_ = wall_distances();
    covered_.assign(mask.inside.size(), false);
    for (std::size_t v = 0; v < covered_.size(); ++v) covered_[v] = mask.inside[v] == 0;
  }

  /// Of the largest ball whose middle is the voxel or one beside it: paths run on voxels, the true centre lies between
  /// them.
  double radius_mm(std::size_t voxel) const {
    double wall = wall_[voxel];
    for (const auto& [step, mm] : steps_)
      if (const std::size_t next = voxel + static_cast<std::size_t>(step); mask_.inside[next] != 0)
        wall = std::max(wall, wall_[next]);
    return std::max(wall - spacing_.mean() / 4,
                    spacing_.minCoeff() / 2);  // the wall lies up to half a voxel before its voxel
  }
  Vec3 index(std::size_t voxel) const {
    const auto row = static_cast<std::size_t>(mask_.size[0]), slice = row * static_cast<std::size_t>(mask_.size[1]);
    return {static_cast<double>(voxel % row), static_cast<double>(voxel % slice / row),
            static_cast<double>(voxel / slice)};
  }
  bool covered(std::size_t voxel) const { return covered_[voxel]; }

  /// Dijkstra from one voxel. @param central weigh lengths by 1 / wall^2, so that paths keep to the middle
  struct Paths {
    std::vector<double> length;
    std::vector<std::size_t> from;
  };
  Paths paths_from(std::size_t start, bool central) const {
    Paths paths{std::vector<double>(mask_.inside.size(), kFar), std::vector<std::size_t>(mask_.inside.size(), start)};
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    paths.length[start] = 0;
    open.emplace(0, start);
    while (!open.empty()) {
      const auto [length, voxel] = open.top();
      open.pop();
      if (length > paths.length[voxel]) continue;
      for (const auto& [step, mm] : steps_) {
        const std::size_t next = voxel + static_cast<std::size_t>(step);
        if (mask_.inside[next] == 0) continue;
        const double cost = central ? mm / (wall_[next] * wall_[next]) : mm;
        if (length + cost >= paths.length[next]) continue;
        paths.length[next] = length + cost;
        paths.from[next] = voxel;
        open.emplace(paths.length[next], next);
      }
    }
    return paths;
  }

  /// Marks what lies round a voxel of a path as done.
  void cover(std::size_t voxel) {
    const double reach = kCoverRadius * wall_[voxel] + spacing_.maxCoeff();
    const Vec3 centre = index(voxel);
    std::array<int, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      low[axis] = std::max(0, static_cast<int>(std::ceil(centre[a] - reach / spacing_[a])));
      high[axis] = std::min(mask_.size[axis] - 1, static_cast<int>(std::floor(centre[a] + reach / spacing_[a])));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          if ((Vec3(i, j, k) - centre).cwiseProduct(spacing_).norm() <= reach) covered_[mask_.offset(i, j, k)] = true;
  }

 private:
  /// To the nearest voxel outside, centre to centre, mm: chamfer by Dijkstra with the true vector to the wall voxel
  /// carried along.
  std::vector<double> wall_distances() const {
    std::vector<double> distance(mask_.inside.size(), kFar);
    std::vector<std::size_t> nearest(mask_.inside.size(), 0);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto offer = [&](std::size_t voxel, std::size_t wall) {
      const double mm = (index(voxel) - index(wall)).cwiseProduct(spacing_).norm();
      if (mm >= distance[voxel]) return;
      distance[voxel] = mm, nearest[voxel] = wall;
      open.emplace(mm, voxel);
    };
    for (std::size_t v = 0; v < mask_.inside.size(); ++v)
      for (std::size_t n = 0; mask_.inside[v] != 0 && n < steps_.size(); ++n)
        if (const std::size_t next = v + static_cast<std::size_t>(steps_[n].first); mask_.inside[next] == 0)
          offer(v, next);
    while (!open.empty()) {
      const auto [mm, voxel] = open.top();
      open.pop();
      if (mm > distance[voxel]) continue;
      for (const auto& [step, length] : steps_)
        if (const std::size_t next = voxel + static_cast<std::size_t>(step); mask_.inside[next] != 0)
          offer(next, nearest[voxel]);
    }
    return distance;
  }

  const LabelMask& mask_;
  Vec3 spacing_;
  std::vector<std::pair<std::ptrdiff_t, double>> steps_;
  std::vector<double> wall_;
  std::vector<bool> covered_;
};

std::size_t farthest(const std::vector<double>& lengths, const VoxelTree& tree, bool uncovered_only) {
  std::size_t best = lengths.size();
  for (std::size_t v = 0; v < lengths.size(); ++v)
    if (lengths[v] < kFar && !(uncovered_only && tree.covered(v)) &&
        (best == lengths.size() || lengths[v] > lengths[best]))
      best = v;
  return best;
}

class GraphBuilder {
 public:
  GraphBuilder(VoxelTree& tree, const Eigen::Affine3d& to_ras_m) : tree_(tree), to_ras_(to_ras_m) {}

  /// The tree of the part that holds the voxel.
  void add_part(std::size_t seed) {
    const std::size_t root = farthest(tree_.paths_from(seed, false).length, tree_, false);
    const auto plain = tree_.paths_from(root, false), central = tree_.paths_from(root, true);
    ++graph_.parts;
    add_node(root);
    tree_.cover(root);
    for (std::size_t tip = farthest(plain.length, tree_, true); tip < plain.length.size();
         tip = farthest(plain.length, tree_, true))
      add_path(tip, root, central.from);
  }

  VesselGraph finish() {
    smooth();
    for (const auto& [a, b] : graph_.edges)
      graph_.length_m +=
          (graph_.nodes[static_cast<std::size_t>(a)].place_m - graph_.nodes[static_cast<std::size_t>(b)].place_m)
              .norm();
    return std::move(graph_);
  }

 private:
  std::int32_t add_node(std::size_t voxel) {
    const auto [entry, fresh] = number_.try_emplace(voxel, static_cast<std::int32_t>(graph_.nodes.size()));
    if (fresh) graph_.nodes.push_back({to_ras_ * tree_.index(voxel), tree_.radius_mm(voxel) * 1e-3});
    return entry->second;
  }

  void add_path(std::size_t tip, std::size_t root, const std::vector<std::size_t>& from) {
    std::vector<std::size_t> path{tip};
    while (!number_.contains(path.back()) && path.back() != root) path.push_back(from[path.back()]);
    const bool first = graph_.edges.empty() || path.back() == root;
    double length_m = 0;
    for (std::size_t n = 1; n < path.size(); ++n)
      length_m += (to_ras_ * tree_.index(path[n]) - to_ras_ * tree_.index(path[n - 1])).norm();
    const bool long_enough = first || length_m > kLeastBranch * tree_.radius_mm(path.back()) * 1e-3;
    for (const std::size_t voxel : path) tree_.cover(voxel);
    if (!long_enough) return;
    for (std::size_t n = path.size() - 1; n > 0; --n) {
      const std::int32_t a = add_node(path[n]), b = add_node(path[n - 1]);
      graph_.edges.push_back({a, b});
    }
  }

  /// Voxel steps zigzag: nodes between two others move to a weighted mean, twice.
  void smooth() {
    std::vector<std::vector<std::int32_t>> round(graph_.nodes.size());
    for (const auto& [a, b] : graph_.edges)
      round[static_cast<std::size_t>(a)].push_back(b), round[static_cast<std::size_t>(b)].push_back(a);
    for (int sweep = 0; sweep < 2; ++sweep) {
      const std::vector<VesselNode> old = graph_.nodes;
      for (std::size_t n = 0; n < old.size(); ++n)
        if (round[n].size() == 2)
          graph_.nodes[n].place_m = old[n].place_m / 2 + (old[static_cast<std::size_t>(round[n][0])].place_m +
                                                          old[static_cast<std::size_t>(round[n][1])].place_m) /
                                                             4;
    }
  }

  VoxelTree& tree_;
  Eigen::Affine3d to_ras_;
  VesselGraph graph_;
  std::map<std::size_t, std::int32_t> number_;
};

std::size_t nodes_of_degree(const VesselGraph& graph, std::size_t low, std::size_t high) {
  std::vector<std::size_t> degree(graph.nodes.size(), 0);
  for (const auto& [a, b] : graph.edges) ++degree[static_cast<std::size_t>(a)], ++degree[static_cast<std::size_t>(b)];
  return static_cast<std::size_t>(
      std::count_if(degree.begin(), degree.end(), [&](std::size_t d) { return d >= low && d <= high; }));
}

}  // namespace

std::size_t VesselGraph::ends() const { return nodes_of_degree(*this, 1, 1); }
std::size_t VesselGraph::branchings() const { return nodes_of_degree(*this, 3, nodes.size()); }

VesselGraph vessel_graph(const LabelVolume& volume, int label, const Progress& progress) {
  const LabelMask mask = cut_out_label(volume, label, 2, {.least_share = 0, .bridge_voxels = 0});
  const Vec3 spacing_mm = volume.index_to_ras_mm.linear().colwise().norm().transpose();
  report(progress, "finding the centrelines", 0);
  VoxelTree tree(mask, spacing_mm);
  GraphBuilder builder(tree, box_to_ras_m(volume, mask));
  for (std::size_t v = 0; v < mask.inside.size(); ++v)
    if (!tree.covered(v)) {
      report(progress, "finding the centrelines", static_cast<double>(v) / static_cast<double>(mask.inside.size()));
      builder.add_part(v);
    }
  return builder.finish();
}

}  // namespace trocar
