// The scene behind the start page as it lives: organs that breathe, instruments that move a little.
//
// Frame T, m, s. Pure: same scene and time, same view. Thread: any.
#pragma once

#include "app/picture/scene/scene_view.h"

namespace trocar {

/// @param still of app/picture/models/show_scene.h. @param t_s since the page was opened.
SceneView show_view(const SceneView& still, double t_s);

}  // namespace trocar
