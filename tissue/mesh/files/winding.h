// Triangles of closed surfaces turned so that neighbours agree and each piece encloses a positive volume.
//
// Thread: any. Deterministic.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// @param surface every edge has exactly two triangles
/// @param turned how many were turned over
/// @return false when a piece has one side only (a Klein bottle); the surface is then left half-way
bool wind_outward(TriangleSurface& surface, std::size_t& turned);

/// Whether the point lies within the closed, outward surface (sum of solid angles).
bool encloses(const TriangleSurface& surface, const Vec3& point);

}  // namespace trocar
