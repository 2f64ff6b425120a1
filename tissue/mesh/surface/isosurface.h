// The surface on which a sampled scalar field takes one value, by marching tetrahedra.
//
// Every cube of eight samples is cut into the six tetrahedra of Kuhn's subdivision, which agree on shared faces, so the
// result is a closed manifold without self-intersections for any data that is below the level on the border of the
// grid. Frame: sample (i, j, k) lies at spacing * (i, j, k); metres. Thread: any.
#pragma once

#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// @param spacing_m distance of samples along each axis, all > 0
/// @return surface round the samples above `level`, outward; empty when there are none
/// @throws std::invalid_argument when a border sample lies above the level
TriangleSurface isosurface(const ScalarField& field, const Vec3& spacing_m, double level);

/// Volume that `isosurface` encloses, without making it, m^3.
double enclosed_volume_m3(const ScalarField& field, const Vec3& spacing_m, double level);

}  // namespace trocar
