// The uniform block `Scene` of assets/shaders/lighting.glsl, filled from a view. Layout std140, frame T, m.
#pragma once

#include "app/picture/scene/scope_optics.h"

namespace trocar {

struct SceneBlock {
  float view_projection[16];
  float lamp_projection[16];
  float eye[4];
  float lamp[4];           ///< w: gain, mm^2
  float axis[4];           ///< w: time, s
  float tip[4];            ///< w: shaft radius
  float shaft[4];          ///< w: shaft length
  float dimple[4];         ///< w: depth
  float dimple_normal[4];  ///< w: spread
};

/// Whether the tissue is drawn with a dent.
bool has_dimple(const SceneView& view);

SceneBlock make_scene_block(const SceneView& view, const ScopeOptics& optics);

}  // namespace trocar
