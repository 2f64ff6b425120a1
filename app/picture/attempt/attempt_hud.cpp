#include "app/picture/attempt/attempt_hud.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/picture/scene/scope_optics.h"

namespace trocar {
namespace {

std::string text(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

HudStep step(const char* words, bool done, bool current) {
  return {words, done ? HudStep::State::kDone : current ? HudStep::State::kCurrent : HudStep::State::kOpen};
}

std::vector<HudStep> steps(const Scene& scene, const DirectorStatus& status) {
  const bool started = status.phase != Phase::kReady && status.phase != Phase::kArmed;
  const bool all = status.targets_done >= static_cast<int>(scene.board.targets.size());
  const bool done = status.phase == Phase::kDone;
  std::vector<HudStep> out = {step("Rest at the start", started, !started)};
  switch (scene.setup.exercise.kind) {
    case ExerciseKind::kReach:
      out.push_back(step("Match each lit pen and hold", done || all, started && !all));
      break;
    case ExerciseKind::kTouch:
      out.push_back(step("Touch and hold each disc", all, started && !all));
      out.push_back(step("Squeeze the block", done, all && !done));
      break;
    case ExerciseKind::kGrasp:
      out.push_back(step("Carry each lit block to its ring", done || all, started && !all));
      break;
  }
  return out;
}

std::vector<HudRow> rows(const Scene& scene, const DirectorStatus& status) {
  const std::string done = std::to_string(status.targets_done) + " / " + std::to_string(scene.board.targets.size());
  const HudRow hold = {"Hold", text("%.0f", 100 * status.hold_progress), "%"};
  switch (scene.setup.exercise.kind) {
    case ExerciseKind::kReach:
      return {{"Pens matched", done, ""}, {"Out of time", std::to_string(status.timeouts), "x"}, hold};
    case ExerciseKind::kTouch:
      return {{"Discs held", done, ""},
              {"Wrong places", std::to_string(status.wrong_places), ""},
              {"Too much force", std::to_string(status.excess_forces), "x"},
              hold};
    case ExerciseKind::kGrasp:
      return {{"Blocks placed", done, ""}, {"Errors", std::to_string(status.wrong_places), "x"}};
  }
  return {};
}

std::string hidden_note(const std::string& display) {
  return display == "after" ? "shown after the run" : "shown only outside the limits";
}

ForceBar bar(const char* label, double value_n, const WantedForce& band, double limit_n) {
  ForceBar out;
  out.label = label;
  out.value_n = value_n;
  out.band_low_n = band.low_n;
  out.band_high_n = band.high_n;
  out.limit_n = limit_n;
  out.full_scale_n = 1.25 * limit_n;
  return out;
}

/// Grasp: the grip on the lit block, whose limit is where its foam is crushed. Where no colour tells the foam, the bar
/// must not either: it then spans all kinds.
ForceBar block_bar(const SessionView& view) {
  const GraspRules& rules = view.scene.setup.exercise.grasp;
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  double limit_n = 0;
  for (const FoamKind& kind : rules.kinds) limit_n = std::max(limit_n, kind.crush_above_n);
  const auto lit = static_cast<std::size_t>(std::max(0, status.target_index));
  if (level.grasp.colour_cue && lit < view.scene.board.rigid.blocks.size())
    limit_n = view.scene.board.rigid.blocks[lit].crush_above_n;
  ForceBar grip = bar("Grip force", view.record.stylus.grip_force_n, status.demand.band, limit_n);
  grip.hidden = !status.force_shown;
  grip.hidden_note = hidden_note(level.force_display);
  return grip;
}

/// The tip's bar is that of the lit disc; the grip's that of the block.
std::vector<ForceBar> bars(const SessionView& view) {
  const Exercise& exercise = view.scene.setup.exercise;
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  if (exercise.kind == ExerciseKind::kGrasp) return {block_bar(view)};
  if (exercise.kind != ExerciseKind::kTouch) return {};
  const bool gripping = status.cue == Cue::kGrip;
  WantedForce band = status.demand.band;
  if (gripping || band.high_n <= 0) band = {level.band_low_n, level.band_high_n};
  ForceBar tip = bar("Tip force", view.record.stylus.F_I_T.force.norm(), band, exercise.hard_force_n);
  tip.peak_n = status.peak_force_n;
  ForceBar grip = bar("Grip force", view.record.stylus.grip_force_n, {exercise.grip.low_n, exercise.grip.high_n},
                      exercise.grip.excess_n);
  if (level.force_display != "always") {
    const bool shown = level.force_display == "band" && status.force_shown;
    tip.hidden = gripping || !shown;
    grip.hidden = !gripping || !shown;
    tip.hidden_note = grip.hidden_note = hidden_note(level.force_display);
  }
  return {tip, grip};
}

/// Bandwidth feedback speaks up over the picture, where the trainee looks.
void add_band_notice(const SessionView& view, const std::vector<ForceBar>& bars, std::vector<HudNotice>& notices) {
  const DirectorStatus& status = view.director.status();
  if (view.scene.level.force_display != "band" || !status.force_shown) return;
  for (const ForceBar& bar : bars) {
    if (bar.hidden) continue;
    const std::string value = text("%.2f N", bar.value_n);
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

std::vector<HudRow> device_rows(const SessionView& view) {
  const Scene& scene = view.scene;
  std::vector<HudRow> out = {{"plant", "simulated", ""},
                             {"loop", text("%.0f", scene.loop.daq.rate_hz), "Hz"},
                             {"passivity", view.record.stylus.passivity_active ? "acting" : "ok", ""},
                             {"force scale", text("%.2f", scene.loop.map.force_scale), ""},
                             {"motor heat", text("%.0f", view.record.winding_c), "°C"}};
  if (scene.loop.map.fulcrum)
    out.push_back({"depth in port", text("%.0f", 1000 * view.record.stylus.depth_in_port_m), "mm"});
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
  if (!needs_organ(scene.setup.exercise.kind)) return "No organ, no patient data · board exercise in a box trainer";
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
  hud.bars = bars(view);
  if (status.demand.oriented) hud.dial = shown_dial(view, camera);
  add_map_notices(view.record.stylus, hud.notices);
  add_band_notice(view, hud.bars, hud.notices);
  hud.steps = steps(scene, status);
  hud.rows = rows(scene, status);
  hud.device = device_rows(view);
  hud.toast = status.message;
  hud.toast_hint = status.hint;
  hud.toast_warning = status.warning;
  hud.credit = credit(scene);
  return hud;
}

}  // namespace trocar
