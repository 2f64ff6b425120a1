// The scene behind the start page: the shipped abdomen, breathing, an instrument that moves slowly over it.
//
// Frame T, m, s. Pure: same scene and time, same view. Thread: any.
#pragma once

#include <memory>

#include "app/graphics/scene_view.h"
#include "app/scene.h"

namespace trocar {

/// @param organ_T surface of the scene's organ, shared between frames so that it is uploaded once.
SceneView show_view(const Scene& scene, const std::shared_ptr<const TriangleSurface>& organ_T, double t_s);

}  // namespace trocar
