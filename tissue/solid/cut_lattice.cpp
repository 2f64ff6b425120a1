#include "tissue/solid/cut_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/column_samples.h"

namespace trocar {
namespace {

constexpr int kCubes = 4;  // along a cell's edge
constexpr int kInCell = kCubes * kCubes * kCubes;
constexpr std::array<int, 3> kStride{1, kCubes, kCubes* kCubes};
constexpr int kLeastPart = kInCell / 16;  // cubes
constexpr int kLeastOfSection =
    4;  // a cell is cut whole once a quarter of its section is: 16 links, fewer at the surface
constexpr double kAboveSurface = 1.5;           // cubes by which a sheet stands out of the surface
const Vec3 kCentre(0.50137, 0.49859, 0.50073);  // of a cube: on no plane that somebody would cut along
constexpr double kBeside = 0.0003;              // m from a sheet: which side is meant
constexpr double kStraight = 5e-5;              // m from a sheet, within which a point of its line is left out
constexpr double kSeam = 1e-6;                  // of a sheet's triangle, beyond its edges: seams let no link through
constexpr std::size_t kRemembered = 8;          // surfaces of before
constexpr double kFar = 2;                      // cells: half the size of the plane that breaks the rest of a section

int at_axis(int cube, std::size_t axis) { return cube / kStride[axis] % kCubes; }
std::uint64_t bit(int cube) { return std::uint64_t{1} << cube; }

/// Where a way from a to b meets a triangle, as a share of the way.
bool crosses(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& sheet, double* share = nullptr) {
  const Vec3 ab = sheet[1] - sheet[0], ac = sheet[2] - sheet[0], way = b - a;
  const Vec3 p = way.cross(ac);
  const double det = ab.dot(p);
  if (!(std::abs(det) > 1e-18)) return false;
  const Vec3 from = a - sheet[0];
  const double u = from.dot(p) / det;
  const Vec3 q = from.cross(ab);
  const double v = way.dot(q) / det, t = ac.dot(q) / det;
  if (u < -kSeam || v < -kSeam || u + v > 1 + kSeam || t < 0 || t >= 1) return false;
  if (share != nullptr) *share = t;
  return true;
}

double off_way(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double length = way.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0;
  return (p - a - share * way).norm();
}

/// Cubes reached from one of them over unbroken links.
std::uint64_t reached(int from, std::uint64_t inside, const std::array<std::uint64_t, 3>& broken) {
  std::uint64_t seen = bit(from), open = seen;
  while (open != 0) {
    const int cube = std::countr_zero(open);
    open &= open - 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int here = at_axis(cube, axis);
      const auto go = [&](int next, int link) {
        if ((inside & bit(next)) != 0 && (seen & bit(next)) == 0 && (broken[axis] & bit(link)) == 0)
          seen |= bit(next), open |= bit(next);
      };
      if (here + 1 < kCubes) go(cube + kStride[axis], cube);
      if (here > 0) go(cube - kStride[axis], cube - kStride[axis]);
    }
  }
  return seen;
}

std::vector<std::uint64_t> parts_of(std::uint64_t inside, const std::array<std::uint64_t, 3>& broken) {
  std::vector<std::uint64_t> parts;
  for (std::uint64_t left = inside; left != 0;) {
    parts.push_back(reached(std::countr_zero(left), inside, broken));
    left &= ~parts.back();
  }
  return parts;
}

/// Cubes within one of these.
std::uint64_t grown(std::uint64_t cubes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint64_t next = cubes;
    for (int cube = 0; cube < kInCell; ++cube)
      if ((cubes & bit(cube)) != 0) {
        if (at_axis(cube, axis) + 1 < kCubes) next |= bit(cube + kStride[axis]);
        if (at_axis(cube, axis) > 0) next |= bit(cube - kStride[axis]);
      }
    cubes = next;
  }
  return cubes;
}

