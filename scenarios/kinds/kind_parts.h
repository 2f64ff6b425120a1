// What descriptions of kinds share (scenarios/kinds/kind.h). Thread: as there.
#pragma once

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/kind.h"

namespace trocar {

/// A run of one part alone.
template <class Task>
std::vector<std::unique_ptr<ExerciseTask>> one_task(const Exercise& exercise, const ExerciseLevel& level,
                                                    const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  tasks.push_back(std::make_unique<Task>(exercise, level, board));
  return tasks;
}

/// `hard_n` of the exercise is far too much of the tip's force.
JudgedForces judge_hard_force(const Exercise& exercise, const ExerciseLevel&, const Board&, int lit);

/// Places on an organ: `diameter_mm`, `max_slope_deg` of [targets].
void read_places(StrictTable& targets, TargetLayout& layout);

/// `tissue` of an exercise about what an organ does that gives way: one that stands still cannot be chosen.
void read_giving_tissue(StrictTable& document, Exercise& exercise);

}  // namespace trocar
