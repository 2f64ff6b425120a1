#include "scenarios/kinds/camera/camera_kind.h"

#include "scenarios/director/scoring_context.h"
#include "scenarios/kinds/camera/camera_reader.h"
#include "scenarios/kinds/camera/camera_task.h"
#include "scenarios/kinds/camera/cup_layout.h"

namespace trocar {
namespace {

Board lay_out_camera(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_cups(exercise, level, place.R_TI_rest, board);
}

std::vector<std::unique_ptr<ExerciseTask>> camera_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                        const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  tasks.push_back(std::make_unique<CameraTask>(exercise, level, board.targets));
  return tasks;
}

}  // namespace

KindDescription camera_kind() {
  return {.kind = ExerciseKind::kCamera,
          .name = "camera",
          .on_organ = false,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kProbe,
          .watched = WatchedForce::kNone,
          .read = read_camera,
          .read_level = read_camera_level,
          .lay_out = lay_out_camera,
          .tasks = camera_tasks,
          .account = account_held_targets};
}

}  // namespace trocar
