// Where the pens of reach-and-orient stand: tips on a spherical cap that opens upwards, axes turned from the resting
// instrument, or along the line to the port where there is one. Drawn by the board number alone.
//
// Cap: centre of the sphere above the region's centre, lowest point at -relief; polar angle uniform over its area. With
// a port the axis is not free: pen axis = (tip - port) / |tip - port|, only the roll about it is drawn. Frame T (origin
// at the region's centre). Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// @param R_TI_rest instrument while the device rests: pens are turned against it.
/// @throws InputError when the pens do not fit with their spacing.
Board lay_out_pens(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board);

}  // namespace trocar
