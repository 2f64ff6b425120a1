#include "tissue/solid/lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/column_samples.h"

namespace trocar {
namespace {

using Place = std::array<std::int32_t, 3>;  // ordered by k, j, i through `later`

constexpr int kSamples = 8;  ///< along each edge of a cell
constexpr std::int64_t kMostCells = 500000;
constexpr double kPerCell = kSamples * kSamples * kSamples;

bool before(const Place& a, const Place& b) { return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]}; }
struct ByPlace {
  bool operator()(const Place& a, const Place& b) const { return before(a, b); }
};

struct Box {
  Vec3 origin_m;
  Place cells;
};

/// Just large enough, centred on the surface where no grid is given.
Box box_round(const TriangleSurface& surface, double cell_m, const std::optional<Vec3>& grid_m) {
  if (!(cell_m > 0) || !std::isfinite(cell_m)) throw InputError("the lattice's cell must be longer than 0 m");
  if (surface.triangles.empty()) throw InputError("an empty surface has no lattice");
  const auto bounds = surface.bounds();
  Box box;
  double count = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double first = grid_m ? std::floor((bounds.min()[axis] - (*grid_m)[axis]) / cell_m) : 0;
    const double cells = grid_m ? std::floor((bounds.max()[axis] - (*grid_m)[axis]) / cell_m) + 1 - first
                                : std::max(1.0, std::ceil(bounds.sizes()[axis] / cell_m + 1e-6));
    count *= cells;
    if (!(count <= static_cast<double>(kMostCells)))
      throw InputError("cells of " + std::to_string(cell_m * 1e3) + " mm would be more than " +
                       std::to_string(kMostCells) + " over this organ: choose a longer edge");
    box.cells[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(cells);
    box.origin_m[axis] = grid_m ? (*grid_m)[axis] + first * cell_m : bounds.center()[axis] - cells * cell_m / 2;
  }
  return box;
}

Place cell_of(const Vec3& p, const Box& box, double cell_m) {
  Place place{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    place[n] =
        std::clamp(static_cast<std::int32_t>(std::floor((p[axis] - box.origin_m[axis]) / cell_m)), 0, box.cells[n] - 1);
  }
  return place;
}

struct Counted {
  int samples = 0;
  std::map<int, int> votes;
  bool vertex = false;  ///< a vertex of the surface lies in it
};
using Cells = std::map<Place, Counted, ByPlace>;

int label_at(const LabelVolume& labels, const Eigen::Affine3d& to_index, const Vec3& p) {
  const Eigen::Vector3i voxel = Vec3(to_index * Vec3(p * 1e3)).array().round().cast<int>();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] >= labels.size[static_cast<std::size_t>(axis)]) return 0;
  return labels.labels[labels.offset(voxel[0], voxel[1], voxel[2])];
}

Cells count_cells(const TriangleSurface& surface, const Box& box, const LatticeOptions& options,
                  const LabelVolume* labels) {
  Cells cells;
  const double step = options.cell_m / kSamples;
  const Vec3 first = box.origin_m + Vec3::Constant(step / 2);
  const std::array<int, 3> samples{box.cells[0] * kSamples, box.cells[1] * kSamples, box.cells[2] * kSamples};
  const Eigen::Affine3d to_index = labels != nullptr ? labels->index_to_ras_mm.inverse() : Eigen::Affine3d::Identity();
  for_inside_samples(surface, first, step, samples, [&](int i, int j, int k) {
    Counted& cell = cells[{i / kSamples, j / kSamples, k / kSamples}];
    ++cell.samples;
    if (labels != nullptr) ++cell.votes[label_at(*labels, to_index, first + step * Vec3(i, j, k))];
  });
  for (const Vec3& vertex : surface.vertices) cells[cell_of(vertex, box, options.cell_m)].vertex = true;
  return cells;
}

/// The label of most samples; of equals the smallest.
int winner(const std::map<int, int>& votes) {
  int best = 0, most = 0;
  for (const auto& [label, count] : votes)
    if (label != 0 && count > most) best = label, most = count;
  return best;
}

void add_cells(const Cells& counted, const LatticeOptions& options, Lattice& lattice, LatticeFacts& facts) {
  std::map<Place, std::int32_t, ByPlace> nodes;
  for (const auto& [place, cell] : counted)
    for (int corner = 0; corner < 8; ++corner)
      nodes[{place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2)}] = 0;
  for (auto& [place, number] : nodes) {
    number = static_cast<std::int32_t>(lattice.nodes.size());
    lattice.nodes.push_back(place);
  }
  const double cell_ml = std::pow(options.cell_m, 3) * 1e6;
  for (const auto& [place, cell] : counted) {
    LatticeCell& made = lattice.cells.emplace_back();
    made.place = place;
    for (int corner = 0; corner < 8; ++corner)
      made.corners[static_cast<std::size_t>(corner)] =
          nodes.at({place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2)});
    const double fill = cell.samples / kPerCell;
    made.fill = std::max(fill, options.least_fill);
    made.label = winner(cell.votes);
    facts.sampled_volume_ml += fill * cell_ml;
    facts.floored_volume_ml += (made.fill - fill) * cell_ml;
    facts.full_cells += fill > 0.999 ? 1 : 0;
    facts.floored_cells += fill < options.least_fill ? 1 : 0;
    facts.empty_cells += cell.samples == 0 ? 1 : 0;
    ++facts.fill_tenths[std::min<std::size_t>(9, static_cast<std::size_t>(fill * 10))];
  }
}

