#include "app/window/pages/show_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/picture/models/show_scene.h"
#include "tissue/interaction/breathing.h"

namespace trocar {
namespace {

constexpr double kSway_m = 0.004;  // of a hand that waits
constexpr double kJaws_m = 0.002;

double wave(double t_s, double period_s) { return std::sin(2 * std::numbers::pi * t_s / period_s); }

Vec3 sway(double t_s, double phase_s) {
  return kSway_m * Vec3(wave(t_s + phase_s, 11), wave(t_s + phase_s, 7.3), 0.6 * wave(t_s + phase_s, 9.1));
}

}  // namespace

SceneView show_view(const SceneView& still, double t_s) {
  SceneView view = still;
  view.breath_T = bed_shift({14, 0.004}, t_s);
  view.X_TI.p += sway(t_s, 0);
  view.jaw_opening_m = std::max(0.0, view.jaw_opening_m + kJaws_m * wave(t_s, 5.3));
  double phase_s = 3;
  for (InstrumentView& other : view.more_instruments) {
    other.X_TI.p += sway(t_s, phase_s);
    phase_s += 2;
  }
  view.hud = {};
  view.hud.elapsed_s = t_s;
  return view;
}

}  // namespace trocar
