// The border faces of the regions of a tetrahedral mesh, and giving every region its volume by moving them.
//
// Facets are chords of what they follow, so a mesh is a few per cent small. A border node moves with the smallest of
// the regions that meet there: what two organs share stays shared, and the larger one makes up elsewhere. Any length
// unit. Deterministic. Thread: any.
#pragma once

#include "tissue/solid/tetrahedra.h"

namespace trocar {

struct BorderFace {
  std::array<std::int32_t, 3> nodes{};  ///< counter-clockwise seen from outside the inner region
  std::int32_t inner = 0, outer = 0;    ///< labels; outer 0: nothing, else greater than inner
};

/// Faces of one tetrahedron only, and faces between two regions, each once.
std::vector<BorderFace> border_faces(const TetrahedraMesh& mesh);

/// Volume of region 1, 2, ... @param regions how many
std::vector<double> region_volumes(const TetrahedraMesh& mesh, std::size_t regions);

/// Moves the border nodes along the normals of the region that they move with, but for those whose tetrahedra would be
/// squeezed to less than a third.
/// @param targets volume of region 1, 2, ... @param reach furthest that a region's nodes go in one of the four steps
void correct_volumes(TetrahedraMesh& mesh, const std::vector<BorderFace>& border, const std::vector<double>& targets,
                     const std::vector<double>& reach);

}  // namespace trocar
