// What lies in the picture of an attempt: discs or ghost pens, board, blocks, rings, port, start sphere; and the
// camera.
//
// Frame T, m. Pure: same moment, same scene. The renderer knows no exercise, this knows no OpenGL. Thread: any.
#pragma once

#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"

namespace trocar {

/// The moment as a scene, without its head-up display.
SceneView attempt_scene(const SessionView& view);

/// Of the exercise's instruments the one that is in hand.
InstrumentKind in_hand(const SessionView& view);

/// Scope that frames the work: on an organ from the trainee's side over the board region, otherwise so that all that
/// belongs to the board fits into the field.
Camera attempt_camera(const Scene& scene);

/// Is the instrument the scope, so that the picture goes with it?
bool is_scope(const Exercise& exercise);
/// What is seen at this moment: through the instrument where that is the scope, else as the work is framed, but drawn
/// back as far as the start needs until it is reached; then it goes in, for as long as a breath.
Camera attempt_camera(const SessionView& view);

/// Board, blocks and ring marks as they are now. @param frame newest state of the blocks; nullptr: as laid out.
std::vector<SceneObject> rigid_objects(const RigidScene& rigid, const TissueFrame* frame, int lit_block);

}  // namespace trocar
