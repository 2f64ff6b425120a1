// Closest points between a segment (or a point) and a triangle.
//
// Voronoi-region walk for the point (Ericson, Real-Time Collision Detection, 5.1.5 and 5.1.9); the segment adds its
// three edge pairs and the crossing test. Tolerances are relative to the shapes, so metres and millimetres agree.
// Thread: pure functions, any thread; no allocation.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

struct ClosestPair {
  double distance = 0;  ///< 0 when the segment crosses the triangle
  double along = 0;     ///< 0 at a, 1 at b: where on the segment
  Vec3 on_segment = Vec3::Zero();
  Vec3 on_triangle = Vec3::Zero();
  bool crossing = false;
};

/// Point of the triangle nearest to p.
Vec3 closest_point_on_triangle(const Vec3& p, const std::array<Vec3, 3>& triangle);

/// Nearest pair between segment a-b and the triangle.
ClosestPair closest_segment_triangle(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

}  // namespace trocar
