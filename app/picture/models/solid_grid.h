// Solid voxels of a closed surface, blurred: how much of the space round a point is filled.
//
// Crossings along z per column, filled by parity. Frame and unit of the surface (T, m). Thread: any.
#pragma once

#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

class SolidGrid {
 public:
  explicit SolidGrid(const TriangleSurface& surface);
  /// Of a surface that has moved, on the lattice of its grid at rest as long as it fits: what stays in place stays as
  /// it is.
  SolidGrid(const TriangleSurface& surface, const SolidGrid& rest);
  double cell() const { return cell_; }  ///< m
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  /// Share of solid around a point, trilinear, 0 outside the grid.
  double density(const Vec3& point) const;

 private:
  void voxelise(const TriangleSurface& surface);
  void add_crossings(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<std::vector<double>>& crossings) const;
  void fill(std::vector<std::vector<double>>& crossings);
  void blur(int axis);
  double cell_ = 0;
  Vec3 origin_ = Vec3::Zero();
  Eigen::AlignedBox3d bounds_;
  std::vector<float> solid_;
};

}  // namespace trocar
