// What the picture of a steered attempt shows beyond the attempt itself: the scope where the person has turned it, the
// ring that shows where the hand pulls to, and on which side an instrument out of view is.
//
// The ring stands off the tip by what the spring of the hand is drawn out: a person without a device sees the force
// that a hand would feel. Frame T, m, rad. Pure. Thread: any.
#pragma once

#include <optional>
#include <vector>

#include "app/picture/display/hud_layout.h"
#include "app/picture/scene/scope_optics.h"
#include "app/window/input/steering.h"
#include "scenarios/hands/hand.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

/// The camera after the scope has been turned about its port, pushed in, and its light post turned. The camera head is
/// held as it was: the post turns the notch and, with a tilted tip, the line of sight on a cone about the shaft; the
/// level tick shows what becomes of the horizon.
/// @param camera as the exercise frames its scene, which a scope at rest shows whatever its tip. @param tilt_rad of the
/// tip: 0 or pi / 6.
Camera moved_camera(const Camera& camera, const Steering::ScopeMove& move, double tilt_rad = 0);

/// Depth to which that move may be pushed in before the scope touches what lies there, m: the move's own where nothing
/// is in the way, never less than a scope can be drawn back. Surfaces count by their vertices, the instrument by its
/// axis; either only in front of the port.
inline constexpr double kScopeClear = 0.008;  ///< m from the shaft's axis: 5 mm of shaft, and half an edge of a surface
double clear_depth(const Camera& camera, const Steering::ScopeMove& move, double tilt_rad,
                   const std::vector<SurfacePtr>& surfaces_T, const Pose& X_TI);

/// Ring round the shaft's axis at the target, and a thread from it to the tip; nothing while they are within
/// kGhostFrom.
void add_ghost(SceneView& view, const HandIntent& target);
inline constexpr double kGhostFrom = 0.0012;  // m

/// Where on the rim a tip that is out of the picture lies: angle from the right, up positive; empty while it is in
/// view.
std::optional<double> rim_angle(const Camera& camera, const PixelRect& picture, const Vec3& tip_T);

/// px from the picture's middle to the point of an arrow that shows that way: at the rim of the round field, within the
/// picture, and as far inwards as it takes to lie over none of the boxes. @param size of the arrow, px.
double rim_reach(const PixelRect& picture, double angle_rad, double size, const std::vector<HudBox>& clear_of);

/// Without guidance only the lit target is marked, and neither its plumb line nor the waiting ones.
void hide_guides(SceneView& view);

}  // namespace trocar
