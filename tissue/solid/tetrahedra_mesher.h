// CGAL's Mesh_3 behind one function: tetrahedra of the regions that a function of place names.
//
// Delaunay refinement (Boissonnat and Oudot 2005; Jamin et al. 2015), then slivers taken out by weights (exudation;
// Cheng et al. 2000) and, where asked for, by perturbation (Tournois et al. 2009). The random numbers it draws start
// from one seed. Lengths in the unit of the caller. Thread: any; draws from the thread's own generator.
#pragma once

#include <functional>

#include "tissue/solid/tetrahedra.h"

namespace trocar {

/// A point on the border of a region: where refinement begins.
struct MesherSeed {
  Vec3 place = Vec3::Zero();
  int region = 0;
};

struct MesherSettings {
  Eigen::AlignedBox3d box;              ///< holds every region, with some room
  double cell = 1;                      ///< largest circumradius of a tetrahedron
  double facet = 1;                     ///< largest radius of a surface facet's ball
  std::vector<double> facet_distances;  ///< of region 1, 2, ...; a facet between two keeps the smaller one
  std::vector<MesherSeed> seeds = {};   ///< none: rays are shot, which miss small regions
  double sliver_deg = 12;               ///< dihedral angle wanted
  bool perturb = true;                  ///< slow
};

/// @param region number of the region at a place, 0 outside
/// @return tetrahedra of positive volume, labelled by region
TetrahedraMesh meshed(const std::function<int(const Vec3&)>& region, const MesherSettings& settings);

}  // namespace trocar
