// A cut into a surface: it is opened along a line across its triangles, and a groove with two walls and a bottom is set
// in. A closed surface stays closed, manifold and of the same genus, whatever is cut into what.
//
//   begin o----x----x----x----o end     crossings x on edges; between them the line runs straight through a triangle
//
// Left and right are those of someone who stands outside on the surface and looks along the line. A crossing becomes
// three vertices: the left lip, the right lip, the bottom. Vertices and triangles that were there keep their numbers (a
// triangle that is divided keeps it for one of its pieces), new ones follow, in an order that only the cut decides.
// Place: undeformed, m. Thread: pure functions, any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "tissue/mesh/surface/surface_growth.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Where a cut's line leaves a triangle over one of its edges.
struct CutCrossing {
  std::int32_t left = 0, right = 0;  ///< ends of the edge
  double share = 0;                  ///< of the way from left to right, within (0, 1)
  std::int32_t triangle = 0;         ///< into which the line goes on
  Vec3 depth_m = Vec3::Zero();       ///< from the surface to the groove's bottom
  double gape_m = 0;                 ///< between the lips, undeformed

  bool operator==(const CutCrossing&) const = default;
};

/// A cut in terms of the surface that it is made into.
struct SurfaceCut {
  MaterialPoint begin, end;  ///< inside the first and the last triangle, where the groove runs out
  std::vector<CutCrossing> crossings;
};

enum class CutSide : std::int8_t { kLeft = -1, kBoth = 0, kRight = 1 };

struct Groove {
  TriangleSurface surface;
  std::vector<VertexOrigin> added;  ///< of each new vertex, from vertices of the surface before or of earlier entries
  std::vector<CutSide> side;        ///< of each new vertex
  std::vector<std::int32_t> walls;  ///< triangles of the groove's inside
  /// Of the vertices on the line, in its order: begin, the crossings' bottoms, end.
  std::vector<std::int32_t> bottom;
};

/// @throws InputError: a cut that does not fit the surface: no crossing, an index out of range, an edge that is not
/// between two triangles of the line, a share outside (0, 1), a triangle twice.
Groove cut_groove(const TriangleSurface& surface, const SurfaceCut& cut);

}  // namespace trocar
