#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"

namespace trocar {
namespace {

constexpr double kTellingHold = 0.5;  // of a disc's hold, so that the force bar stands in its band

/// The tip's bar is that of the lit disc; the grip's that of the block.
std::vector<ForceBar> touch_bars(const SessionView& view) {
  const Exercise& exercise = view.scene.setup.exercise;
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  const JudgedForces limits = judged_forces(exercise, level, view.scene.board, status);
  const bool gripping = watched_now(exercise, status) == WatchedForce::kGrip;
  WantedForce band = status.demand.band;
  if (gripping || band.high_n <= 0) band = {level.band_low_n, level.band_high_n};
  ForceBar tip = force_bar("Tip force", view.record.stylus.F_I_T.force.norm(), band, *limits.tip_n);
  tip.peak_n = status.peak_force_n;
  ForceBar grip = force_bar("Grip force", view.record.stylus.grip_force_n, {exercise.grip.low_n, exercise.grip.high_n},
                            *limits.grip_n);
  if (level.force_display != "always") {
    const bool shown = level.force_display == "band" && status.force_shown;
    tip.hidden = gripping || !shown;
    grip.hidden = !gripping || !shown;
    tip.hidden_note = grip.hidden_note = hidden_note(level.force_display);
  }
  return {tip, grip};
}

}  // namespace

KindPicture touch_picture() {
  return {.kind = ExerciseKind::kTouch,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Touch and hold each disc", run.targets, run.started && !run.targets),
                                   hud_step("Squeeze the block", run.done, run.targets && !run.done)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                std::vector<HudRow> rows{{"Discs held", targets_done(scene, status), ""},
                                         {"Wrong places", std::to_string(status.wrong_places), ""},
                                         {"Too much force", std::to_string(status.excess_forces), "x"}};
                if (hold_shown(scene.setup.exercise, scene.level)) rows.push_back(hold_row(status));
                return rows;
              },
          .bars = touch_bars,
          .add_objects = [](const SessionView&, std::vector<SceneObject>&) {},
          .work = [](const Scene&) { return Eigen::AlignedBox3d(); },
          .telling = [](const SessionView& view) { return view.director.status().hold_progress >= kTellingHold; }};
}

}  // namespace trocar
