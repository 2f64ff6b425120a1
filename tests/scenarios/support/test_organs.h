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
/// The upper side of a plate, level at a height, with a vertex every 2 mm; its middle at x = y = 0.
TriangleSurface plate(double edge, double top_m);
/// Axis-aligned box.
TriangleSurface box(const Vec3& size);

}  // namespace trocar
