// What a scope sees that is itself the instrument: axes of the picture, its horizon, a sphere in it.
//
// C: x right, y down, z along the line of sight, origin at the lens = tip of the instrument. The camera head is fixed
// to the shaft: untilted C = I with right = y, up = x; a tilted tip looks below the shaft, R_IC = R_IC0 Rx(-tilt)
// (docs/decisions/0024-scope-as-instrument.md). Frame T, m, rad. Thread: pure.
#pragma once

#include <optional>

#include "haptics/quantities.h"

namespace trocar {

/// Axes of the picture in the instrument's frame.
Mat3 picture_in_instrument(double tilt_rad);

/// Where T's up lies in the picture, clockwise from 12 o'clock; empty while it looks straight up or down.
std::optional<double> horizon_of(const Mat3& R_TC);

/// Instrument with its shaft along `axis_T` and a level picture. @param axis_T unit, not vertical.
Mat3 level_instrument(const Vec3& axis_T);

}  // namespace trocar
