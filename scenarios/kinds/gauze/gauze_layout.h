// Where the line lies on the gauze of a board, and where along it cuts are asked for.
//
// Boards are drawn by their number alone: the middle is shifted, the way in comes from another place of the free edge,
// the line is followed one way or the other; an ellipse is turned. Frame T, m. Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/kinds/kind.h"

namespace trocar {

/// Places along the line, one a step: from the edge in, then all round; steps of a long line are longer. The board's
/// own is a GauzeBoard.
Board lay_out_gauze(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place);

/// The instrument over a place of the line: its shaft through the port, if there is one, its blades along the line.
/// @param turned_rad by which it was rolled at the place before, from where it needs no roll; that of this one is told
Mat3 blades_along(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& place_T, const Vec3& along_T,
                  double& turned_rad);

}  // namespace trocar
