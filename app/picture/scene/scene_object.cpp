#include "app/picture/scene/scene_object.h"

namespace trocar {

bool is_ghost(const SceneObject& object) {
  return object.style == SceneObject::Style::kGhost || object.style == SceneObject::Style::kGhostLit ||
         object.style == SceneObject::Style::kGhostDone;
}

const std::array<FoamClass, 3>& foam_classes() {
  static const std::array<FoamClass, 3> classes = {{{Vec3(0.42, 0.26, 0.03), Vec3(0.10, 0.05, 0.01), 1},
                                                    {Vec3(0.10, 0.36, 0.60), Vec3(0.01, 0.03, 0.10), 2},
                                                    {Vec3(0.50, 0.15, 0.32), Vec3(0.09, 0.01, 0.05), 3}}};
  return classes;
}

}  // namespace trocar
