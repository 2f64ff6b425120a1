// Where the nodules of a board are hidden in the organ.
//
// Boards are drawn by their number alone: same organ, same exercise, same number, same board. Frame T, m. Thread:
// loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"
#include "scenarios/layout/shaft_room.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Nodules in the order of the exercise's, then what is nothing to be marked. Each lies under a place as discs are laid
/// out (disc_layout.h), inwards along the surface's normal; the board has no target that could be seen.
/// @throws InputError when they do not fit.
Board lay_out_nodules(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board,
                      const ShaftRoom* room = nullptr);

/// From a place on the surface to the nodule along the surface, m: the rest of the way once its depth is gone. @param
/// plan of that nodule
double off_along_surface(const Vec3& place_T, const HiddenNodule& nodule, double top_m);

}  // namespace trocar