std::size_t find_root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}
/// The lower one stays the root.
void join(std::vector<std::size_t>& parent, std::size_t a, std::size_t b) {
  a = find_root(parent, a);
  b = find_root(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

Vec3 normal_of_sheet(const std::array<Vec3, 3>& sheet) { return (sheet[1] - sheet[0]).cross(sheet[2] - sheet[0]); }

}  // namespace

CutLattice::CutLattice(Lattice lattice, SurfacePtr rest) : lattice_(std::move(lattice)), rest_(std::move(rest)) {
  if (lattice_.embedding.size() != rest_->vertices.size())
    throw InputError("a lattice that embeds " + std::to_string(lattice_.embedding.size()) +
                     " vertices is not that of a surface of " + std::to_string(rest_->vertices.size()));
  for (std::size_t c = 0; c < lattice_.cells.size(); ++c) {
    const LatticeCell& cell = lattice_.cells[c];
    place_.push_back({cell.place, cell.part});
    block_of_[place_.back()] = static_cast<std::int32_t>(c);
    fill_.push_back(cell.fill);
    blocks_.emplace_back().cells = {static_cast<std::int32_t>(c)};
  }
  fill_blocks();
  for (const Vec3& vertex : rest_->vertices) probe_.push_back({vertex, vertex});
  pieces_ = components();
}

void CutLattice::fill_blocks() {
  Place low = place_.front(), high = low;
  for (const Place& place : place_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  const double step = lattice_.cell_m / kCubes;
  const Vec3 first = lattice_.origin_m + lattice_.cell_m * Vec3(low[0], low[1], low[2]) + Vec3::Constant(step / 2);
  const auto mark = [&](int i, int j, int k, std::int32_t part) {
    const auto block = block_of_.find({{low[0] + i / kCubes, low[1] + j / kCubes, low[2] + k / kCubes}, part});
    if (block != block_of_.end())
      blocks_[static_cast<std::size_t>(block->second)].inside |=
          bit(i % kCubes + kCubes * (j % kCubes) + kCubes * kCubes * (k % kCubes));
  };
  std::int32_t parts = 0;
  for (const Place& place : place_) parts = std::max(parts, place.part + 1);
  for (std::int32_t part = 0; part < parts; ++part)
    for_inside_samples(
        surface_of(part), first, step,
        {(high[0] - low[0] + 1) * kCubes, (high[1] - low[1] + 1) * kCubes, (high[2] - low[2] + 1) * kCubes},
        [&](int i, int j, int k) { mark(i, j, k, part); });
  for (std::size_t v = 0; v < rest_->vertices.size(); ++v) {
    const Vec3 at = (rest_->vertices[v] - first) / step + Vec3::Constant(0.5);
    if (at.minCoeff() >= 0)
      mark(static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2]),
           part_of(static_cast<std::int32_t>(v)));
  }
  for (Block& block : blocks_) {
    block.inside = block.inside == 0 ? ~std::uint64_t{0} : grown(block.inside);
    block.parts = {block.inside};
  }
}

TriangleSurface CutLattice::surface_of(std::int32_t part) const {
  TriangleSurface out{rest_->vertices, {}};
  for (const auto& triangle : rest_->triangles)
    if (part_of(triangle[0]) == part) out.triangles.push_back(triangle);
  return out;
}

std::int32_t CutLattice::part_of(std::int32_t vertex) const {
  const Embedding& e = lattice_.embedding[static_cast<std::size_t>(vertex)];
  return lattice_.cells[static_cast<std::size_t>(e.cell)].part;
}

CutLattice::Place CutLattice::place_of(const Vec3& at_rest, std::int32_t part) const {
  const Vec3 cell = ((at_rest - lattice_.origin_m) / lattice_.cell_m).array().floor();
  return {{static_cast<std::int32_t>(cell[0]), static_cast<std::int32_t>(cell[1]), static_cast<std::int32_t>(cell[2])},
          part};
}

Embedding CutLattice::hang(const Vec3& place, std::int32_t vertex) const {
  Embedding out{lattice_.embedding[static_cast<std::size_t>(vertex)].cell};
  const auto& at = lattice_.cells[static_cast<std::size_t>(out.cell)].place;
  const Vec3 local = (place - lattice_.origin_m) / lattice_.cell_m - Vec3(at[0], at[1], at[2]);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? local[axis] : 1 - local[axis];
    out.weights[corner] = static_cast<float>(weight);
  }
  return out;
}

