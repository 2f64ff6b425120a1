// Geometric checks of triangle surfaces through CGAL: self-intersections, orientation, distance of two surfaces.
//
// Thread: any, not the tick. Deterministic.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Pairs of triangles that cut each other although they share no edge, or overlap although they do (exact predicates).
std::size_t count_self_intersections(const TriangleSurface& surface);

/// The triangles of those pairs, ascending, each once.
std::vector<std::int32_t> self_intersecting(const TriangleSurface& surface);

/// How often two of several surfaces cut each other.
struct SurfaceCrossing {
  std::size_t first = 0, second = 0;  ///< of the surfaces, first < second
  std::size_t pairs = 0;              ///< of triangles, at least one
};

/// Pairs of triangles of different surfaces that meet in more than the corners, edges and whole triangles that they
/// share with equal coordinates (exact predicates; triangles without area are skipped: their edges are their
/// neighbours'). A surface that lies inside another one crosses nothing. @return ascending, only surfaces that cross
std::vector<SurfaceCrossing> surface_crossings(const std::vector<const TriangleSurface*>& surfaces);

/// Turns triangles over so that neighbours agree and the surface bounds a volume from outside.
/// @return triangles that had to be turned
/// @throws std::invalid_argument when the surface is open or not manifold
std::size_t orient_outward(TriangleSurface& surface);

/// How far the points of one surface lie from another one, weighted by area.
struct SurfaceDistance {
  double mean_m = 0;
  double p99_m = 0;
  double max_m = 0;
  double rms_m = 0;
};

/// Sampled on every triangle of `from` (centroid; edge midpoints too when the surface is coarse), exact at each sample.
SurfaceDistance distance_from_to(const TriangleSurface& from, const TriangleSurface& to);

}  // namespace trocar
