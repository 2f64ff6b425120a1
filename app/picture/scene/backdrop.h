// What surrounds the organ in the picture: the lining of the inflated abdomen and a bed of fat; or, round a board, the
// inside of a box trainer. Scenery only: it is neither felt nor scored, and its shape comes from the bounds of organ or
// stage alone, so it stays still while the camera moves.
//
// Frame T, m, z up. Thread: any.
#pragma once

#include "app/picture/models/picture_mesh.h"

namespace trocar {

/// Inside of a dome round the organ; normals and winding face inwards.
PictureMesh build_cavity(const Eigen::AlignedBox3d& organ_T);

/// Lobed bed of fat in which the organ lies.
PictureMesh build_fat_bed(const Eigen::AlignedBox3d& organ_T);

/// Draped floor just below the stage that rises to walls on all sides.
PictureMesh build_trainer_box(const Eigen::AlignedBox3d& stage_T);

}  // namespace trocar
