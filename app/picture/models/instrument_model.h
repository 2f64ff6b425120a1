// Shape of the 5 mm grasper: insulated shaft, steel neck, two toothed jaws on one hinge.
//
// Frame I: origin at the tip with jaws closed, z along the shaft towards the tip, x the hinge axis. Metres.
// PictureVertex::light[1] is 1 on steel, 0 on insulation. Thread: any.
#pragma once

#include "app/picture/models/picture_mesh.h"

namespace trocar {

inline constexpr double kJawLength_m = 0.019;  ///< hinge to tip

/// Shaft and neck (everything behind the hinge).
PictureMesh build_shaft(double radius_m, double length_m);

/// Upper jaw, closed; frame: origin at the hinge, z towards the tip, flat toothed side at y = 0, body at y > 0.
PictureMesh build_jaw(double radius_m);

/// Pose in I of jaw `side` (+1 upper, -1 lower) when the jaws' tips stand `opening_m` apart.
/// @param opening_m clamped to what the hinge allows, 0 to 1.4 jaw lengths.
Pose jaw_pose(int side, double opening_m);

}  // namespace trocar
