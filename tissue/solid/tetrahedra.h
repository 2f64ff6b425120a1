// Tetrahedral meshes of closed surfaces, one region an organ, for reference computations and export.
//
// Delaunay refinement on the regions that the surfaces bound (tetrahedra_mesher.h, organ_regions.h). Organs that touch
// share nodes and faces: one region begins where the other ends. Then border nodes move by less than a facet's distance
// until every organ has its volume, and nodes until the flattest tetrahedra stand up (tetrahedra_angles.h). RAS,
// metres. Same input, same bytes. Thread: any, not the tick.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

struct TetrahedraOptions {
  double cell_m = 0.010;  ///< largest circumradius of a tetrahedron
  Progress progress = {};
};

struct TetrahedraMesh {
  std::vector<Vec3> nodes;                              ///< m
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< positive volume
  std::vector<std::int32_t> labels;                     ///< one a tetrahedron: the organ, from 1
};

struct TetrahedraRegion {
  std::size_t tetrahedra = 0;
  double volume_ml = 0;
  double volume_error_pct = 0;  ///< against the surface, less what smaller organs take of it
};

struct TetrahedraFacts {
  std::size_t nodes = 0, tetrahedra = 0;
  double min_dihedral_deg = 0;
  double share_below_15 = 0;  ///< tetrahedra with a dihedral angle under 15 degrees
  double volume_ml = 0;
  double volume_error_pct = 0;  ///< the largest of the regions
  double surface_rms_m = 0;     ///< borders of the regions against the surfaces, sampled
  double surface_max_m = 0;
  std::vector<TetrahedraRegion> regions;  ///< of label 1, 2, ...
};

struct BuiltTetrahedra {
  TetrahedraMesh mesh;
  TetrahedraFacts facts;
};

/// How many there will be, within a factor of two: from volumes, areas and thicknesses alone.
double expected_tetrahedra(const std::vector<const TriangleSurface*>& organs, double cell_m);

/// @param organs closed, outward; each becomes a region, numbered from 1. Where two overlap, the smaller one has the
/// place: of an organ that smaller ones fill no tetrahedron comes out.
/// @throws InputError: a size that is no length up to a metre, more tetrahedra than the readers take (kMaxTriangles).
/// EnvironmentError: too little memory for them
BuiltTetrahedra make_tetrahedra(const std::vector<const TriangleSurface*>& organs, const TetrahedraOptions& options);

/// Smallest dihedral angle of a tetrahedron, degrees.
double smallest_dihedral_deg(const TetrahedraMesh& mesh, std::size_t tetrahedron);

}  // namespace trocar
