#include "app/picture/attempt/attempt_hud.h"

#include <cmath>
#include <utility>

#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/attempt/surgery_hud.h"
#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {
namespace {

std::vector<HudStep> steps(const Scene& scene, const DirectorStatus& status) {
  const RunStage stage{!waits_for_start(status.phase),
                       status.targets_done >= static_cast<int>(scene.board.targets.size()),
                       status.phase == Phase::kDone};
  std::vector<HudStep> out = {hud_step("Rest at the start", stage.started, !stage.started)};
  for (HudStep& step : picture_of(scene.setup.exercise).steps(stage)) out.push_back(std::move(step));
  return out;
}

/// Bandwidth feedback speaks up over the picture, where the trainee looks.
void add_band_notice(const SessionView& view, const std::vector<ForceBar>& bars, std::vector<HudNotice>& notices) {
  const DirectorStatus& status = view.director.status();
  if (view.scene.level.force_display != "band" || !status.force_shown) return;
  for (const ForceBar& bar : bars) {
    if (bar.hidden) continue;
    const std::string value = hud_number("%.2f N", bar.value_n);
    if (bar.value_n > bar.band_high_n)
      notices.push_back({"Over the band: " + value, HudNotice::Kind::kTooMuch});
    else if (bar.value_n < bar.band_low_n)
      notices.push_back({"Under the band: " + value, HudNotice::Kind::kTooLittle});
  }
}

/// What the map does with the hand's movement, when it is not what the hand expects.
void add_map_notices(const StylusState& stylus, std::vector<HudNotice>& notices) {
  if (stylus.port_held) notices.push_back({"Held near the port: draw back", HudNotice::Kind::kWarning});
  if (stylus.clutched) notices.push_back({"Clutch: the instrument stands still", HudNotice::Kind::kInfo});
}

/// Where there are several to choose from. Behind what stands in the way of the hand: only two notices are shown.
void add_instrument_notices(const SessionView& view, std::vector<HudNotice>& notices) {
  const bool several = view.scene.setup.exercise.instruments.size() > 1;
  if (view.record.stylus.pedal) notices.push_back({"Pedal down", HudNotice::Kind::kWarning});
  if (several) notices.push_back({describe(in_hand(view)).title, HudNotice::Kind::kInfo});
}

std::vector<HudRow> device_rows(const SessionView& view) {
  const Scene& scene = view.scene;
  if (!scene.loop.daq.motors) return {};
  std::vector<HudRow> out = {{"plant", "simulated", ""},
                             {"loop", hud_number("%.0f", scene.loop.daq.rate_hz), "Hz"},
                             {"passivity", view.record.stylus.passivity_active ? "acting" : "ok", ""},
                             {"force scale", hud_number("%.2f", scene.loop.map.force_scale), ""},
                             {"motor heat", hud_number("%.0f", view.record.winding_c), "°C", true}};
  if (scene.loop.map.fulcrum)
    out.push_back({"depth in port", hud_number("%.0f", 1000 * view.record.stylus.depth_in_port_m), "mm"});
  return out;
}

PoseDial shown_dial(const SessionView& view, const Camera& camera) {
  const DirectorStatus& status = view.director.status();
  const std::string& display = view.scene.level.force_display;
  PoseDial dial = pose_dial(view.record.stylus.X_TI, {status.demand.R_TI, status.demand.centre_T}, camera);
  dial.position_tolerance_m = status.demand.radius_m;
  dial.angle_tolerance_rad = status.demand.angle_tolerance_rad;
  const bool matched =
      dial.position_error_m <= dial.position_tolerance_m && dial.angle_error_rad <= dial.angle_tolerance_rad;
  dial.hidden = display == "after" || (display == "band" && matched);
  dial.hidden_note = hidden_note(display);
  return dial;
}

std::string credit(const Scene& scene) {
  if (!kind_of(scene.setup.exercise).on_organ) return "No organ, no patient data · board exercise in a box trainer";
  return "Organ: " + scene.organ.name + (scene.organ.synthetic ? " (synthetic)" : "") +
         (scene.organ.credit.empty() ? "" : " · " + scene.organ.credit);
}

}  // namespace

PoseDial pose_dial(const Pose& X_TI, const Pose& X_TI_wanted, const Camera& camera) {
  const ScopeOptics optics(camera, {0, 0, 720, 720});
  const auto seen = [&](const Vec3& v) {
    return Vec3(v.dot(optics.right()), v.dot(optics.up()), v.dot(optics.forward()));
  };
  PoseDial dial;
  const Vec3 offset = X_TI.p - X_TI_wanted.p;
  dial.offset_C = seen(offset);
  dial.position_error_m = offset.norm();
  // Direction from the tip towards the hand: what the eye compares.
  const Vec3 now = -X_TI.R.col(2), wanted = -X_TI_wanted.R.col(2);
  dial.lean_C = seen(now - wanted);
  const Mat3 between = X_TI_wanted.R.transpose() * X_TI.R;
  dial.roll_rad = std::atan2(between(1, 0) - between(0, 1), between(0, 0) + between(1, 1));
  dial.angle_error_rad = Eigen::AngleAxisd(between).angle();
  return dial;
}

Hud attempt_hud(const SessionView& view, const Camera& camera, const std::string& trainee) {
  const Scene& scene = view.scene;
  const Exercise& exercise = scene.setup.exercise;
  const DirectorStatus& status = view.director.status();
  Hud hud;
  hud.trainee = trainee.empty() ? "Guest" : "Trainee: " + trainee;
  hud.title =
      exercise.number + " " + exercise.title + " · " + scene.level.name + " · " + mapping_name(scene.level.mapping);
  hud.elapsed_s = status.run_time_s;
  hud.limit_s = scene.level.time_limit_s;
  hud.bars = picture_of(exercise).bars(view);
  if (status.demand.oriented && !is_scope(exercise)) hud.dial = shown_dial(view, camera);
  add_map_notices(view.record.stylus, hud.notices);
  add_band_notice(view, hud.bars, hud.notices);
  add_surgery_notices(view, hud.notices);
  add_instrument_notices(view, hud.notices);
  if (plays_freely(scene)) {
    hud.rows = free_play_rows(view);
  } else {
    hud.steps = steps(scene, status);
    hud.rows = picture_of(exercise).rows(scene, status);
  }
  hud.device = device_rows(view);
  hud.toast = status.message;
  hud.toast_hint = status.hint;
  hud.toast_warning = status.warning;
  hud.credit = credit(scene);
  return hud;
}

}  // namespace trocar
