// Filling MeshFacts: from the mask what was kept, lost and added, from the finished surface what it measures.
//
// Thread: any.
#pragma once

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/mesh/surface/mesh_facts.h"

namespace trocar {

/// Parts, bridges, cavities and the cut, in numbers and in words.
void note_mask(const LabelMask& mask, double voxel_ml, MeshFacts& facts);

/// @param kept_m3 what the surface should enclose
/// @param reference what distances are measured against
/// @param centroid_m of what was kept
void measure(const TriangleSurface& surface, double kept_m3, const TriangleSurface& reference, const Vec3& centroid_m,
             MeshFacts& facts);

}  // namespace trocar
