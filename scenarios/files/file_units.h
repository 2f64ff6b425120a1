// Units of exercise files in SI: keys end in _mm, _g and _deg.
#pragma once

#include <numbers>

namespace trocar::file_units {

inline constexpr double kMilli = 1e-3, kDegrees = std::numbers::pi / 180;

}  // namespace trocar::file_units
