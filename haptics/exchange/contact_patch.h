// The part of the tissue that the haptic loop needs for the next period: triangles near the tool and their material.
//
// Extracted by the tissue task (tissue/collision/patch_extraction.h) within kPatchRadius of the tool, read by the
// contact stage of the tick. Frame T, metres. Fixed size: copying it allocates nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxPatchTriangles = 512;     ///< design/budgets: patch handed to the tick
inline constexpr double kPatchRadius = 0.025;      ///< m from the tool

struct PatchTriangle {
  std::array<Vec3, 3> vertex;   ///< counter-clockwise from outside
  Vec3 normal;                  ///< unit, outward
  std::int32_t id = -1;         ///< index in the surface
};

/// What lies between the jaws: a block of given thickness and stiffness; absent when stiffness is 0.
struct GripBlock {
  double thickness_m = 0;
  double stiffness_n_per_m = 0;
};

struct ContactPatch {
  std::uint64_t stamp = 0;            ///< tissue frame that made it
  std::int32_t count = 0;             ///< triangles in use
  std::int32_t dropped = 0;           ///< triangles in reach that did not fit (reported, never silent)
  std::array<PatchTriangle, kMaxPatchTriangles> triangle;
  double stiffness_n_per_m = 150;     ///< local elasticity of the surface
  double damping_s_per_m = 0.5;       ///< Hunt-Crossley factor on the approach speed
  GripBlock grip;
};

}  // namespace trocar
