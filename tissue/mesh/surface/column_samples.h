// Which points of a regular grid lie inside a closed surface: crossings of columns along z, counted with their sign.
//
// A point is inside where the crossings above it sum to one and more turns. Columns are shifted by a tiny irrational
// share of a step, so that none runs through a vertex or an edge of a surface on round numbers. Thread: any.
#pragma once

#include <functional>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Calls inside(i, j, k) for every sample first + step * (i, j, k) inside, by j, then i, then k.
void for_inside_samples(const TriangleSurface& surface, const Vec3& first, double step,
                        const std::array<int, 3>& samples, const std::function<void(int, int, int)>& inside);

}  // namespace trocar
