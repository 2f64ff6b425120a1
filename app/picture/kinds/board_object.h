// A training board in the picture, and the rings that stand on one. Frame T, m. Thread: any.
#pragma once

#include "app/picture/scene/scene_object.h"
#include "tissue/rigid/rigid_scene.h"

namespace trocar {

/// @param lines colour of what is printed on it.
SceneObject board_object(double top_z, double side, double thickness, const Vec3& centre, const Vec3& lines);
/// A triangular ring as it is laid out.
SceneObject triangle_object(const FoamBlock& ring);

}  // namespace trocar
