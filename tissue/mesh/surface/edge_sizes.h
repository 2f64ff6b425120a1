// How long the edges of a surface of so many triangles should be, place by place: short where it bends, long where it
// is flat.
//
// A facet of edge L on a surface of curvature k lies about k L^2 / 6 off it (Dunyach et al. 2013), so equal error asks
// for L ~ 1 / sqrt(k). The curvature is that of the normals after diffusion over a few voxels, else the voxels' stairs
// count as bends. Neighbouring sizes differ by no more than `growth` a unit of length. Metres. Deterministic. Thread:
// any.
#pragma once

#include <cstddef>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct EdgeSizeOptions {
  int triangles = 6000;
  double smoothing_m = 0;  ///< distance over which normals are averaged: about two voxels
  double shortest = 0.45;  ///< of the edge that an even mesh would have
  double longest = 1.35;
  double growth = 0.25;
};

/// Of a mesh of as large a surface of so many equilateral triangles.
double even_edge_m(const TriangleSurface& surface, std::size_t triangles);

/// One size a vertex, m.
/// @param surface closed, dense against the wanted triangles
std::vector<double> edge_sizes(const TriangleSurface& surface, const EdgeSizeOptions& options);

/// Lowers sizes, one a vertex, until none exceeds a neighbour's by more than growth x distance.
void limit_growth(std::vector<double>& sizes, const TriangleSurface& surface, double growth);

}  // namespace trocar
