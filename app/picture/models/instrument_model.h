// Shapes of the 5 mm instruments: what of each is behind the hinge, and its jaws.
//
// Insulated shaft and steel neck are one for all with jaws: grasper (two toothed jaws), scissors (two blades that pass
// one another) and clip applier (two bowed jaws that meet at their ends). The hook is a bent wire, the suction tube
// steel with an open end and holes. A probe looks like a closed grasper. What touches ends in spheres about the tip
// (haptics/contact/tool_shape.h), so what is thinner reaches a little beyond it.
//
// Frame I: origin at the tip with jaws closed, z along the shaft towards the tip, x the hinge axis. Metres.
// PictureVertex::light[1] is 1 on steel, 0 on insulation. Thread: any.
#pragma once

#include "app/picture/models/picture_mesh.h"
#include "haptics/contact/instrument.h"

namespace trocar {

inline constexpr double kJawLength_m = 0.019;  ///< of the grasper, hinge to tip

/// Hinge to tip as it is drawn; 0: no jaws.
double drawn_jaw_length_m(InstrumentKind kind);

/// All of an instrument but its jaws.
PictureMesh build_body(InstrumentKind kind, double radius_m, double length_m);
/// Shaft and neck (everything behind the hinge).
PictureMesh build_shaft(double radius_m, double length_m, double jaw_length_m = kJawLength_m);

/// Upper jaw, closed; frame: origin at the hinge, z towards the tip, inner side at y = 0, body at y > 0. Empty: none.
PictureMesh build_jaw(InstrumentKind kind, double radius_m);

/// Pose in I of jaw `side` (+1 upper, -1 lower) when the jaws' tips stand `opening_m` apart.
/// @param opening_m clamped to what the hinge allows, 0 to 1.4 jaw lengths.
Pose jaw_pose(int side, double opening_m, double jaw_length_m = kJawLength_m);

}  // namespace trocar
