#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "app/picture/kinds/stage_parts.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "scenarios/kinds/operation/stage_range.h"
#include "scenarios/kinds/retract/retract_rules.h"

namespace trocar {
namespace {

/// One of the stages, with what it has of the run.
struct StageView {
  const ExerciseStage& stage;
  const ExerciseLevel& level;
  const Board& board;
  StageRange range;
  DirectorStatus status;  ///< in its numbers
};

std::vector<StageView> stages_of(const Scene& scene, const DirectorStatus& status) {
  std::vector<StageView> out;
  const Exercise& exercise = scene.setup.exercise;
  for (const StageRange& range : stage_ranges(exercise, scene.board)) {
    const auto i = static_cast<std::size_t>(range.stage);
    out.push_back({exercise.stages[i], scene.level.stages[i], scene.board.stages[i], range, status_of(range, status)});
  }
  return out;
}

void add_of_stages(const SessionView& view, std::vector<SceneObject>& out) {
  for (const StageView& of : stages_of(view.scene, view.director.status())) {
    const Exercise& exercise = *of.stage.exercise;
    if (exercise.kind == ExerciseKind::kClip) add_clip_places(exercise, of.level, of.board, of.status, out);
    if (of.status.target_index < 0) continue;
    if (exercise.kind == ExerciseKind::kDissect) add_lit_strand(of.board, of.status, out);
    if (exercise.kind == ExerciseKind::kRetract) add_lift_goal(of.status, out);
  }
}

/// Discs where tissue is to be taken, and the lit vessel: under strands and ducts they would be taken for places to be
/// touched.
void keep_discs(const SessionView& view, std::vector<TargetMark>& discs) {
  const DirectorStatus& status = view.director.status();
  const std::vector<StageRange> ranges = stage_ranges(view.scene.setup.exercise, view.scene.board);
  for (std::size_t i = discs.size(); i-- > 0;) {
    const auto object = static_cast<int>(i);
    const StageRange* range = stage_with(ranges, object);
    const bool lit = object == status.target_index;
    const ExerciseKind kind = view.scene.setup.exercise.stages[static_cast<std::size_t>(range->stage)].exercise->kind;
    const bool now = stage_with(ranges, status.target_index) == range;
    if ((kind == ExerciseKind::kRetract && now) || (lit && status.cue == Cue::kSeal)) continue;
    discs.erase(discs.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

std::vector<ForceBar> bars_of_stage(const SessionView& view) {
  for (const StageView& of : stages_of(view.scene, view.director.status())) {
    if (of.status.target_index < 0) continue;
    const Exercise& exercise = *of.stage.exercise;
    if (exercise.kind == ExerciseKind::kRetract) {
      const RetractRules& rules = own_rules<RetractRules>(exercise);
      return pull_and_grip(view, {rules.grip_low_n, rules.grip_high_n});
    }
    if (exercise.kind == ExerciseKind::kClip) {
      const ClipRules& rules = own_rules<ClipRules>(exercise);
      return tip_bar(view, "Pull", {rules.pull_low_n, rules.pull_high_n});
    }
    return tip_bar(view, "Force", {0, exercise.soft_force_n});
  }
  return tip_bar(view, "Force", {0, view.scene.setup.exercise.soft_force_n});
}

std::vector<HudRow> stage_rows(const Scene& scene, const DirectorStatus& status) {
  std::vector<HudRow> out;
  for (const StageView& of : stages_of(scene, status))
    out.push_back({of.stage.exercise->title, of_count(of.status, 0, of.range.objects), ""});
  out.push_back({"Mistakes", std::to_string(status.wrong_places), "x"});
  out.push_back(hold_row(status));
  return out;
}

Eigen::AlignedBox3d all_places(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& target : scene.board.targets) box.extend(target.centre_T);
  for (const std::vector<Vec3>& path : scene.board.ducts_T)
    for (const Vec3& point : path) box.extend(point);
  return box;
}

}  // namespace

KindPicture operation_picture() {
  return {
      .kind = ExerciseKind::kOperation,
      .steps =
          [](const RunStage& run) {
            return std::vector{hud_step("Retract, dissect, clip and cut, detach", run.done, run.started && !run.done)};
          },
      .rows = stage_rows,
      .bars = bars_of_stage,
      .add_objects = add_of_stages,
      .work = all_places,
      .telling =
          [](const SessionView& view) {
            const DirectorStatus& status = view.director.status();
            return status.cue == Cue::kSever && view.tissue && view.tissue->touched_duct >= 0;
          },
      .add_marks = keep_discs};
}

}  // namespace trocar
