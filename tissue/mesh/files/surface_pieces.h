// The pieces of a closed surface, its components: parts of the organ, cavities in it, and what is left out.
//
// A piece within another one that its file wound the other way round bounds a cavity; wound the same way it encloses
// nothing more. Metres. Thread: any. Deterministic.
#pragma once

#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfacePieces {
  TriangleSurface kept;                   ///< the parts that are kept, in the order of the source; cavities are filled
  std::size_t count = 0;                  ///< of all pieces
  std::size_t parts = 0;                  ///< of those, kept
  std::vector<TriangleSurface> cavities;  ///< what each encloses, outward, largest first
  std::vector<double> lost_m3;            ///< volumes of parts that are left out, largest first
  std::size_t within = 0;                 ///< left out because they enclose nothing more
};

/// Signed volume of each piece, by its first triangle, m^3.
std::vector<double> piece_volumes_m3(const TriangleSurface& surface);

/// @param surface closed, manifold, every piece outward
/// @param stored_m3 piece_volumes_m3 as the file wound it
/// @param least_share of the largest part's volume, from which others are kept; above 1 the largest alone is
SurfacePieces sorted_pieces(const TriangleSurface& surface, const std::vector<double>& stored_m3, double least_share);

/// A point just within each piece of a closed, outward surface: behind the middle of its largest triangle.
std::vector<Vec3> points_within(const TriangleSurface& surface);

}  // namespace trocar
