// Which of several closed surfaces holds a place: the regions that tetrahedra are made of.
//
// Crossings of the vertical line through the place with the triangles above it, counted with their sign (as
// column_samples.h); the triangles lie in columns over a grid in the plane. An edge belongs to one of its two triangles
// by the order of its ends, so no line slips through between them. Any length unit. Built once; queries do not change
// it. Thread: any.
#pragma once

#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

class OrganRegions {
 public:
  /// @param surfaces closed, outward, not empty; copied. Where they overlap, the one of the smaller volume holds the
  /// place: a vessel inside an organ stays a vessel.
  explicit OrganRegions(const std::vector<const TriangleSurface*>& surfaces);

  /// @return number of the surface in their order, from 1; 0 outside
  int at(const Vec3& place) const;

  /// Volume of the region of surface 1, 2, ...: its own less what smaller ones take of it, which is sampled.
  std::vector<double> volumes() const;

 private:
  struct Columns {
    int number = 0;
    double volume = 0;
    Eigen::AlignedBox3d box;
    double edge = 1;                             ///< of a column
    int wide = 0;                                ///< columns along x
    std::vector<std::array<Vec3, 3>> triangles;  ///< the highest first
    std::vector<std::uint32_t> first, listed;    ///< column c lists triangles listed[first[c]] to listed[first[c + 1]]
    bool holds(const Vec3& place) const;
  };
  static Columns columns_of(const TriangleSurface& surface);
  double taken(std::size_t smaller, std::size_t larger) const;

  std::vector<Columns> organs_;  ///< smallest volume first
};

}  // namespace trocar
