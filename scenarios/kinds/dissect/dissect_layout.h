// Where the strands and the bleeding vessels of a board lie.
//
// Frame T, m. The same board number on the same organ gives the same board. Thread: pure functions.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/kinds/kind.h"
#include "tissue/interaction/bleeder_setup.h"

namespace trocar {

/// Strands run across the foot of the resting hook, or that of a hook through the port, in two rows of three of which
/// one place stays free, all over a bed that the board shifts; each is turned a little. Their ends are vertices of the
/// organ. Vessels lie in the bed, at least the exercise's spacing apart.
/// @throws InputError: the organ has no such place
Board lay_out_dissection(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place);

/// The vessels of the board, for its world, those of an operation stage by stage; empty: the exercise has none.
std::vector<BleederSetup> bleeders_of(const Exercise& exercise, const Board& board);

}  // namespace trocar
