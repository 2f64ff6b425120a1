// Where the organ lies in the theatre, and where the discs of a board lie on the organ.
//
// Theatre T: z up = anterior (the patient lies supine), y = superior (towards the head), x = the patient's left; so
// from RAS image axes x_T = -x, y_T = z, z_T = y (a proper rotation). Boards are drawn by their number alone: same
// organ, same exercise, same number, same board. Thread: loading only.
#pragma once

#include "haptics/quantities.h"
#include "scenarios/director.h"
#include "scenarios/exercise.h"
#include "tissue/mesh/triangle_surface.h"

namespace trocar {

/// Pose X_TO of an organ (RAS axes, m) such that the middle of its best board region lies at T's origin on the surface:
/// the region_x by region_y patch, seen from above, with the most surface inside slope and relief limits.
/// @throws InputError when no point of the organ qualifies.
Pose place_organ(const TriangleSurface& organ_RAS, const TargetLayout& layout);

/// Targets of one board on the placed organ, seen from above (topmost hit of the vertical line), in the order in which
/// they light. Each lies at least its radius and the wrong-place margin inside the region, within slope and relief,
/// min_spacing apart, on a surface that stays within reach of its tangent plane.
/// On an organ too small for the exercise's spacing the targets move together, down to where their wrong-place rims touch; the
/// board says how far apart they are. An organ that has room is laid out as ever.
/// Several bands of a level are dealt out evenly, in an order drawn by the board.
/// @throws InputError when they do not fit, saying how many do.
Board lay_out_board(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board);

}  // namespace trocar
