// Whether a mesh still has the form of what it was made from, or too few triangles for it.
//
// Where triangles are much wider than the body is thick, its two sides cannot lie on their places: it swells, or loses
// volume, or its thin ends. The thickness is 2 V / A, that of a wide plate. Metres, RAS. Thread: any.
#pragma once

#include <optional>

#include "tissue/mesh/surface/mesh_facts.h"

namespace trocar {

/// What was lost, and what would keep it.
struct LostForm {
  double thickness_m = 0;  ///< of the source
  int triangles = 0;       ///< that were asked for
  int enough = 0;          ///< edges of one and a half thicknesses; 0: a surface has those already, and it did not help
  double volume_error_pct = 0;        ///< against what was kept
  double extent_m = 0, wanted_m = 0;  ///< along the axis on which mesh and source differ most
  double mean_m = 0, p99_m = 0;       ///< from the source to the mesh
  bool volume_lost = false;           ///< more than 5 %
  bool extent_lost = false;           ///< off by more than two voxels and a tenth
};

/// @param source the dense surface that was remeshed
/// @param facts of the mesh, measured. Surfaces of other programs have no voxels: a millimetre stands for one.
/// @param triangles asked for
/// @returns nothing where the form was kept
std::optional<LostForm> lost_form(const TriangleSurface& mesh, const TriangleSurface& source, const MeshFacts& facts,
                                  int triangles);

}  // namespace trocar
