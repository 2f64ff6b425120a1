// Pulls a coarse mesh onto a dense surface, so that its triangles, not only its vertices, lie close to it.
//
// Dense samples project onto the coarse triangles, and the vertices share each one's residual by barycentric weights:
// the least-squares fit of Hoppe et al. 1993 ("Mesh optimization"), in Jacobi sweeps. Thread: any, not the tick.
// Deterministic.
#pragma once

#include "tissue/mesh/surface/cap_planes.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Vertices move along their normals only.
/// @param surface oriented manifold, m, open or closed; its triangles stay as they are
/// @param target dense surface of the same shape, m
/// @param sweeps 0 leaves the surface alone
TriangleSurface fitted(const TriangleSurface& surface, const TriangleSurface& target, int sweeps);

/// Vertices slide onto bends as well, and edges flip to lie along them. A vertex goes where the planes of the samples
/// round it meet (Garland and Heckbert 1997); no step makes an angle smaller than kLeastFittedAngleDeg, or smaller
/// still where it was.
/// @param surface closed, oriented manifold, m; keeps its number of vertices and triangles
/// @param target as above
/// @param caps of the surface's vertices: flat where the image ends
TriangleSurface closely_fitted(const TriangleSurface& surface, const TriangleSurface& target, const CapKeeper& caps,
                               int sweeps);

inline constexpr double kLeastFittedAngleDeg = 25;

}  // namespace trocar
