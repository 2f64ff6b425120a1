#include "tissue/interaction/blood_drops.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kFinestCell = 0.006;    // m
constexpr int kMostCellsAlong = 64;      // along an axis
constexpr int kGridLasts = 5;            // steps
constexpr double kLongestFlight = 2;     // s: it has left the scene, into the pool
constexpr double kFurthestPart = 0.004;  // m that a drop flies between two looks

}  // namespace

bool BloodDrops::launch(const BloodDrop& drop) {
  if (drops_.size() >= kMost || !drop.place_T.allFinite() || !drop.velocity_T.allFinite()) return false;
  drops_.push_back(drop);
  return true;
}

void BloodDrops::reset() {
  drops_.clear();
  until_filled_ = 0;
}

double BloodDrops::volume_m3() const {
  double sum = 0;
  for (const BloodDrop& drop : drops_) sum += drop.volume_m3;
  return sum;
}

std::size_t BloodDrops::cell_of(const Vec3& place_T) const {
  Eigen::Vector3i at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = std::clamp(static_cast<int>(std::floor((place_T[axis] - low_T_[axis]) / cell_m_)), 0, size_[axis] - 1);
  return static_cast<std::size_t>((at.z() * size_.y() + at.y()) * size_.x() + at.x());
}

void BloodDrops::fill_grid(std::span<const Vec3> vertices_T) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : vertices_T)
    if (vertex.allFinite()) box.extend(vertex);
  if (box.isEmpty()) box.extend(Vec3::Zero());
  low_T_ = box.min();
  cell_m_ = std::max(kFinestCell, box.sizes().maxCoeff() / kMostCellsAlong);
  for (int axis = 0; axis < 3; ++axis)
    size_[axis] = std::min(kMostCellsAlong, static_cast<int>(box.sizes()[axis] / cell_m_)) + 1;
  begin_.assign(static_cast<std::size_t>(size_.prod()) + 1, 0);
  std::vector<std::int32_t> cell(vertices_T.size(), -1);
  for (std::size_t v = 0; v < vertices_T.size(); ++v) {
    if (!vertices_T[v].allFinite()) continue;
    cell[v] = static_cast<std::int32_t>(cell_of(vertices_T[v]));
    ++begin_[static_cast<std::size_t>(cell[v]) + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  vertices_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t v = 0; v < vertices_T.size(); ++v)
    if (cell[v] >= 0)
      vertices_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[v])]++)] = static_cast<std::int32_t>(v);
}

std::int32_t BloodDrops::reached(const Vec3& place_T, std::span<const Vec3> vertices_T, const SurfaceFilm& film) const {
  std::int32_t nearest = -1;
  double least = cell_m_;
  Eigen::Vector3i low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = (place_T[axis] - low_T_[axis]) / cell_m_;
    if (at < -1 || at > size_[axis] + 1) return -1;
    low[axis] = std::max(0, static_cast<int>(std::floor(at)) - 1);
    high[axis] = std::min(size_[axis] - 1, static_cast<int>(std::floor(at)) + 1);
  }
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const auto c = static_cast<std::size_t>((z * size_.y() + y) * size_.x() + x);
        for (std::int32_t i = begin_[c]; i < begin_[c + 1]; ++i) {
          const std::int32_t v = vertices_[static_cast<std::size_t>(i)];
          const double distance = (vertices_T[static_cast<std::size_t>(v)] - place_T).norm();
          if (distance < least) least = distance, nearest = v;
        }
      }
  if (nearest < 0) return -1;
  const Vec3 outward = film.area_vector(nearest, vertices_T);
  return (place_T - vertices_T[static_cast<std::size_t>(nearest)]).dot(outward) < 0 ? nearest : -1;
}

bool BloodDrops::fly(BloodDrop& drop, std::span<const Vec3> vertices_T, double step_s, SurfaceFilm& film) const {
  drop.age_s += step_s;
  const double way = drop.velocity_T.norm() * step_s;
  const int parts = std::clamp(static_cast<int>(std::ceil(way / kFurthestPart)), 1, 16);
  const double part_s = step_s / parts;
  for (int part = 0; part < parts; ++part) {
    drop.place_T += part_s * drop.velocity_T;
    drop.place_T.z() -= kGravity * part_s * part_s / 2;
    drop.velocity_T.z() -= kGravity * part_s;
    const std::int32_t vertex = reached(drop.place_T, vertices_T, film);
    if (vertex >= 0 && film.add_blood(vertex, drop.volume_m3) > 0) return true;
    if (drop.place_T.z() < film.pool_level_m()) {
      film.add_to_pool({drop.volume_m3, 0});
      return true;
    }
  }
  if (drop.age_s < kLongestFlight) return false;
  film.add_to_pool({drop.volume_m3, 0});
  return true;
}

void BloodDrops::step(std::span<const Vec3> vertices_T, double step_s, SurfaceFilm& film) {
  if (drops_.empty()) {
    until_filled_ = 0;
    return;
  }
  if (until_filled_-- <= 0) {
    fill_grid(vertices_T);
    until_filled_ = kGridLasts;
  }
  std::size_t kept = 0;
  for (BloodDrop drop : drops_)
    if (!fly(drop, vertices_T, step_s, film)) drops_[kept++] = drop;
  drops_.resize(kept);
}

}  // namespace trocar