SurfacePtr CutLattice::rest_of(std::uint64_t topology) const {
  if (rest_->topology == topology) return rest_;
  for (const SurfacePtr& surface : before_)
    if (surface->topology == topology) return surface;
  return nullptr;
}

const CutLattice::Block* CutLattice::block_at(const Place& place) const {
  const auto found = block_of_.find(place);
  return found == block_of_.end() ? nullptr : &blocks_[static_cast<std::size_t>(found->second)];
}

Vec3 CutLattice::cube_centre(const Place& place, int cube) const {
  const double step = lattice_.cell_m / kCubes;
  return lattice_.origin_m + lattice_.cell_m * Vec3(place[0], place[1], place[2]) +
         step * (Vec3(at_axis(cube, 0), at_axis(cube, 1), at_axis(cube, 2)) + kCentre);
}

std::vector<std::int32_t> CutLattice::sever(std::span<const Sheet> sheets, std::int32_t part) {
  std::set<std::int32_t> touched;
  const double step = lattice_.cell_m / kCubes;
  for (const Sheet& sheet : sheets) {
    const Vec3 low = sheet[0].cwiseMin(sheet[1]).cwiseMin(sheet[2]) - Vec3::Constant(step);
    const Vec3 high = sheet[0].cwiseMax(sheet[1]).cwiseMax(sheet[2]);
    const Place from = place_of(low, part), to = place_of(high, part);
    for (Place at = from; at[2] <= to[2]; ++at[2])
      for (at[1] = from[1]; at[1] <= to[1]; ++at[1])
        for (at[0] = from[0]; at[0] <= to[0]; ++at[0]) {
          const auto found = block_of_.find(at);
          if (found == block_of_.end()) continue;
          Block& block = blocks_[static_cast<std::size_t>(found->second)];
          block.sheets.push_back(sheet);
          for (int cube = 0; cube < kInCell; ++cube) {
            const Vec3 centre = cube_centre(at, cube);
            if ((centre.array() < low.array()).any() || (centre.array() > high.array()).any()) continue;
            for (std::size_t axis = 0; axis < 3; ++axis) {
              if ((block.broken[axis] & bit(cube)) != 0) continue;
              if (!crosses(centre, centre + step * Vec3::Unit(static_cast<Eigen::Index>(axis)), sheet)) continue;
              block.broken[axis] |= bit(cube);
              touched.insert(found->second);
              Place beyond = at;
              ++beyond[axis];
              if (const auto next = block_of_.find(beyond);
                  at_axis(cube, axis) + 1 == kCubes && next != block_of_.end())
                touched.insert(next->second);
            }
          }
        }
  }
  return {touched.begin(), touched.end()};
}

