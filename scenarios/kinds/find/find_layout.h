// Where a board has the flap taken, what it hides beneath it, and where answers are told.
//
// Boards are drawn by their number alone. Frame T, m. Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Places along the flap's free edge, in a drawn order: one a pin. Each pin lies somewhere beneath the flap and bears
/// one of the symbols, each as likely as any other; which ball of the row stands for which symbol is drawn too.
/// The board's own is a FindBoard. @throws InputError when the organ is not all beneath the flap
Board lay_out_find(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board);

}  // namespace trocar
