// A material point of a surface: it moves with its triangle.
//
// Thread: pure functions, any thread; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

using Barycentric = std::array<double, 3>;  ///< weights of a triangle's corners, sum 1

struct MaterialPoint {
  std::int32_t triangle = -1;  ///< PatchTriangle::id; -1: none
  Barycentric weight{};
};

/// Of the foot of p in the triangle's plane; of a triangle without area {1, 0, 0}.
Barycentric barycentric_of(const Vec3& p, const std::array<Vec3, 3>& triangle);

/// The value at a point between those at the corners.
inline Vec3 interpolate(const Barycentric& b, const std::array<Vec3, 3>& at) {
  return b[0] * at[0] + b[1] * at[1] + b[2] * at[2];
}

}  // namespace trocar