void CutLattice::sever_rest(std::int32_t number, std::vector<std::int32_t>& touched) {
  Block& block = blocks_[static_cast<std::size_t>(number)];
  const Place& place = place_[static_cast<std::size_t>(number)];
  for (std::size_t axis = 0; axis < 3; ++axis) {  // of a face to the next block, where the sheet runs along it
    Place beyond = place;
    ++beyond[axis];
    const Block* next = block_at(beyond);
    if (next == nullptr) continue;
    std::uint64_t face = 0;
    for (int cube = 0; cube < kInCell; ++cube)
      if (at_axis(cube, axis) + 1 == kCubes && (block.inside & bit(cube)) != 0 &&
          (next->inside & bit(cube - (kCubes - 1) * kStride[axis])) != 0)
        face |= bit(cube);
    const int broken = std::popcount(block.broken[axis] & face);
    if (broken < kLeastOfSection || kLeastOfSection * broken < std::popcount(face)) continue;
    block.broken[axis] |= face;
    touched.push_back(number);
  }
  if (block.parts.size() > 1 || block.sheets.empty()) return;
  // The mean of where the sheets break links of this cell, and their mean normal.
  const double step = lattice_.cell_m / kCubes;
  Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
  int count = 0;
  for (int cube = 0; cube < kInCell; ++cube)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((block.broken[axis] & bit(cube)) == 0 || at_axis(cube, axis) + 1 == kCubes) continue;
      const Vec3 centre = cube_centre(place, cube);
      for (const Sheet& sheet : block.sheets) {
        double share = 0;
        const Vec3 way = step * Vec3::Unit(static_cast<Eigen::Index>(axis));
        if (!crosses(centre, centre + way, sheet, &share)) continue;
        Vec3 n = normal_of_sheet(sheet).normalized();
        if (n.dot(normal) < 0) n = -n;
        middle += centre + share * way;
        normal += n;
        ++count;
        break;
      }
    }
  if (count < kLeastOfSection) return;
  middle /= count;
  if (!(normal.norm() > 0.5 * count)) return;  // sheets of several directions
  normal.normalize();
  const Vec3 u = normal.unitOrthogonal() * kFar * lattice_.cell_m, v = normal.cross(u);
  const std::array<Sheet, 2> plane{Sheet{middle - u - v, middle + u - v, middle + u + v},
                                   Sheet{middle - u - v, middle + u + v, middle - u + v}};
  std::array<std::uint64_t, 3> crossed{};
  int all = 0;
  for (int cube = 0; cube < kInCell; ++cube)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at_axis(cube, axis) + 1 == kCubes) continue;
      if ((block.inside & bit(cube)) == 0 || (block.inside & bit(cube + kStride[axis])) == 0) continue;
      const Vec3 centre = cube_centre(place, cube);
      const Vec3 beyond = centre + step * Vec3::Unit(static_cast<Eigen::Index>(axis));
      if (!crosses(centre, beyond, plane[0]) && !crosses(centre, beyond, plane[1])) continue;
      crossed[axis] |= bit(cube);
      ++all;
    }
  if (kLeastOfSection * count < all) return;
  for (std::size_t axis = 0; axis < 3; ++axis) block.broken[axis] |= crossed[axis];
  block.sheets.insert(block.sheets.end(), plane.begin(), plane.end());
  touched.push_back(number);
}

void CutLattice::split(std::int32_t number, LatticeChange& change) {
  Block& block = blocks_[static_cast<std::size_t>(number)];
  std::vector<std::uint64_t> parts, crumbs;
  for (const std::uint64_t part : parts_of(block.inside, block.broken))
    (std::popcount(part) >= kLeastPart ? parts : crumbs).push_back(part);
  for (const std::uint64_t crumb : crumbs) cut_off(number, crumb);
  if (parts.size() <= block.parts.size()) return;
  const auto grow_to = [](std::uint64_t crumb, std::uint64_t part) {  // growings until they meet
    int steps = 0;
    for (; (crumb & part) == 0 && steps < kInCell; ++steps) crumb = grown(crumb);
    return steps;
  };
  for (const std::uint64_t crumb : crumbs)
    *std::min_element(parts.begin(), parts.end(),
                      [&](std::uint64_t a, std::uint64_t b) { return grow_to(crumb, a) < grow_to(crumb, b); }) |= crumb;
  // Each present cell stays the part with most of its cubes.
  std::vector<std::uint64_t> now(block.parts.size(), 0);
  std::vector<std::pair<std::size_t, std::uint64_t>> made;  // of which present one, cubes
  for (std::uint64_t part : parts) {
    std::size_t best = 0;
    for (std::size_t p = 1; p < block.parts.size(); ++p)
      if (std::popcount(part & block.parts[p]) > std::popcount(part & block.parts[best])) best = p;
    if (std::popcount(part) > std::popcount(now[best])) std::swap(now[best], part);
    if (part != 0) made.emplace_back(best, part);
  }
  for (const auto& [parent, part] : made) {
    const auto cell = static_cast<std::int32_t>(lattice_.cells.size());
    lattice_.cells.push_back(lattice_.cells[static_cast<std::size_t>(block.cells[parent])]);
    change.cells.push_back({cell, block.cells[parent]});
    block.cells.push_back(cell);
    now.push_back(part);
  }
  block.parts = std::move(now);
  const double whole = std::popcount(block.inside);
  for (std::size_t p = 0; p < block.parts.size(); ++p)
    lattice_.cells[static_cast<std::size_t>(block.cells[p])].fill =
        fill_[static_cast<std::size_t>(number)] * std::popcount(block.parts[p]) / whole;
}

