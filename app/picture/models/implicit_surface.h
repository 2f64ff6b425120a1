// A triangle surface where a function passes zero: naive surface nets (Gibson 1998; one vertex a cell that the surface
// crosses, at the mean of the crossings on its edges). Always closed: what reaches the box's border is cut off there.
//
// Function negative inside; m. Thread: any.
#pragma once

#include <functional>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

using Distance = std::function<double(const Vec3&)>;

/// @param cell_m edge of the sampling grid.
TriangleSurface implicit_surface(const Distance& distance, const Eigen::AlignedBox3d& box, double cell_m);

/// First point on the ray where the function falls below a tenth of a millimetre; `reach_m` along it when there is
/// none.
/// @param direction unit. The function must not overstate distances by more than twice.
Vec3 first_hit(const Distance& distance, const Vec3& origin, const Vec3& direction, double reach_m);

/// Outward unit normal by central differences.
Vec3 slope_of(const Distance& distance, const Vec3& at);

}  // namespace trocar
