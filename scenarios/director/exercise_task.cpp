#include "scenarios/director/exercise_task.h"

#include <cstdio>

#include "scenarios/director/director_tasks.h"
#include "scenarios/kinds/grasp/grasp_task.h"
#include "scenarios/kinds/reach/pose_task.h"

namespace trocar {

void EventLog::add(const std::string& type, Severity severity, std::int32_t object, double value,
                   const std::string& unit) {
  events.push_back({t_s, type, severity, object, value, unit, tip_T});
}

void say(DirectorStatus& status, const std::string& message, const std::string& hint, bool warning) {
  status.message = message;
  status.hint = hint;
  status.warning = warning;
}

bool force_shown(const std::string& display, bool outside) {
  return display == "always" || (display == "band" && outside);
}

std::string band_text(const WantedForce& band) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f to %.1f N", band.low_n, band.high_n);
  return text;
}

std::vector<std::unique_ptr<ExerciseTask>> make_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                      const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  switch (exercise.kind) {
    case ExerciseKind::kTouch:
      tasks.push_back(std::make_unique<DiscTask>(exercise, level, board.targets));
      tasks.push_back(
          std::make_unique<SqueezeTask>(exercise.grip, level, static_cast<std::int32_t>(board.targets.size())));
      break;
    case ExerciseKind::kGrasp:
      tasks.push_back(std::make_unique<GraspTask>(exercise, level, board));
      break;
    case ExerciseKind::kReach:
      tasks.push_back(std::make_unique<PoseTask>(exercise, level, board.targets));
      break;
  }
  return tasks;
}

}  // namespace trocar
