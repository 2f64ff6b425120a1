// Isotropic remeshing (Botsch and Kobbelt 2004, through CGAL's Polygon_mesh_processing): triangles of nearly one size.
//
// Thread: any, not the tick. Deterministic.
#pragma once

#include "tissue/mesh/triangle_surface.h"

namespace trocar {

/// @param surface closed manifold, m
/// @param edge_m wanted edge length, m
/// @param iterations rounds of split, collapse, flip, relax, each projected onto the input surface
/// @throws std::invalid_argument when the input is not a manifold
TriangleSurface remeshed(const TriangleSurface& surface, double edge_m, int iterations);

}  // namespace trocar
