#include "app/picture/kinds/hud_parts.h"

#include <cstdio>

#include "scenarios/kinds/kind.h"

namespace trocar {

std::string hud_number(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

HudStep hud_step(const char* words, bool done, bool current) {
  return {words, done ? HudStep::State::kDone : current ? HudStep::State::kCurrent : HudStep::State::kOpen};
}

std::string targets_done(const Scene& scene, const DirectorStatus& status) {
  return std::to_string(status.targets_done) + " / " + std::to_string(scene.board.targets.size());
}

std::string of_count(const DirectorStatus& status, int from, int to) {
  int done = 0;
  for (int i = from; i < to; ++i) done += status.done[static_cast<std::size_t>(i)];
  return std::to_string(done) + " / " + std::to_string(to - from);
}

HudRow hold_row(const DirectorStatus& status) {
  return {"Hold", hud_number("%.0f", 100 * status.hold_progress), "%", true};
}

ForceBar force_bar(const char* label, double value_n, const WantedForce& band, double limit_n) {
  ForceBar out;
  out.label = label;
  out.value_n = value_n;
  out.band_low_n = band.low_n;
  out.band_high_n = band.high_n;
  out.limit_n = limit_n;
  out.full_scale_n = 1.25 * limit_n;
  return out;
}

std::string hidden_note(const std::string& display) {
  return display == "after" ? "shown after the run" : "shown only outside the limits";
}

std::vector<ForceBar> grip_of_lit_object(const SessionView& view) {
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  const JudgedForces limits = judged_forces(view.scene.setup.exercise, level, view.scene.board, status);
  ForceBar grip = force_bar("Grip force", view.record.stylus.grip_force_n, status.demand.band, *limits.grip_n);
  grip.hidden = !status.force_shown;
  grip.hidden_note = hidden_note(level.force_display);
  return {grip};
}

std::vector<ForceBar> tip_bar(const SessionView& view, const char* label, const WantedForce& band) {
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  const JudgedForces limits = judged_forces(view.scene.setup.exercise, level, view.scene.board, status);
  ForceBar tip = force_bar(label, view.record.stylus.F_I_T.force.norm(), band, *limits.tip_n);
  tip.peak_n = status.peak_force_n;
  tip.hidden = level.force_display != "always" && !status.force_shown;
  tip.hidden_note = hidden_note(level.force_display);
  return {tip};
}

std::vector<ForceBar> pull_and_grip(const SessionView& view, const WantedForce& grip_band) {
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  const JudgedForces limits = judged_forces(view.scene.setup.exercise, level, view.scene.board, status);
  ForceBar pull =
      force_bar("Pull", view.record.stylus.F_I_T.force.norm(), {level.band_low_n, level.band_high_n}, *limits.tip_n);
  pull.peak_n = status.peak_force_n;
  ForceBar grip = force_bar("Grip force", view.record.stylus.grip_force_n, grip_band, *limits.grip_n);
  if (level.force_display != "always") {
    pull.hidden = grip.hidden = level.force_display == "after" || !status.force_shown;
    pull.hidden_note = grip.hidden_note = hidden_note(level.force_display);
  }
  return {pull, grip};
}

}  // namespace trocar
