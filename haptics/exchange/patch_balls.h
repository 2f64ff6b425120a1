// A ball round every triangle of the patch, in single precision and laid out for a quick look at all of them.
//
// The tissue task makes them with the patch, so that the tick need not read 512 triangles to find the few that matter.
// Centres are relative to `origin` and radii rounded up by more than single precision loses: a triangle is never
// outside its ball. Bounds only: no force depends on a digit of them. Frame T, m. Fixed size: copying allocates
// nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxPatchTriangles = 512;  ///< budget of the patch handed to the tick

struct ContactPatch;

struct PatchBalls {
  static constexpr int kBlock = 8;           ///< looked at together
  static constexpr float kRounding = 1e-6f;  ///< share of a length relative to `origin` that a radius is widened by
  using Lane = std::array<float, kMaxPatchTriangles>;
  static_assert(kMaxPatchTriangles % kBlock == 0);

  Vec3 origin = Vec3::Zero();
  alignas(16) Lane x{}, y{}, z{}, radius{};
  std::int32_t count = 0;   ///< balls in use
  std::uint64_t stamp = 0;  ///< of the patch that they were made for
};

/// Ball about the centroid, exact to rounding.
struct TriangleBall {
  Vec3 centre;
  double radius;
};
TriangleBall ball_round(const std::array<Vec3, 3>& triangle);

/// Balls round all triangles of a patch whose content and stamp are final. Thread: any; no allocation.
void enclose(const ContactPatch& patch, PatchBalls& balls);

}  // namespace trocar
