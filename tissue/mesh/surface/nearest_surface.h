// The nearest point of a fixed set of triangles: exact, whatever the guess.
//
// A tree of boxes, four to a node, over the triangles in the order of Morton's curve (Morton 1966; as in Lauterbach et
// al. 2009, "Fast BVH construction on GPUs"). Boxes are floats, widened by more than their rounding, so none that holds
// the answer is passed over; triangles are measured in double. CGAL's AABB_tree gives the same distances, but with it
// distances and fit took two to five times as long (docs/organ_meshing.md). Any length unit. Built once; queries do not
// change it. Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

class NearestSurface {
 public:
  /// @param surface any triangles, at least one, finite; copied
  explicit NearestSurface(const TriangleSurface& surface);

  struct Hit {
    Vec3 place = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< of the triangle, twice its area long
    std::size_t triangle = 0;
  };
  /// @param guess a triangle that is likely near: the answer for a neighbouring point
  Hit nearest(const Vec3& point, std::size_t guess = 0) const;

 private:
  using Lanes = Eigen::Array4f;
  using Corners = std::array<Vec3, 3>;
  struct Node {
    std::array<Lanes, 3> low, high;  ///< by axis: the boxes of four children; no child: low above high
  };
  struct Best;
  struct Visit;

  void sort_along_curve(const TriangleSurface& surface);
  void build_levels();
  void set_box(Node& node, Eigen::Index lane, const Vec3& low, const Vec3& high) const;
  void try_triangle(std::size_t slot, const Vec3& point, Best& best) const;

  Vec3 centre_ = Vec3::Zero();  ///< what the floats count from
  double margin_ = 0;
  std::vector<Corners> corners_;           ///< in the order of the curve
  std::vector<std::uint32_t> triangle_;    ///< of the surface, by slot
  std::vector<std::uint32_t> slot_;        ///< by triangle of the surface
  std::vector<std::vector<Node>> levels_;  ///< from the triangles up; child c of node n is 4 n + c of the level below
};

}  // namespace trocar