void CutLattice::cut_off(std::int32_t number, std::uint64_t crumb) {
  Block& block = blocks_[static_cast<std::size_t>(number)];
  const auto each = [&](auto&& tell) {  // links of the crumb: block, bit, axis, whether it leads to another block
    for (std::uint64_t left = crumb; left != 0; left &= left - 1) {
      const int cube = std::countr_zero(left);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool last = at_axis(cube, axis) + 1 == kCubes;
        tell(block, bit(cube), axis, last);
        if (at_axis(cube, axis) > 0) {
          tell(block, bit(cube - kStride[axis]), axis, false);
          continue;
        }
        Place before = place_[static_cast<std::size_t>(number)];
        --before[axis];
        if (const auto found = block_of_.find(before); found != block_of_.end())
          tell(blocks_[static_cast<std::size_t>(found->second)], bit(cube + (kCubes - 1) * kStride[axis]), axis, true);
      }
    }
  };
  bool cut = false;  // else it is one of the lattice's own
  each([&](const Block& of, std::uint64_t link, std::size_t axis, bool) { cut |= (of.broken[axis] & link) != 0; });
  if (cut)
    each([&](Block& of, std::uint64_t link, std::size_t axis, bool leads_out) {
      if (leads_out) of.broken[axis] |= link;
    });
}

bool CutLattice::linked(const Block& a, std::size_t part_a, const Block& b, std::size_t part_b,
                        std::size_t axis) const {
  bool any = false;
  for (int cube = 0; cube < kInCell; ++cube) {
    if (at_axis(cube, axis) + 1 != kCubes) continue;
    const int beyond = cube - (kCubes - 1) * kStride[axis];
    if ((a.parts[part_a] & bit(cube)) == 0 || (b.parts[part_b] & bit(beyond)) == 0) continue;
    if ((a.broken[axis] & bit(cube)) == 0) return true;
    any = true;
  }
  return !any && a.parts.size() == 1 && b.parts.size() == 1;  // as the lattice has them where no tissue tells
}

void CutLattice::share_nodes(const std::vector<std::int32_t>& touched, LatticeChange& change) {
  std::set<Place> nodes;
  for (const std::int32_t block : touched)
    for (int corner = 0; corner < 8; ++corner) {
      Place node = place_[static_cast<std::size_t>(block)];
      for (std::size_t axis = 0; axis < 3; ++axis) node[axis] += corner >> axis & 1;
      nodes.insert(node);
    }
  std::set<std::int32_t> changed;
  for (const Place& node : nodes) {
    struct Member {
      const Block* block;
      std::size_t part;
      int octant;  // of the node, bits as a corner's
    };
    std::vector<Member> members;
    for (int octant = 0; octant < 8; ++octant) {
      Place place = node;
      for (std::size_t axis = 0; axis < 3; ++axis) place[axis] -= 1 - (octant >> axis & 1);
      if (const Block* block = block_at(place))
        for (std::size_t part = 0; part < block->parts.size(); ++part) members.push_back({block, part, octant});
    }
    std::vector<std::size_t> root(members.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const int differ = members[i].octant ^ members[j].octant;
        if (std::popcount(static_cast<unsigned>(differ)) != 1) continue;
        if (linked(*members[i].block, members[i].part, *members[j].block, members[j].part,
                   static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(differ)))))
          join(root, i, j);
      }
    std::set<std::int32_t> taken;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (find_root(root, i) != i) continue;
      // A group keeps the lowest of its nodes that no group before it has kept; else it gets one of its own.
      std::int32_t keeps = -1, parent = std::numeric_limits<std::int32_t>::max();
      std::vector<std::pair<std::int32_t, std::size_t>> corners;
      for (std::size_t j = i; j < members.size(); ++j) {
        if (find_root(root, j) != i) continue;
        const std::int32_t cell = members[j].block->cells[members[j].part];
        const std::size_t corner = static_cast<std::size_t>(7 ^ members[j].octant);
        const std::int32_t now = lattice_.cells[static_cast<std::size_t>(cell)].corners[corner];
        corners.emplace_back(cell, corner);
        parent = std::min(parent, now);
        if (!taken.contains(now) && (keeps < 0 || now < keeps)) keeps = now;
      }
      if (keeps < 0) {
        keeps = static_cast<std::int32_t>(lattice_.nodes.size());
        lattice_.nodes.push_back(node);
        change.node_parent.push_back(parent);
      }
      taken.insert(keeps);
      for (const auto& [cell, corner] : corners) {
        std::int32_t& now = lattice_.cells[static_cast<std::size_t>(cell)].corners[corner];
        if (now != keeps) changed.insert(cell);
        now = keeps;
      }
    }
  }
  std::set<std::int32_t> made;
  for (const LatticeChange::Cell& cell : change.cells) made.insert(cell.number);
  for (const std::int32_t block : touched)
    for (const std::int32_t cell : blocks_[static_cast<std::size_t>(block)].cells) changed.insert(cell);
  for (const std::int32_t cell : changed)
    if (!made.contains(cell)) change.cells.push_back({cell, cell});
  std::sort(change.cells.begin(), change.cells.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
}

