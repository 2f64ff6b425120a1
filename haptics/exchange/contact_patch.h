// The part of the tissue that the haptic loop needs until the next patch: triangles near the tool and what
// they are made of.
//
// Extracted by the tissue task (tissue/collision/patch_extraction.h) within kPatchRadius of the tool, read by the
// contact stage of the tick. A new content has a new stamp. Frame T, metres. Fixed size: copying it allocates nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/exchange/patch_balls.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxPatchMaterials = 8;
inline constexpr double kPatchRadius = 0.025;  ///< m from the axes of the tool

/// Local elasticity, damping and dry friction of a surface.
struct ContactMaterial {
  double stiffness_n_per_m = 150;
  double damping_s_per_m = 0.5;  ///< Hunt-Crossley factor on the approach speed
  double mu_static = 0;          ///< Coulomb; 0: frictionless
  double mu_dynamic = 0;         ///< <= mu_static
  double stribeck_m_s = 0.005;   ///< slip speed over which static friction fades
};

struct PatchTriangle {
  std::array<Vec3, 3> vertex;  ///< counter-clockwise from outside
  Vec3 normal;                 ///< unit, outward
  std::int32_t id = -1;        ///< names the piece of surface: equal from patch to patch
  std::int32_t material = 0;   ///< index into ContactPatch::material
};

/// What lies between the jaws: a block of given thickness and stiffness; absent when stiffness is 0.
struct GripBlock {
  double thickness_m = 0;
  double stiffness_n_per_m = 0;
};

/// What the jaws carry, as a capsule that touches like the instrument itself; absent when its radius is 0. Frame I.
struct HeldObject {
  Vec3 from_I = Vec3::Zero(), to_I = Vec3::Zero();  ///< ends of the axis
  double radius_m = 0;
};

struct ContactPatch {
  std::uint64_t stamp = 0;        ///< tissue frame that made it
  std::int32_t count = 0;         ///< triangles in use
  std::int32_t dropped = 0;       ///< > 0: not all triangles within kPatchRadius fitted (reported, never silent)
  double reach_m = kPatchRadius;  ///< from the axes of the tool: every triangle nearer than this is in the patch
  std::array<PatchTriangle, kMaxPatchTriangles> triangle;
  std::array<ContactMaterial, kMaxPatchMaterials> material;
  GripBlock grip;
  HeldObject held;
  PatchBalls balls;  ///< enclose() last; a patch whose balls are not of its stamp and count does without, only slower
};

}  // namespace trocar
