// Where the pegs and rings of a board stand, drawn by the board number: same exercise, level and number, same board.
//
// Two sides of rows and columns, mirrored about the board's middle; every ring begins on a peg of the left side. The
// board draws the gap between the sides, in which order the rings are asked for, to which peg each one goes and how it
// is turned. Frame T. Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// The peg of every transfer as targets in the order of lighting, first all across, then all back; the rings in
/// board.rigid in the order in which they are asked for, both times.
Board lay_out_pegs(const Exercise& exercise, const ExerciseLevel& level, int board);

}  // namespace trocar
