// A training board in the picture. Frame T, m. Thread: any.
#pragma once

#include "app/picture/scene/scene_object.h"

namespace trocar {

/// @param lines colour of what is printed on it.
SceneObject board_object(double top_z, double side, double thickness, const Vec3& centre, const Vec3& lines);

}  // namespace trocar
