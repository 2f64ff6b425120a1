// Pulls a coarse mesh onto a dense surface, so that its triangles, not only its vertices, lie close to it.
//
// Each vertex moves along its normal by the weighted mean of the residuals of the dense samples that project onto its
// triangles (barycentric weights): a Jacobi sweep of the least-squares fit of Hoppe et al. 1993. Thread: any, not the
// tick.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// @param surface oriented manifold, m; its triangles stay as they are
/// @param target dense surface of the same shape, m
/// @param sweeps 0 leaves the surface alone
TriangleSurface fitted(const TriangleSurface& surface, const TriangleSurface& target, int sweeps);

}  // namespace trocar
