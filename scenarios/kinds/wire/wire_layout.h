// How the wire of ring-on-wire lies, where its gates are, and where the ring is in the instrument. Drawn by the board
// number alone.
//
// Four straight legs and three bends between them, up and down in turn, in a plane that faces the trainee: there the
// ring follows the wire by rolling the stylus. Through a port the same line lies on the sphere round the port through
// the region's centre: at right angles to every shaft, so that rolling the shaft brings the ring across it there too.
// A gate is a pose of the tip: the ring round the wire, its normal along it. Frame T (origin at the region's centre),
// m, rad. Thread: loading only.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// @param R_TI_rest instrument while the device rests: from it gates are turned by the least.
/// @throws InputError when no wire of that length fits into the region.
Board lay_out_wire(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board);

/// The ring at the tip, without the wire: its centre as far ahead that its bar passes through the tip.
RingOnWire ring_of(const Exercise& exercise, const ExerciseLevel& level);

/// Length of the line up to each of its points, m.
std::vector<double> arc_lengths(const std::vector<Vec3>& line);

/// Of evenly spaced gates along a wire, m from its beginning; none lies at an end.
std::vector<double> gate_places(int count, double length_m);

}  // namespace trocar
