// Where the blocks and rings of a board stand, drawn by the board number: same exercise, level and number, same board.
//
// Blocks stand in rows and columns on the left half of the board, each ring carry_m to the right of its block. The
// board draws in which order they light, which foam each one is, and, where the level says so, how they are turned and
// shifted. Frame T. Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Rings as targets in the order of lighting, with their blocks in board.rigid in the same order.
Board lay_out_blocks(const Exercise& exercise, const ExerciseLevel& level, int board);

}  // namespace trocar