void embed(const TriangleSurface& surface, const Box& box, const Cells& counted, Lattice& lattice,
           LatticeFacts& facts) {
  std::map<Place, std::int32_t, ByPlace> number;
  for (const auto& [place, cell] : counted) number.emplace(place, static_cast<std::int32_t>(number.size()));
  for (const Vec3& vertex : surface.vertices) {
    Embedding& e = lattice.embedding.emplace_back();
    const Place place = cell_of(vertex, box, lattice.cell_m);
    e.cell = number.at(place);
    const Vec3 local =
        ((vertex - lattice.origin_m) / lattice.cell_m - Vec3(place[0], place[1], place[2])).cwiseMax(0).cwiseMin(1);
    Vec3 back = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      for (int axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? local[axis] : 1 - local[axis];
      const auto n = static_cast<std::size_t>(corner);
      e.weights[n] = static_cast<float>(weight);
      back += e.weights[n] *
              lattice.node_m(static_cast<std::size_t>(lattice.cells[static_cast<std::size_t>(e.cell)].corners[n]));
    }
    facts.worst_embedding_m = std::max(facts.worst_embedding_m, (back - vertex).norm());
  }
}

std::size_t count_components(const Lattice& lattice) {
  std::map<Place, bool, ByPlace> seen;
  for (const LatticeCell& cell : lattice.cells) seen[cell.place] = false;
  std::size_t components = 0;
  for (auto& [start, visited] : seen) {
    if (visited) continue;
    ++components;
    std::vector<Place> open{start};
    visited = true;
    while (!open.empty()) {
      const Place here = open.back();
      open.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Place next = here;
          next[axis] += step;
          const auto found = seen.find(next);
          if (found != seen.end() && !found->second) found->second = true, open.push_back(next);
        }
    }
  }
  return components;
}

}  // namespace

BuiltLattice build_lattice(const TriangleSurface& surface, const LatticeOptions& options, const LabelVolume* labels) {
  const Box box = box_round(surface, options.cell_m, options.grid_m);
  report(options.progress, "filling the lattice", 0);
  const Cells counted = count_cells(surface, box, options, labels);
  BuiltLattice built;
  Lattice& lattice = built.lattice;
  lattice.origin_m = box.origin_m;
  lattice.cell_m = options.cell_m;
  add_cells(counted, options, lattice, built.facts);
  report(options.progress, "embedding the surface", 0);
  embed(surface, box, counted, lattice, built.facts);
  built.facts.cells = lattice.cells.size();
  built.facts.nodes = lattice.nodes.size();
  built.facts.components = count_components(lattice);
  built.facts.volume_error_pct = (built.facts.sampled_volume_ml / (surface.volume_m3() * 1e6) - 1) * 100;
  return built;
}

Lattice beside(Lattice first, const Lattice& more) {
  const Vec3 way = (more.origin_m - first.origin_m) / first.cell_m;
  const Vec3 steps = way.array().round();
  constexpr double kOffGrid = 1e-6;  // of an edge
  if (more.cell_m != first.cell_m || (way - steps).norm() > kOffGrid)
    throw InputError("two lattices that are laid beside each other have one edge and one grid");
  const auto moved = [&](std::array<std::int32_t, 3> place) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] += static_cast<std::int32_t>(steps[static_cast<Eigen::Index>(axis)]);
    return place;
  };
  const auto nodes = static_cast<std::int32_t>(first.nodes.size()),
             cells = static_cast<std::int32_t>(first.cells.size());
  std::int32_t parts = 0;
  for (const LatticeCell& cell : first.cells) parts = std::max(parts, cell.part + 1);
  for (const auto& node : more.nodes) first.nodes.push_back(moved(node));
  for (LatticeCell cell : more.cells) {
    cell.place = moved(cell.place);
    for (std::int32_t& corner : cell.corners) corner += nodes;
    cell.part += parts;
    first.cells.push_back(cell);
  }
  for (Embedding e : more.embedding) {
    e.cell += cells;
    if (e.other >= 0) e.other += cells;
    first.embedding.push_back(e);
  }
  return first;
}

}  // namespace trocar
