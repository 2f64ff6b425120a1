// Shapes of scene objects as meshes in their own frame O (scene_object.h says where its origin lies).
//
// PictureVertex::light[1] is 1 on accented parts (pen tip, roll fin, the inside of a sleeve). Metres. Thread: any.
#pragma once

#include "app/picture/models/picture_mesh.h"
#include "app/picture/scene/scene_object.h"

namespace trocar {

/// Mesh of a shape of the given size. Closed, wound outwards.
PictureMesh build_solid(SceneObject::Shape shape, const Vec3& size_m);

/// Box about the origin with edges rounded by `round_m`; faces carry a grid so that a soft one can be pinched.
PictureMesh build_rounded_box(const Vec3& size_m, double round_m, int cells);

}  // namespace trocar
