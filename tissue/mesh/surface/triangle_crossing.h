// Whether two triangles meet in more than the corners and edges that they have in common.
//
// Exact predicates of CGAL, asked only where plain arithmetic with a wide margin leaves it open. Any length unit.
// Thread: any.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

/// A triangle whose corners are numbered: equal numbers are one point.
struct NumberedTriangle {
  std::array<std::int32_t, 3> corners{};
  std::array<Vec3, 3> points;
};

/// False for three points on a line (exact).
bool has_area(const NumberedTriangle& triangle);

/// @param a, b with area. Of the same corners they cross where they face alike: back to back they are a common border.
bool triangles_cross(NumberedTriangle a, NumberedTriangle b);

}  // namespace trocar
