#include <algorithm>

#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"

namespace trocar {
namespace {

constexpr double kBlockWide = 0.008, kBlockLong = 0.010;  // m, along the hinge and the shaft
const Vec3 kBlockBlue(0.20, 0.42, 0.75);
constexpr double kTellingHold = 0.5;  // of a disc's hold, so that the force bar stands in its band

/// The tip's bar is that of the lit disc; the grip's that of the block. Where nothing is asked there is no band.
std::vector<ForceBar> touch_bars(const SessionView& view) {
  const Exercise& exercise = view.scene.setup.exercise;
  const ExerciseLevel& level = view.scene.level;
  const DirectorStatus& status = view.director.status();
  const JudgedForces limits = judged_forces(exercise, level, view.scene.board, status);
  const bool gripping = watched_now(exercise, status) == WatchedForce::kGrip;
  WantedForce band = status.demand.band;
  if (gripping || band.high_n <= 0) band = {level.band_low_n, level.band_high_n};
  const bool free = view.scene.board.targets.empty();
  ForceBar tip =
      force_bar("Tip force", view.record.stylus.F_I_T.force.norm(), free ? WantedForce{} : band, *limits.tip_n);
  tip.peak_n = status.peak_force_n;
  if (free && exercise.instruments.front() == InstrumentKind::kProbe) return {tip};
  const WantedForce wanted = free ? WantedForce{} : WantedForce{exercise.grip.low_n, exercise.grip.high_n};
  ForceBar grip = force_bar("Grip force", view.record.stylus.grip_force_n, wanted, *limits.grip_n);
  if (level.force_display != "always") {
    const bool shown = level.force_display == "band" && status.force_shown;
    tip.hidden = gripping || !shown;
    grip.hidden = !gripping || !shown;
    tip.hidden_note = grip.hidden_note = hidden_note(level.force_display);
  }
  return {tip, grip};
}

/// What is squeezed stands between the jaws' tips and goes with them.
void add_block(const SessionView& view, std::vector<SceneObject>& out) {
  const double thick = view.director.status().grip.thickness_m;
  if (thick <= 0) return;
  const StylusState& stylus = view.record.stylus;
  SceneObject block;
  block.look = SceneObject::Look::kFoam;
  block.colour = kBlockBlue;
  block.size_m = {kBlockWide, thick, kBlockLong};
  block.X_TO = {stylus.X_TI.R, stylus.X_TI.p - 0.25 * kBlockLong * stylus.X_TI.R.col(2)};
  block.pinch_depth_m = std::clamp(thick - stylus.jaw_opening_m, 0.0, 0.6 * thick);
  out.push_back(block);
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
          .add_objects = add_block,
          .work = [](const Scene&) { return Eigen::AlignedBox3d(); },
          .telling = [](const SessionView& view) { return view.director.status().hold_progress >= kTellingHold; }};
}

}  // namespace trocar