std::size_t CutLattice::components() const {
  std::vector<std::size_t> root(lattice_.cells.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto face = [&](std::int32_t cell, std::size_t axis, bool upper) {
    std::array<std::int32_t, 4> nodes{};
    std::size_t n = 0;
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner >> axis & 1) == (upper ? 1U : 0U))
        nodes[n++] = lattice_.cells[static_cast<std::size_t>(cell)].corners[corner];
    return nodes;
  };
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Place beyond = place_[b];
      ++beyond[axis];
      const Block* next = block_at(beyond);
      if (next == nullptr) continue;
      for (const std::int32_t cell : blocks_[b].cells)
        for (const std::int32_t other : next->cells)
          if (face(cell, axis, true) == face(other, axis, false))
            join(root, static_cast<std::size_t>(cell), static_cast<std::size_t>(other));
    }
  std::size_t count = 0;
  for (std::size_t n = 0; n < root.size(); ++n) count += find_root(root, n) == n;
  return count;
}

std::int32_t CutLattice::cell_for(const Vec3& probe, std::int32_t part) const {
  const Place here = place_of(probe, part);
  // The nearest cube of the block there, else of those beside it, that no sheet stands before.
  struct Candidate {
    double distance;
    std::int32_t cell;
    Vec3 centre;
    const Block* block;
  };
  for (const bool beside : {false, true}) {
    std::vector<Candidate> candidates;
    for (int step = 0; step < 27; ++step) {
      if (beside == (step == 13)) continue;
      const Place place{{here[0] + step % 3 - 1, here[1] + step / 3 % 3 - 1, here[2] + step / 9 - 1}, part};
      const Block* block = block_at(place);
      if (block == nullptr) continue;
      if (block->parts.size() == 1 && !beside) return block->cells.front();
      for (std::size_t piece = 0; piece < block->parts.size(); ++piece)
        for (int cube = 0; cube < kInCell; ++cube) {
          if ((block->parts[piece] & bit(cube)) == 0) continue;
          const Vec3 centre = cube_centre(place, cube);
          candidates.push_back({(centre - probe).squaredNorm(), block->cells[piece], centre, block});
        }
    }
    if (candidates.empty()) continue;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (const Candidate& c : candidates)
      if (std::none_of(c.block->sheets.begin(), c.block->sheets.end(),
                       [&](const Sheet& sheet) { return crosses(probe, c.centre, sheet); }))
        return c.cell;
    return candidates.front().cell;
  }
  return -1;
}

