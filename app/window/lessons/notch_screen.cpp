#include "app/window/lessons/notch_screen.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/ui/button_row.h"
#include "haptics/input_error.h"
#include "haptics/least_turn.h"

namespace trocar {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

constexpr double kSide = 360, kSideHigh = 300, kNotchMargin = 10, kAxis_m = 0.014, kThin_m = 0.0012;

SceneObject object(Shape shape, const Vec3& middle_T, const Vec3& size_m, const Vec3& colour) {
  SceneObject out;
  out.shape = shape;
  out.X_TO.p = middle_T;
  out.size_m = size_m;
  out.colour = colour;
  return out;
}

void add_walls(const Notch& n, NotchWall touched, std::vector<SceneObject>& out) {
  const double a = n.half_width_m, t = n.thickness_m, deep = n.front_m + n.back_m, high = 2 * n.half_height_m;
  const Vec3 grey(0.10, 0.12, 0.14), side(t, deep, high), back(2 * (a + t), t, high);
  const double y = 0.5 * (n.back_m - n.front_m);
  out.push_back(object(Shape::kBox, {-(a + t / 2), y, 0}, side, grey));
  out.push_back(object(Shape::kBox, {a + t / 2, y, 0}, side, grey));
  out.push_back(object(Shape::kBox, {0, n.back_m + t / 2, 0}, back, 0.85 * grey));
  if (touched != NotchWall::kNone) out[static_cast<std::size_t>(touched) - 1].style = Style::kLit;
}

/// A rod from p along `way`.
SceneObject rod(const Vec3& p, const Vec3& way, double thick_m, const Vec3& colour) {
  SceneObject out = object(Shape::kCylinder, p + 0.5 * way, {thick_m, thick_m, way.norm()}, colour);
  out.X_TO.R = least_turn(Vec3::UnitZ(), way).toRotationMatrix();
  return out;
}

/// The tip's axes, red, green and blue as in the thesis; their ends differ in shape: ball, box, ring.
void add_axes(const Pose& X_TI, std::vector<SceneObject>& out) {
  const Vec3 colours[] = {{0.60, 0.06, 0.03}, {0.02, 0.42, 0.14}, {0.03, 0.16, 0.62}};
  const Shape ends[] = {Shape::kSphere, Shape::kBox, Shape::kRing};
  for (int i = 0; i < 3; ++i) {
    const Vec3 way = kAxis_m * X_TI.R.col(i);
    out.push_back(rod(X_TI.p, way, kThin_m, colours[i]));
    SceneObject end =
        object(ends[i], X_TI.p + way, {0.004, i == 1 ? 0.003 : 0.004, i == 2 ? 0.001 : 0.003}, colours[i]);
    end.X_TO.R = X_TI.R;
    out.push_back(end);
  }
}

void add_arrow(const Vec3& tip_T, const Vec3& force_T, std::vector<SceneObject>& out) {
  const double length = std::min(kLongestArrow_m, kArrow_m_per_n * force_T.norm());
  if (length < 5e-4) return;
  const Vec3 way = length * force_T.normalized(), yellow(0.75, 0.66, 0.04);
  out.push_back(rod(tip_T, way, 0.0022, yellow));
  for (int k = 0; k < 3; ++k) {  // the head: discs that grow narrower
    const double wide = 0.007 - 0.002 * k;
    SceneObject disc = rod(tip_T + way + 0.0015 * k * way.normalized(), 0.0015 * way.normalized(), wide, yellow);
    out.push_back(disc);
  }
}

std::string wall_words(const Translator& w, NotchWall wall) {
  switch (wall) {
    case NotchWall::kNone:
      return w("nothing");
    case NotchWall::kLeft:
      return w("left wall");
    case NotchWall::kRight:
      return w("right wall");
    case NotchWall::kBack:
      return w("back wall");
  }
  return "";
}

NotchWall touched_wall(const RunMoment& m) {
  return m.record.stylus.contact ? notch_wall(m.record.stylus.contact_normal_T) : NotchWall::kNone;
}

}  // namespace

SceneView notch_view(const Scene& scene, const Notch& notch, const RunMoment& moment) {
  const StylusState& stylus = moment.record.stylus;
  SceneView view;
  add_walls(notch, touched_wall(moment), view.objects);
  view.X_TI = stylus.X_TI;
  view.shaft_radius_m = scene.loop.tool.radius_m;
  view.shaft_length_m = ToolShape{}.shaft_length_m;  // as it is seen; what touches is the tip
  add_axes(stylus.X_TI, view.objects);
  add_arrow(stylus.X_TI.p, stylus.F_I_T.force, view.objects);
  view.stage_T.extend(Vec3(-0.06, -0.05, -notch.half_height_m - 0.004)).extend(Vec3(0.06, 0.06, 0.03));
  view.camera.eye_T = Vec3(-0.010, -0.105, 0.095);
  view.camera.look_at_T = Vec3(0, 0.004, 0);
  view.camera.diagonal_fov_deg = 72;
  view.hud.elapsed_s = moment.t_s;
  return view;
}

void NotchScreen::begin(PracticeModel& model) {
  if (run_ || !wrong_.empty()) return;
  try {
    run_ = std::make_unique<NotchRun>(model.assets(), 1);
  } catch (const std::exception& error) {
    wrong_ = error.what();
  }
}

