// The surface on which a sampled scalar field takes one value, by marching tetrahedra.
//
// Every cube of eight samples is cut into the six tetrahedra of Kuhn's subdivision, which agree on shared faces, so the
// result is a closed manifold without self-intersections for any data that is below the level on the border of the
// grid. Frame: sample (i, j, k) lies at spacing * (i, j, k); metres. Thread: any.
#pragma once

#include <array>

#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Kuhn's six positively oriented tetrahedra of a cube whose corners are numbered by bits: 1 = +i, 2 = +j, 4 = +k.
inline constexpr std::array<std::array<int, 4>, 6> kKuhnTetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 1, 7, 5}, {0, 2, 7, 3}, {0, 4, 7, 6}}};

/// @param spacing_m distance of samples along each axis, all > 0
/// @return surface round the samples above `level`, outward; empty when there are none
/// @throws std::invalid_argument when a border sample lies above the level
TriangleSurface isosurface(const ScalarField& field, const Vec3& spacing_m, double level);

/// Volume that `isosurface` encloses, without making it, m^3.
double enclosed_volume_m3(const ScalarField& field, const Vec3& spacing_m, double level);

}  // namespace trocar
