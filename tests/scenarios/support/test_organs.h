// Closed surfaces for tests, RAS axes, metres.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Ellipsoid with gentle bumps, `rings` x 2 `rings` quads; half axes along x, y, z.
TriangleSurface bumpy_ellipsoid(const Vec3& half_axes, int rings, double bump_m);
/// About the size of a liver's front, 6000 triangles.
TriangleSurface liver_like();
/// About the size of a gallbladder.
TriangleSurface gallbladder_like();
/// Axis-aligned box.
TriangleSurface box(const Vec3& size);

}  // namespace trocar
