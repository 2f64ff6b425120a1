// Where the line lies on the gauze of a board, and where along it cuts are asked for.
//
// Boards are drawn by their number alone: the middle is shifted, the way in comes from another place of the free edge,
// the line is followed one way or the other; an ellipse is turned. Frame T, m. Thread: loading only.
#pragma once

#include <bitset>

#include "scenarios/director/director.h"
#include "scenarios/kinds/kind.h"
#include "tissue/tissue_frame.h"

namespace trocar {

/// Places along the line, one a step: from the edge in, then all round; steps of a long line are longer. The board's
/// own is a GauzeBoard.
/// Where a place of the line lies now: moved as the steps beside it are.
/// @param done of the steps: cut past. @param drawn_T of the place, as the gauze was spread. @param share of the line,
/// in which it lies
Vec3 on_gauze_now_T(const std::vector<Target>& steps, const std::bitset<32>& done, const TissueFrame* frame,
                    const Vec3& drawn_T, double share);

Board lay_out_gauze(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place);

/// The instrument over a place of the line: its shaft through the port, if there is one, its blades along the line.
/// @param turned_rad by which it was rolled at the place before, from where it needs no roll; that of this one is told
Mat3 blades_along(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& place_T, const Vec3& along_T,
                  double& turned_rad);

}  // namespace trocar
