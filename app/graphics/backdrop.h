// What surrounds the organ in the picture: the lining of the inflated abdomen and a bed of fat. Scenery only: it is
// neither felt nor scored, and its shape comes from the organ's bounds alone, so it stays still while the camera moves.
//
// Frame T, m, z up. Thread: any.
#pragma once

#include "app/graphics/picture_mesh.h"

namespace trocar {

/// Inside of a dome round the organ; normals and winding face inwards.
PictureMesh build_cavity(const Eigen::AlignedBox3d& organ_T);

/// Lobed bed of fat in which the organ lies.
PictureMesh build_fat_bed(const Eigen::AlignedBox3d& organ_T);

}  // namespace trocar
