// Tetrahedra as files store them: one sense of rotation, and the outer surface.
//
// Thread: any. Deterministic.
#pragma once

#include <optional>

#include "tissue/mesh/files/surface_file.h"

namespace trocar {

/// Swaps two corners of those with (b-a) x (c-a) . (d-a) < 0. @return how many
std::size_t make_positive(FileTetrahedra& mesh);

/// The faces that belong to one tetrahedron only, outward, in the order of the tetrahedra. Vertices are shared with the
/// mesh.
/// @param region those of one region only; empty for all
/// @param mesh with positive tetrahedra and at most kMaxTriangles of them
TriangleSurface outer_surface(const FileTetrahedra& mesh, std::optional<std::int32_t> region = std::nullopt);

}  // namespace trocar
