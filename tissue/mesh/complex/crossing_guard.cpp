#include "tissue/mesh/complex/crossing_guard.h"

#include <algorithm>
#include <cmath>

#include "tissue/mesh/complex/complex_mesh.h"

namespace trocar {
namespace {

constexpr double kCellsPerEdge = 0.5;
constexpr double kMostCells = 4e6;

std::size_t slot_of(std::int32_t index) { return static_cast<std::size_t>(index); }

NumberedTriangle numbered(const LabelComplex& complex, std::size_t t) {
  NumberedTriangle result{complex.triangles[t], {}};
  for (std::size_t n = 0; n < 3; ++n) result.points[n] = complex.vertices[slot_of(result.corners[n])];
  return result;
}

}  // namespace

CrossingGuard::CrossingGuard(const LabelComplex& complex) {
  Eigen::AlignedBox3d box;
  double edges = 0;
  for (const auto& [a, b, c] : complex.triangles) {
    for (const Index corner : {a, b, c}) box.extend(complex.vertices[slot_of(corner)]);
    edges += (complex.vertices[slot_of(a)] - complex.vertices[slot_of(b)]).norm();
  }
  low_ = box.min();
  cell_ = std::max(edges / static_cast<double>(complex.triangles.size()) / kCellsPerEdge,
                   std::cbrt(std::max(box.volume(), 1e-300) / kMostCells));
  for (std::size_t axis = 0; axis < 3; ++axis)
    size_[axis] = static_cast<int>(box.sizes()[static_cast<Eigen::Index>(axis)] / cell_) + 1;
  cells_.resize(slot_of(size_[0]) * slot_of(size_[1]) * slot_of(size_[2]));
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) set(static_cast<Index>(t), numbered(complex, t));
}

CrossingGuard::Range CrossingGuard::cells_of(const NumberedTriangle& t) const {
  const Vec3 low = t.points[0].cwiseMin(t.points[1]).cwiseMin(t.points[2]) - low_;
  const Vec3 high = t.points[0].cwiseMax(t.points[1]).cwiseMax(t.points[2]) - low_;
  Range range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<Eigen::Index>(axis);
    range[axis] = {std::clamp(static_cast<int>(std::floor(low[n] / cell_)), 0, size_[axis] - 1),
                   std::clamp(static_cast<int>(std::floor(high[n] / cell_)), 0, size_[axis] - 1)};
  }
  return range;
}

template <typename Visit>
void CrossingGuard::for_cells(const Range& range, Visit visit) const {
  for (int k = range[2][0]; k <= range[2][1]; ++k)
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i)
        visit(slot_of(i) + slot_of(size_[0]) * (slot_of(j) + slot_of(size_[1]) * slot_of(k)));
}

void CrossingGuard::set(Index t, const NumberedTriangle& triangle) {
  constexpr Range kNowhere{{{0, -1}, {0, -1}, {0, -1}}};
  if (slot_of(t) >= triangles_.size())
    triangles_.resize(slot_of(t) + 1), ranges_.resize(slot_of(t) + 1, kNowhere), seen_.resize(slot_of(t) + 1, 0);
  triangles_[slot_of(t)] = triangle;
  const Range range = cells_of(triangle);
  if (range == ranges_[slot_of(t)]) return;
  erase(t);
  ranges_[slot_of(t)] = range;
  for_cells(range, [&](std::size_t cell) { cells_[cell].push_back(t); });
}

void CrossingGuard::erase(Index t) {
  for_cells(ranges_[slot_of(t)], [&](std::size_t cell) {
    auto& here = cells_[cell];
    const auto found = std::find(here.begin(), here.end(), t);
    *found = here.back();
    here.pop_back();
  });
  ranges_[slot_of(t)] = {{{0, -1}, {0, -1}, {0, -1}}};
}

/// Of those that are not replaced.
bool CrossingGuard::clear_of_others(const NumberedTriangle& triangle) {
  const Vec3 low = triangle.points[0].cwiseMin(triangle.points[1]).cwiseMin(triangle.points[2]);
  const Vec3 high = triangle.points[0].cwiseMax(triangle.points[1]).cwiseMax(triangle.points[2]);
  const auto beside = [&](const NumberedTriangle& other) {
    const Vec3 &p = other.points[0], &q = other.points[1], &r = other.points[2];
    return (p.cwiseMin(q).cwiseMin(r).array() > high.array()).any() ||
           (p.cwiseMax(q).cwiseMax(r).array() < low.array()).any();
  };
  bool found = false;
  for_cells(cells_of(triangle), [&](std::size_t cell) {
    for (const Index t : cells_[cell])
      found = found || (seen_[slot_of(t)] != visit_ && !beside(triangles_[slot_of(t)]) &&
                        triangles_cross(triangle, triangles_[slot_of(t)]));
  });
  return !found;
}

bool CrossingGuard::clear(const std::vector<NumberedTriangle>& fresh, const std::vector<Index>& replaced) {
  ++visit_;
  for (const Index t : replaced) seen_[slot_of(t)] = visit_;
  for (const NumberedTriangle& triangle : fresh)
    if (!has_area(triangle) || !clear_of_others(triangle)) return false;
  for (std::size_t n = 0; n < fresh.size(); ++n)
    for (std::size_t m = n + 1; m < fresh.size(); ++m)
      if (triangles_cross(fresh[n], fresh[m])) return false;
  return true;
}

std::vector<CrossingGuard::Index> CrossingGuard::crossing() {
  std::vector<Index> found;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (!clear({triangles_[t]}, {static_cast<Index>(t)})) found.push_back(static_cast<Index>(t));
  return found;
}

double sharpest_cosine(const std::array<Vec3, 3>& points) {
  const Vec3 u = (points[1] - points[0]).normalized(), v = (points[2] - points[1]).normalized(),
             w = (points[0] - points[2]).normalized();
  return std::max({-u.dot(w), -u.dot(v), -v.dot(w)});
}

std::size_t move_without_crossing(LabelComplex& complex, const std::vector<Vec3>& wanted) {
  CrossingGuard guard(complex);
  const ComplexMesh mesh(complex);
  const auto move = [&](std::size_t v, const Vec3& wish) {
    const Vec3 place = as_float(wish);
    const auto& fan = mesh.fan(static_cast<std::int32_t>(v));
    std::vector<NumberedTriangle> fresh;
    double before = 0, after = 0;
    for (const auto t : fan) {
      fresh.push_back(numbered(complex, slot_of(t)));
      before = std::max(before, sharpest_cosine(fresh.back().points));
      for (std::size_t n = 0; n < 3; ++n)
        if (fresh.back().corners[n] == static_cast<std::int32_t>(v)) fresh.back().points[n] = place;
      after = std::max(after, sharpest_cosine(fresh.back().points));
    }
    if (after > std::max(before, kThinCosine)) return false;
    if (!guard.clear(fresh, fan)) return false;
    complex.vertices[v] = place;
    for (std::size_t n = 0; n < fan.size(); ++n) guard.set(fan[n], fresh[n]);
    return true;
  };
  std::vector<std::size_t> left;
  for (std::size_t v = 0; v < wanted.size(); ++v)
    if (wanted[v] != complex.vertices[v] && !move(v, wanted[v])) left.push_back(v);
  std::erase_if(left, [&](std::size_t v) { return move(v, wanted[v]); });
  for (const std::size_t v : left) move(v, (complex.vertices[v] + wanted[v]) / 2);
  return left.size();
}

}  // namespace trocar
