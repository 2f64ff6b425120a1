// Remeshing to given edge lengths: triangles of good shape whose size follows a size field on the source surface.
//
// Rounds of split, collapse, flip and tangential relaxation, projected onto the source (Botsch and Kobbelt 2004; with
// sizes that vary, Dunyach et al. 2013). CGAL's own isotropic_remeshing (5.5) knows one size only. Thread: any, not the
// tick. Deterministic.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

struct RemeshOptions {
  int triangles = 0;  ///< wanted; the sizes are scaled between rounds until the count is met within a per cent or two
  int rounds = 8;
  Progress progress = {};
};

/// @param surface closed manifold, m; several components are allowed
/// @param sizes_m wanted edge length at each of its vertices
/// @throws std::invalid_argument when the input is not a manifold
TriangleSurface remeshed(const TriangleSurface& surface, const std::vector<double>& sizes_m,
                         const RemeshOptions& options);

}  // namespace trocar
