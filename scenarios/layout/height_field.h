// A closed surface seen from above: for every vertical line the topmost hit, its height and its normal.
//
// Triangles are binned into square columns, so that one query looks at a handful of them. Frame: the surface's own,
// z up, metres. Thread: immutable after construction.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfacePoint {
  Vec3 position = Vec3::Zero();  ///< m
  Vec3 normal = Vec3::UnitZ();   ///< unit, interpolated from the vertices
  double slope_rad = 0;          ///< between the triangle's own normal and +z
};

class HeightField {
 public:
  /// @param surface must outlive the field. @param column_m edge of a column.
  explicit HeightField(const TriangleSurface& surface, double column_m = 0.004);
  /// Topmost point on the vertical line through (x, y); empty when the line misses the surface.
  std::optional<SurfacePoint> top(double x, double y) const;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  std::size_t column(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(columns_x_) + static_cast<std::size_t>(ix);
  }
  int index_x(double x) const;
  int index_y(double y) const;

  const TriangleSurface& surface_;
  std::vector<Vec3> normals_;
  Eigen::AlignedBox3d bounds_;
  double column_m_;
  int columns_x_ = 0, columns_y_ = 0;
  std::vector<std::int32_t> first_;  ///< per column, into triangles_ (one more than columns)
  std::vector<std::int32_t> triangles_;
};

}  // namespace trocar
