// What the stages of an operation show as the exercises do that they are made of. Frame T, m. Thread: any.
#pragma once

#include <vector>

#include "app/picture/scene/scene_object.h"
#include "scenarios/director/director.h"

namespace trocar {

/// The height to which tissue shall come: a ring round where the tip shall be.
void add_lift_goal(const DirectorStatus& status, std::vector<SceneObject>& out);
/// A ring round the lit strand, which it passes through, and where the tip shall be lifted to.
void add_lit_strand(const Board& board, const DirectorStatus& status, std::vector<SceneObject>& out);
/// What holds duct and artery, and rings round where clips and cuts are asked for, while they are not there.
void add_clip_places(const Exercise& exercise, const ExerciseLevel& level, const Board& board,
                     const DirectorStatus& status, std::vector<SceneObject>& out);

}  // namespace trocar
