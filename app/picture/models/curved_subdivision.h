// A surface refined for the picture: every triangle into four, the new vertices on a curve between the old ones.
//
//   Phong tessellation (Boubekeur and Alexa 2008): m = (a + b)/2,  m' = m + k ((P_a(m) + P_b(m))/2 - m),
//   P_i(m): m dropped onto the plane through vertex i along its normal; k = 0.55.
//
// Between two vertices that are called straight k is 0: there two sheets with different normals may meet without a gap.
// Triangles are made once; vertices are computed anew wherever the surface's own have moved to, in time linear in them.
// The collision surface is untouched. Frame and unit of the surface (T, m). Thread: plain value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

class CurvedSubdivision {
 public:
  /// Refines while the result has at most `max_triangles`. Closed stays closed; a surface inside out is turned.
  /// @param straight of its vertices; empty: none is.
  CurvedSubdivision(const TriangleSurface& surface, std::size_t max_triangles, std::vector<bool> straight = {});

  /// The finest surface. Its first vertices are the surface's own.
  const TriangleSurface& fine() const { return stages_.back().surface; }

  /// Takes the surface's vertices to where they are now. @throws std::invalid_argument when it had another number.
  const TriangleSurface& move(const std::vector<Vec3>& vertices);

  /// Numbers at the surface's vertices, at those of fine(): between two the mean. @throws as move().
  std::vector<float> spread(const std::vector<float>& values) const;

 private:
  struct Stage {
    TriangleSurface surface;
    std::vector<std::array<std::int32_t, 2>> edges;  ///< its last vertices lie on these of the stage before, in order
    std::vector<bool> straight;                      ///< of its vertices; empty: none is
  };
  static Stage split(const Stage& stage);
  void place_midpoints(std::size_t stage);

  std::vector<Stage> stages_;
};

}  // namespace trocar