void NotchScreen::steer(PracticeModel& model, double dt_s) {
  if (!run_ || !run_->ready() || run_->finished()) return;
  if (!steering_) {
    const Mat3 rest = run_->newest().record.stylus.X_TI.R;
    SteeringReach reach;
    reach.radius_m = run_->notch().reach_m;
    model.steering().begin({rest, Vec3::Zero()}, run_->newest().record.stylus.jaw_opening_m, Vec3::Zero(), reach);
    steering_ = true;
  }
  const StylusState& stylus = run_->newest().record.stylus;
  const AtHand around{
      .now = model.steering().intent(), .jaws = false, .touching = stylus.contact, .normal_T = stylus.contact_normal_T};
  run_->steer(model.steering().advance(dt_s, camera_, std::max(1.0, picture_.height), around));
}

void NotchScreen::settle(PracticeModel& model, double wait_s) {
  begin(model);
  for (double waited = 0; run_ && !run_->ready() && !run_->finished() && waited < wait_s; waited += 0.01)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

std::optional<ScreenName> NotchScreen::handle(const InputEvent& event, PracticeModel& model) {
  model.steering().handle(event);
  return {};
}

std::string NotchScreen::side(Ui& ui, PracticeModel& model, const Area& area) {
  const Translator& w = model.words();
  ui.begin_panel("notch", area);
  ui.scroll_by_keys();
  ui.heading(w("The notch"));
  ui.text(w("Three walls, at the left, the right and the back: thesis, figure 3.40. Nothing is graded."), Ink::kDim);
  if (run_) {
    const RunMoment& now = run_->newest();
    const StylusState& s = now.record.stylus;
    const bool touching = s.contact;
    ui.pair(w("Touched"), wall_words(w, touched_wall(now)));
    ui.pair(w("Force"), w("{0} N", {w.number(touching ? s.F_I_T.force.norm() : 0.0, 2)}), Ink::kAccent);
    ui.pair(w("Depth"), w("{0} mm", {w.number(touching ? 1e3 * s.depth_m : 0.0, 1)}));
    ui.pair(w("Walls"), w("{0} N/m", {w.number(run_->stiffness(), 0)}));
    if (!run_->ready()) ui.marked(Mark::kInfo, w("The device is getting ready."));
    if (run_->finished()) ui.marked(Mark::kWarning, w("The device has stopped: {0}", {run_->fault()}), Ink::kAlarm);
  }
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  const std::string panel_key = key_name(model.keys().key_of(Action::kDevicePanel));
  const std::string chosen = button_rows(ui, {{"soft", w("20 N/m"), "1"},
                                              {"firm", w("150 N/m"), "2"},
                                              {"panel", w("Device"), panel_key},
                                              {"back", w("Course"), "Esc"}});
  ui.text(w("Arrow: the force on the tip. Axes of the tip: x red with a ball, y green with a box, z blue with a ring."),
          Ink::kDim);
  ui.end_panel();
  return chosen;
}

std::optional<ScreenName> NotchScreen::frame(Ui& ui, PracticeModel& model, double dt_s) {
  ui.keys_to_screen();
  begin(model);
  steer(model, dt_s);
  const double m = ui.px(kNotchMargin);
  const Area panel = device_panel_area(ui, true);
  const bool beside = panel.x > ui.px(kSide) + 3 * m;  // else the panel lies over all
  if (!seen_) panel_.open = beside;
  seen_ = true;
  const double left = std::min(ui.px(kSide), ui.width() - 2 * m);
  const double picture_right = panel_.open && beside ? panel.x - m : ui.width();
  const bool stacked = panel_.open && beside;
  const double top_high = stacked ? std::max(0.44 * (ui.height() - 3 * m), ui.px(kSideHigh)) : ui.height() - 2 * m;
  if (stacked)
    picture_ = {m, 2 * m + top_high, picture_right - m, ui.height() - 3 * m - top_high};
  else
    picture_ = {0, 0, ui.width(), ui.height()};
  std::string chosen;
  side_shown_ = !panel_.open || beside;
  // Beside the panel, not behind it; a tall window has room below.
  if (!stacked && side_shown_) {
    const double used = left + 2 * m;
    if (ui.width() - used >= 0.4 * ui.width()) picture_ = {used, 0, ui.width() - used, ui.height()};
  }
  if (side_shown_) chosen = side(ui, model, {m, m, stacked ? picture_right - m : left, top_high});
  if (run_) panel_.frame(ui, model, run_->newest().record, run_->scene().loop, dt_s, panel);
  if (run_ && chosen == "soft") run_->set_stiffness(kThesisWall_n_per_m);
  if (run_ && chosen == "firm") run_->set_stiffness(kFirmWall_n_per_m);
  const bool hidden_key = !side_shown_ && ui.pressed(key_name(model.keys().key_of(Action::kDevicePanel)));
  if (chosen == "panel" || hidden_key) panel_.open = !panel_.open;
  if (chosen == "back" || (!side_shown_ && ui.pressed("Esc"))) return ScreenName::kCurriculum;
  return std::nullopt;
}

std::optional<Screen::Stage> NotchScreen::stage(PracticeModel& /*model*/, int /*width*/, int /*height*/) {
  if (!run_ || picture_.width <= 0) return std::nullopt;
  SceneView view = notch_view(run_->scene(), run_->notch(), run_->newest());
  camera_ = view.camera;
  return Stage{view, picture_.x, picture_.y, picture_.width, picture_.height, 0};
}

}  // namespace trocar
