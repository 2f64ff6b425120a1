// Where the cups of camera navigation stand: for each a pose of the scope is drawn that the device reaches, and the cup
// is put where that scope looks, its axis along the line of sight. Drawn by the board number alone.
//
// Lens uniform in the region; shaft swung from the resting one, or along the line from the port; picture level. Line of
// sight not steeper than the rules have it, spheres, cups and ways between clear of each other and of the plate. Frame
// T (origin at the region's centre). Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Targets: the lens's place and the instrument's orientation there (cup.h says where the cup is). Rigid: the plate.
/// @param R_TI_rest instrument while the device rests.
/// @throws InputError when the cups do not fit.
Board lay_out_cups(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board);

}  // namespace trocar
