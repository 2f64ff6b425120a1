// Where the discs of a board lie on the organ.
//
// Boards are drawn by their number alone: same organ, same exercise, same number, same board. Frame T, m. Thread:
// loading only.
#pragma once

#include <span>

#include "haptics/quantities.h"
#include "scenarios/director/director.h"
#include "scenarios/exercise.h"
#include "scenarios/layout/organ_placement.h"
#include "scenarios/layout/shaft_room.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Targets of one board on the placed organ, seen from above (topmost hit of the vertical line), in the order in which
/// they light. Each lies at least its radius and the wrong-place margin inside the region, within slope and relief,
/// min_spacing apart, on a surface that stays within reach of its tangent plane, and where the instrument has room.
/// On an organ too small for the exercise's spacing the targets move together, down to where their wrong-place rims
/// touch; the board says how far apart they are. An organ that has room is laid out as ever. Several bands of a level
/// are dealt out evenly, in an order drawn by the board.
/// @param room behind the instrument's tip; none: only the tip is asked for. @param strands_T that jaws are not to meet
/// @throws InputError when they do not fit, saying how many do, and whether the shaft is why.
Board lay_out_discs(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board,
                    const ShaftRoom* room = nullptr, std::span<const Vec3> strands_T = {});

}  // namespace trocar