void CutLattice::embed(std::size_t first_new, const std::vector<std::int32_t>& touched, std::int32_t part) {
  lattice_.embedding.resize(rest_->vertices.size());
  const std::set<std::int32_t> blocks(touched.begin(), touched.end());
  for (std::size_t v = 0; v < rest_->vertices.size(); ++v) {
    Embedding& e = lattice_.embedding[v];
    if (v < first_new) {
      const LatticeCell& of = lattice_.cells[static_cast<std::size_t>(e.cell)];
      if (!blocks.contains(block_of_.at({of.place, of.part}))) continue;
    }
    const std::int32_t cell = cell_for(probe_[v][0], part), other = cell_for(probe_[v][1], part);
    if (cell < 0) continue;
    e.cell = cell;
    const auto& place = lattice_.cells[static_cast<std::size_t>(cell)].place;
    e.other =
        other >= 0 && other != cell && lattice_.cells[static_cast<std::size_t>(other)].place == place ? other : -1;
    const Vec3 local = ((rest_->vertices[v] - lattice_.origin_m) / lattice_.cell_m - Vec3(place[0], place[1], place[2]))
                           .cwiseMax(0)
                           .cwiseMin(1);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      double weight = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = local[static_cast<Eigen::Index>(axis)];
        weight *= (corner >> axis & 1) != 0 ? x : 1 - x;
      }
      e.weights[corner] = static_cast<float>(weight);
    }
  }
}

bool CutLattice::holds(const Vec3& place, std::int32_t part) const {
  const Vec3 at = (place - lattice_.origin_m) / lattice_.cell_m;
  const Vec3 cell = at.array().floor();
  const Block* block = block_at(place_of(place, part));
  if (block == nullptr) return false;
  const Vec3 cube = ((at - cell) * kCubes).array().floor().cwiseMin(kCubes - 1);
  return (block->inside & bit(static_cast<int>(cube.dot(Vec3(kStride[0], kStride[1], kStride[2]))))) != 0;
}

