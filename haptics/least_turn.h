// The least turn between two directions. Eigen's own template brings a singular value decomposition into every file
// that names it, seconds of compiling each: it is compiled here, once. Thread: any; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

/// Turns direction `from` into direction `to` about the axis across both; neither need be of unit length, neither zero.
Eigen::Quaterniond least_turn(const Vec3& from, const Vec3& to);

}  // namespace trocar
