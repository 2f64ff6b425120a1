#include "app/picture/scene/scene_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace trocar {
namespace {

void put(float (&to)[4], const Vec3& xyz, double w) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(xyz[i]);
  to[3] = static_cast<float>(w);
}

}  // namespace

bool has_dimple(const SceneView& view) { return view.dimple_T.has_value() && view.dimple_depth_m > 1e-5; }

SceneBlock make_scene_block(const SceneView& view, const ScopeOptics& optics) {
  SceneBlock block{};
  const Eigen::Matrix4f clip = optics.view_projection(), lamp_clip = optics.lamp_projection();
  std::memcpy(block.view_projection, clip.data(), sizeof block.view_projection);
  std::memcpy(block.lamp_projection, lamp_clip.data(), sizeof block.lamp_projection);
  put(block.eye, optics.eye(), 0);
  // The camera's automatic gain: what it looks at comes out equally bright from 50 to 200 mm.
  const double distance_mm = 1000 * std::clamp((view.camera.look_at_T - view.camera.eye_T).norm(), 0.05, 0.20);
  put(block.lamp, optics.lamp(), 1.75 * (distance_mm * distance_mm + 60));
  put(block.axis, optics.forward(), view.hud.elapsed_s);
  put(block.tip, view.X_TI.p, view.shaft_radius_m);
  put(block.shaft, -view.X_TI.R.col(2), view.shaft_length_m);
  const double depth = has_dimple(view) ? std::min(view.dimple_depth_m, 0.05) : 0.0;
  put(block.dimple, view.dimple_T.value_or(Vec3::Zero()), depth);
  // A deeper dent is a wider one, so that its slope stays below that of tissue about to tear.
  put(block.dimple_normal, view.dimple_normal_T, std::max(0.0042, 0.9 * depth));
  return block;
}

}  // namespace trocar