bool CutLattice::cut(const SurfaceCut& cut, LatticeChange& change) {
  Groove groove = cut_groove(*rest_, cut);
  const auto at = [&](std::int32_t vertex) { return groove.surface.vertices[static_cast<std::size_t>(vertex)]; };
  std::vector<Sheet> sheets;
  const std::size_t last = cut.crossings.size() - 1;
  // The line on the surface, undivided, and below it the bottom; the sheet stands a little out of the surface.
  std::vector<Vec3> line{at(groove.bottom.front())}, bottom = line;
  for (const CutCrossing& crossing : cut.crossings) {
    const Vec3 left = rest_->vertices[static_cast<std::size_t>(crossing.left)];
    const Vec3 right = rest_->vertices[static_cast<std::size_t>(crossing.right)];
    line.push_back(left + crossing.share * (right - left));
    bottom.push_back(line.back() + crossing.depth_m);
  }
  line.push_back(at(groove.bottom.back()));
  bottom.push_back(line.back());
  Vec3 inward = Vec3::Zero();
  for (const CutCrossing& crossing : cut.crossings) inward += crossing.depth_m;
  inward.normalize();
  const double above = kAboveSurface * lattice_.cell_m / kCubes;
  // The sheet leaves out points that lie on it anyway.
  for (std::size_t from = 0, to = 1; to < line.size(); ++to) {
    const bool straight = to + 1 < line.size() && [&] {
      for (std::size_t i = from + 1; i <= to; ++i)
        if (off_way(line[i], line[from], line[to + 1]) > kStraight ||
            off_way(bottom[i], bottom[from], bottom[to + 1]) > kStraight)
          return false;
      return true;
    }();
    if (straight) continue;
    const Vec3 a = line[from] - above * inward, b = line[to] - above * inward;
    sheets.push_back({a, b, bottom[to]});
    sheets.push_back({a, bottom[to], bottom[from]});
    from = to;
  }

  CutLattice next = *this;
  const std::int32_t part = part_of(cut.crossings.front().left);
  std::vector<std::int32_t> touched = next.sever(sheets, part);
  for (const std::int32_t block : std::vector<std::int32_t>(touched)) next.sever_rest(block, touched);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  LatticeChange made;
  for (const std::int32_t block : touched) next.split(block, made);
  next.share_nodes(touched, made);
  if (next.components() != pieces_) return false;

  auto snapshot = std::make_shared<SurfaceSnapshot>();
  static_cast<TriangleSurface&>(*snapshot) = std::move(groove.surface);
  snapshot->topology = rest_->topology + 1;
  snapshot->inside = rest_->inside;
  snapshot->part = rest_->part;
  if (!snapshot->part.empty()) snapshot->part.resize(snapshot->triangles.size(), static_cast<std::uint8_t>(part));
  snapshot->inside.resize(snapshot->triangles.size(), false);
  for (const std::int32_t wall : groove.walls) snapshot->inside[static_cast<std::size_t>(wall)] = true;
  // Where each new vertex looks for its side: a little off the sheet, and into the tissue.
  for (std::size_t i = 0; i < groove.side.size(); ++i) {
    const std::size_t v = rest_->vertices.size() + i;
    const Vec3 place = snapshot->vertices[v] + kBeside * inward;
    // The order is begin, the crossings' three each, end.
    const std::size_t crossing = std::min(last, i == 0 ? 0 : (i - 1) / 3);
    const CutCrossing& over = cut.crossings[crossing];
    Vec3 aside = kBeside * (line[crossing + 2] - line[crossing]).cross(inward).normalized();
    if (aside.dot(rest_->vertices[static_cast<std::size_t>(over.right)] -
                  rest_->vertices[static_cast<std::size_t>(over.left)]) < 0)
      aside = -aside;
    const auto side = static_cast<int>(groove.side[i]);
    if (side == 0)
      next.probe_.push_back({place - aside, place + aside});
    else
      next.probe_.push_back({place + side * aside, place + side * aside});
  }
  next.before_.push_back(rest_);
  if (next.before_.size() > kRemembered) next.before_.erase(next.before_.begin());
  next.rest_ = std::move(snapshot);
  next.embed(rest_->vertices.size(), touched, part);
  made.added = std::move(groove.added);
  change = std::move(made);
  *this = std::move(next);
  return true;
}

namespace {

template <typename Value>
void put_value_of_cut(std::string& bytes, const Value& value) {
  static_assert(std::endian::native == std::endian::little, "the bytes are written as memory holds them");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <typename Value>
Value take_value_of_cut(std::string_view& bytes) {
  Value value;
  if (bytes.size() < sizeof value) throw InputError("a cut ends too early");
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

}  // namespace

std::string cut_bytes(const SurfaceCut& cut) {
  std::string out;
  for (const MaterialPoint& p : {cut.begin, cut.end}) {
    put_value_of_cut(out, p.triangle);
    for (const double weight : p.weight) put_value_of_cut(out, weight);
  }
  for (const CutCrossing& c : cut.crossings) {
    for (const std::int32_t number : {c.left, c.right, c.triangle}) put_value_of_cut(out, number);
    for (const double value : {c.share, c.depth_m.x(), c.depth_m.y(), c.depth_m.z(), c.gape_m})
      put_value_of_cut(out, value);
  }
  return out;
}

SurfaceCut parse_cut(std::string_view bytes) {
  SurfaceCut cut;
  for (MaterialPoint* p : {&cut.begin, &cut.end}) {
    p->triangle = take_value_of_cut<std::int32_t>(bytes);
    for (double& weight : p->weight) weight = take_value_of_cut<double>(bytes);
  }
  while (!bytes.empty()) {
    CutCrossing& c = cut.crossings.emplace_back();
    for (std::int32_t* number : {&c.left, &c.right, &c.triangle}) *number = take_value_of_cut<std::int32_t>(bytes);
    for (double* value : {&c.share, &c.depth_m.x(), &c.depth_m.y(), &c.depth_m.z(), &c.gape_m})
      *value = take_value_of_cut<double>(bytes);
  }
  return cut;
}

}  // namespace trocar
