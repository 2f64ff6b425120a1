#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "app/picture/kinds/stage_parts.h"
#include "scenarios/kinds/retract/retract_rules.h"

namespace trocar {
namespace {

constexpr double kGoalRing = 0.016;  // m, across
constexpr double kTellingHeld = 0.3;

std::vector<ForceBar> retract_bars(const SessionView& view) {
  const RetractRules& rules = own_rules<RetractRules>(view.scene.setup.exercise);
  return pull_and_grip(view, {rules.grip_low_n, rules.grip_high_n});
}

}  // namespace

void add_lift_goal(const DirectorStatus& status, std::vector<SceneObject>& out) {
  if (status.cue != Cue::kTake && status.cue != Cue::kLift) return;
  SceneObject ring;
  ring.shape = SceneObject::Shape::kRing;
  ring.style = status.cue == Cue::kLift ? SceneObject::Style::kGhostLit : SceneObject::Style::kGhost;
  ring.size_m = {kGoalRing, kGoalRing, 0.001};
  ring.X_TO.p = status.demand.goal_T;
  out.push_back(ring);
}

KindPicture retract_picture() {
  return {.kind = ExerciseKind::kRetract,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Take, lift and hold the tissue", run.targets, run.started && !run.targets),
                                   hud_step("Let it down", run.done, run.targets && !run.done)};
              },
          .rows =
              [](const Scene&, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Exposed", hud_number("%.0f", 100 * status.exposure), "%"},
                                           {"Holds lost", std::to_string(status.wrong_places), "x"},
                                           hold_row(status)};
              },
          .bars = retract_bars,
          .add_objects = [](const SessionView& view,
                            std::vector<SceneObject>& out) { add_lift_goal(view.director.status(), out); },
          .work = [](const Scene&) { return Eigen::AlignedBox3d(); },
          .telling =
              [](const SessionView& view) {
                const DirectorStatus& status = view.director.status();
                return status.cue == Cue::kLift && status.hold_progress >= kTellingHeld;
              }};
}

}  // namespace trocar
