// The organs round the one that an exercise is done on: placed with it, felt with it, seen with it.
//
// An organ that lies over the board's region, seen from above, is set aside as a surgeon would hold it away: it is
// neither felt nor seen, and its name is told. Frame T, SI units. Thread: loading only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "scenarios/exercise.h"
#include "tissue/organ/material_table.h"
#include "tissue/organ/organ.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

struct AdjacentOrgan {
  std::string name, material;
  SurfacePtr surface_T;
};

struct AdjacentOrgans {
  std::vector<AdjacentOrgan> organs;
  std::vector<std::string> set_aside;  ///< names of those that would cover the region
  TriangleSurface felt_T;              ///< the organ's triangles, then those of the adjacent organs; empty without them
  std::vector<std::int32_t> triangle_material;  ///< of felt_T: 0 the organ, n materials[n - 1]
  std::vector<ContactMaterial> materials;  ///< of the adjacent organs; at most kMaxPatchMaterials - 1 different ones
};

/// @param organ with adjacent organs. @param organ_T placed. @param X_TO its pose
/// @param exercise its region and the surface that it sets for the organ
/// @param bound name of one that organ_T holds already; empty: none
AdjacentOrgans place_adjacent_organs(const Organ& organ, const TriangleSurface& organ_T, const Pose& X_TO,
                                     const Exercise& exercise, const MaterialTable& materials,
                                     const std::string& bound = {});

}  // namespace trocar
