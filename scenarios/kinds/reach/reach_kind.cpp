#include "scenarios/kinds/reach/reach_kind.h"

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/reach/pen_layout.h"
#include "scenarios/kinds/reach/pose_task.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

void read_pens(StrictTable table, PenRules& pens) {
  pens.shell_radius_m = table.number("shell_radius_mm", 10, 500) * kMilli;
  pens.cap_rad = table.number("cap_deg", 5, 90) * kDegrees;
  pens.tilt_rad = table.number("tilt_deg", 0, 60) * kDegrees;
  pens.roll_rad = table.number("roll_deg", 0, 180) * kDegrees;
  pens.length_m = table.number("length_mm", 5, 200) * kMilli;
  pens.radius_m = table.number("diameter_mm", 0.5, 50) / 2 * kMilli;
  pens.timeout_s = table.number("timeout_s", 1, 600);
  table.finish();
}

void read_reach(StrictTable& document, Exercise& exercise) {
  exercise.hold_s = document.number("hold_s", 0.05, 60);
  read_pens(document.table("pens"), exercise.pens);
  if (exercise.pens.timeout_s <= exercise.hold_s)
    document.fail("hold_s", "'hold_s' must be below 'timeout_s' of the pens");
}

void read_reach_level(LevelKeys& keys, const Exercise&, ExerciseLevel& level) {
  keys.number("position_tolerance_mm", 0.1, 20, kMilli, level.position_tolerance_m);
  keys.number("angle_tolerance_deg", 0.5, 45, kDegrees, level.angle_tolerance_rad);
}

Board lay_out_reach(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_pens(exercise, level, place.R_TI_rest, board);
}

std::vector<std::unique_ptr<ExerciseTask>> reach_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                       const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  tasks.push_back(std::make_unique<PoseTask>(exercise, level, board.targets));
  return tasks;
}

}  // namespace

KindDescription reach_kind() {
  return {.kind = ExerciseKind::kReach,
          .name = "reach",
          .on_organ = false,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kProbe,
          .watched = WatchedForce::kNone,
          .read = read_reach,
          .read_level = read_reach_level,
          .lay_out = lay_out_reach,
          .tasks = reach_tasks,
          .account = account_held_targets};
}

}  // namespace trocar
