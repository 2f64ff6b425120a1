// Counting facts of a triangle surface: is it closed, manifold, of how many pieces, with how many handles.
//
// Purely combinatorial, but for degenerate triangles (zero area). Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfaceTopology {
  std::size_t vertices = 0;  ///< used by a triangle
  std::size_t triangles = 0;
  std::size_t boundary_edges = 0;        ///< edges of one triangle
  std::size_t nonmanifold_edges = 0;     ///< edges of three and more triangles
  std::size_t misoriented_edges = 0;     ///< edges that two triangles run through in the same direction
  std::size_t nonmanifold_vertices = 0;  ///< vertices at which several fans of triangles touch
  std::size_t degenerate_triangles = 0;  ///< repeated corner, or area below 1e-6 of the longest edge squared
  std::size_t components = 0;            ///< connected over shared vertices
  int genus = 0;                         ///< sum over the components; meaningful for closed manifolds only

  bool closed() const { return triangles > 0 && boundary_edges == 0; }
  bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0 && misoriented_edges == 0; }
};

SurfaceTopology analyse_topology(const TriangleSurface& surface);

/// Component number (from 0, by first triangle) of each triangle.
std::vector<std::int32_t> triangle_components(const TriangleSurface& surface);

/// The triangles that are wanted, their vertices renumbered in order of first use. @param keep of each triangle
TriangleSurface some_triangles(const TriangleSurface& surface, const std::vector<bool>& keep);

/// Adds the triangles of another surface, each turned over; no vertex is joined.
void append_turned(TriangleSurface& surface, const TriangleSurface& more);

/// The surface without its components that enclose less than `least_m3` (absolute), vertices renumbered in order of
/// first use. Inner walls (components of negative volume) go too: they bound cavities.
/// @param lost_volumes_m3 when given: volumes of the dropped ones that are not inner walls, largest first
TriangleSurface without_specks(const TriangleSurface& surface, double least_m3,
                               std::vector<double>* lost_volumes_m3 = nullptr);

/// Merges vertices that lie in one cell of a grid of `tolerance_m`, drops triangles that collapse or repeat.
TriangleSurface welded(const TriangleSurface& surface, double tolerance_m);

double surface_area_m2(const TriangleSurface& surface);
/// Centre of the enclosed volume, m.
Vec3 volume_centroid_m(const TriangleSurface& surface);

}  // namespace trocar
