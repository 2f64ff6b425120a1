// CGAL's Mesh_3 behind one function: tetrahedra of the regions that a function of place names.
//
// Delaunay refinement (Boissonnat and Oudot 2005; Jamin et al. 2015), then perturbation and exudation of slivers. The
// random numbers it draws start from one seed. Lengths in the unit of the caller. Thread: any; draws from the thread's
// own generator.
#pragma once

#include <functional>

#include "tissue/solid/tetrahedra.h"

namespace trocar {

struct MesherSettings {
  Eigen::AlignedBox3d box;  ///< holds every region, with some room
  double cell = 1;          ///< largest circumradius of a tetrahedron
  double facet = 1;         ///< largest radius of a surface facet's ball
  double facet_distance = 0.1;
  bool optimise = true;
};

/// @param region number of the region at a place, 0 outside
TetrahedraMesh meshed(const std::function<int(const Vec3&)>& region, const MesherSettings& settings);

}  // namespace trocar
