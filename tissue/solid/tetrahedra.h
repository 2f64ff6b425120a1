// A tetrahedral mesh of one or several labels for reference computations and export.
//
// CGAL Mesh_3 (Delaunay refinement, then perturbation and exudation of slivers) on the argmax of the labels' smoothed
// fields. RAS, metres. Same input, same bytes. Thread: any, not the tick.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

struct TetrahedraOptions {
  double cell_m = 0.010;  ///< largest circumradius of a tetrahedron
  double facet_distance_voxel =
      0.4;               ///< how far surface facets may lie from the field's surface, in voxels; 0.35 to 0.5
  bool optimise = true;  ///< perturb and exude
  Progress progress = {};
};

struct TetrahedraMesh {
  std::vector<Vec3> nodes;                              ///< m
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< positive volume
  std::vector<std::int32_t> labels;                     ///< one a tetrahedron
};

struct TetrahedraFacts {
  std::size_t nodes = 0, tetrahedra = 0;
  double min_dihedral_deg = 0;
  double share_below_15 = 0;  ///< tetrahedra with a dihedral angle under 15 degrees
  double volume_ml = 0;
  double volume_error_pct = 0;   ///< against the labels' voxels
  double surface_rms_voxel = 0;  ///< boundary facets against the field's surface, sampled
  double surface_max_voxel = 0;
};

struct BuiltTetrahedra {
  TetrahedraMesh mesh;
  TetrahedraFacts facts;
  std::vector<std::string> notes;
};

/// @param labels numbers in the map; each becomes a subdomain
/// @throws InputError when a label is absent or too small
BuiltTetrahedra make_tetrahedra(const LabelVolume& volume, const std::vector<int>& labels,
                                const TetrahedraOptions& options);

/// Gmsh MSH 2.2, ASCII; physical and elementary tag are the label.
std::string gmsh_text(const TetrahedraMesh& mesh);

/// Smallest dihedral angle of a tetrahedron, degrees.
double smallest_dihedral_deg(const TetrahedraMesh& mesh, std::size_t tetrahedron);

}  // namespace trocar
