// Where the ducts of a board run over the organ, and where they are to be named, clipped and cut.
//
// Boards are drawn by their number alone. The file draws the ducts in the plane across the resting shaft, x along the
// hinge of the jaws, y aside, z back along the shaft; a board turns them about the shaft, mirrors and shifts them, and
// lifts them clear of the tissue. Where z is below 0 a path dives so deep into the tissue beneath. Frame T, m. Thread:
// loading only.
#pragma once

#include <span>

#include "scenarios/director/director.h"
#include "scenarios/kinds/kind.h"

namespace trocar {

/// A place along a path. @param arc_m from its first point, within it.
struct PathPlace {
  Vec3 point_T = Vec3::Zero(), tangent_T = Vec3::UnitX();
};
PathPlace place_along(std::span<const Vec3> path_T, double arc_m);

/// @throws InputError: the organ has no tissue where a duct dives into it
Board lay_out_clips(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place);

}  // namespace trocar
