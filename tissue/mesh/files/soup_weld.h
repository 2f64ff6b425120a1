// Triangles as files store them, made into one indexed surface: near vertices merged, repeated triangles dropped.
//
// A vertex joins the first one before it that lies within the tolerance; cells of a grid only find candidates, so no
// crack opens at a border of cells. Thread: any. Deterministic; time grows with the number of vertices whatever their
// places are.
#pragma once

#include <cstddef>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct WeldFacts {
  std::size_t vertices_before = 0;  ///< used by a triangle
  std::size_t vertices_after = 0;
  std::size_t collapsed = 0;  ///< triangles of which two corners became one
  std::size_t repeated = 0;   ///< further copies of a triangle, with the same winding
  std::size_t opposed =
      0;  ///< triangles that met a copy of theirs with the other winding: walls within, both sides dropped
  bool double_sided = false;  ///< so many met one that every triangle was stored twice: one side of each was kept
};

/// @param tolerance_m above 0
TriangleSurface weld_soup(const TriangleSurface& soup, double tolerance_m, WeldFacts& facts);

}  // namespace trocar
