#include "app/screens/show_scene.h"

#include <cmath>
#include <numbers>

#include "app/attempt_scene.h"
#include "app/run_moment.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr double kBreath_s = 4.5;      // 13 breaths a minute, under anaesthesia
constexpr double kBreath_m = 0.004;    // of the lens against the organs, along the body

double wave(double t_s, double period_s) { return std::sin(2 * std::numbers::pi * t_s / period_s); }

}  // namespace

SceneView show_view(const Scene& scene, const std::shared_ptr<const TriangleSurface>& organ_T, double t_s) {
  RunMoment moment;
  moment.t_s = t_s;
  StylusState& stylus = moment.record.stylus;
  stylus.X_TI.R = scene.loop.map.instrument_pose(home_pose()).R;
  stylus.X_TI.p = scene.board.centre_T + Vec3(0.016 * wave(t_s, 19), -0.006 + 0.010 * wave(t_s, 13), 0.026 + 0.006 * wave(t_s, 8));
  stylus.jaw_opening_m = 0.004 + 0.003 * wave(t_s, 7);
  moment.status.phase = Phase::kRun;
  moment.status.target_index = -1;
  SceneView view = attempt_scene(view_of(scene, moment), organ_T);
  view.targets.clear();
  const Vec3 breath(0, kBreath_m * wave(t_s, kBreath_s), 0.5 * kBreath_m * wave(t_s, kBreath_s));
  view.camera.eye_T += breath;
  view.camera.look_at_T += 0.7 * breath;
  view.hud = {};
  view.hud.elapsed_s = t_s;
  return view;
}

}  // namespace trocar
