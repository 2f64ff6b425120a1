// Drops of blood in the air: what an artery spurts, until it lands on the surface or in the pool.
//
// Ballistic, without drag: x' = v, v' = g. A drop has landed where it is behind the nearest vertex' tangent plane, no
// farther from that vertex than its share of the surface reaches. Vertices are found in a uniform grid, filled anew
// every few steps while drops are in the air. At most kMost at a time. Frame T, m, s. Thread: tissue task.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissue/interaction/surface_film.h"

namespace trocar {

struct BloodDrop {
  Vec3 place_T = Vec3::Zero(), velocity_T = Vec3::Zero();
  double volume_m3 = 0, age_s = 0;
};

class BloodDrops {
 public:
  static constexpr std::size_t kMost = 64;

  /// @returns whether there was room for it
  bool launch(const BloodDrop& drop);
  /// Moves them and puts onto the film what lands.
  void step(std::span<const Vec3> vertices_T, double step_s, SurfaceFilm& film);
  void reset();

  std::span<const BloodDrop> drops() const { return drops_; }
  double volume_m3() const;

 private:
  void fill_grid(std::span<const Vec3> vertices_T);
  std::size_t cell_of(const Vec3& place_T) const;
  /// @returns the vertex that a drop has reached, or -1
  std::int32_t reached(const Vec3& place_T, std::span<const Vec3> vertices_T, const SurfaceFilm& film) const;
  /// @returns whether it has landed
  bool fly(BloodDrop& drop, std::span<const Vec3> vertices_T, double step_s, SurfaceFilm& film) const;

  std::vector<BloodDrop> drops_;
  Vec3 low_T_ = Vec3::Zero();
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  double cell_m_ = 0;
  std::vector<std::int32_t> begin_, vertices_;
  int until_filled_ = 0;
};

}  // namespace trocar
