// The part of the tissue that the haptic loop needs until the next patch: triangles near the tool and what
// they are made of.
//
// Extracted by the tissue task (tissue/collision/patch_extraction.h) within kPatchRadius of the tool, read by the
// contact stage of the tick. A new content has a new stamp. The triangles share vertices; where nothing moves no
// velocity is filled in or read. Tissue that deforms gives the surface as it would be without the tool's own dent, and
// with it the stiffness of that dent: so that the force is right where the tool was, and its slope until the next patch
// (docs/tissue.md). Frame T, metres. Fixed size: copying it allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/exchange/material_point.h"
#include "haptics/exchange/patch_balls.h"
#include "haptics/exchange/ring_on_wire.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxPatchMaterials = 8;
inline constexpr int kMaxPatchVertices = 3 * kMaxPatchTriangles;  ///< full never before the triangles are
inline constexpr double kPatchRadius = 0.025;                     ///< m from the axes of the tool

/// Local elasticity, damping and dry friction of a surface.
struct ContactMaterial {
  double stiffness_n_per_m = 150;
  double damping_s_per_m = 0.5;  ///< Hunt-Crossley factor on the approach speed
  double mu_static = 0;          ///< Coulomb; 0: frictionless
  double mu_dynamic = 0;         ///< <= mu_static
  double stribeck_m_s = 0.005;   ///< slip speed over which static friction fades
};

struct PatchTriangle {
  Vec3 normal;                           ///< unit, outward
  std::int32_t id = -1;                  ///< names the piece of surface: equal from patch to patch of one topology
  std::int32_t material = 0;             ///< index into ContactPatch::material
  std::array<std::int16_t, 3> corner{};  ///< indices into ContactPatch::vertex, counter-clockwise from outside
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

/// Tissue in the grip of the jaws: a spring from a point of the instrument to where the tissue would have it; absent
/// when its stiffness is 0.
struct GripHold {
  Vec3 point_I = Vec3::Zero(), anchor_T = Vec3::Zero();
  double stiffness_n_per_m = 0;
};

struct ContactPatch {
  std::uint64_t stamp = 0;        ///< tissue frame that made it
  std::uint64_t topology = 0;     ///< of the surface (SurfaceSnapshot): another one, and ids name other triangles
  std::int32_t count = 0;         ///< triangles in use
  std::int32_t vertex_count = 0;  ///< vertices in use
  std::int32_t dropped = 0;       ///< > 0: not all triangles within kPatchRadius fitted (reported, never silent)
  double reach_m = kPatchRadius;  ///< from the axes of the tool: every triangle nearer than this is in the patch
  bool moving = false;            ///< velocities are filled in; else nothing moves
  std::array<PatchTriangle, kMaxPatchTriangles> triangle;
  std::array<Vec3, kMaxPatchVertices> vertex;
  std::array<Vec3, kMaxPatchVertices> velocity;  ///< of each vertex, m/s; only where `moving`
  /// > 0: the vertices come from vertex - glide_s velocity, or from where the loop has them, and are at their places so
  /// long after the loop first sees the patch; there they stay. 0: they are there at once.
  double glide_s = 0;
  std::uint64_t follows = 0;                             ///< stamp of the patch that `previous` speaks of
  std::array<std::int16_t, kMaxPatchVertices> previous;  ///< where each vertex was in that patch, -1: not there
  double given_j = 0;  ///< energy that the tissue has lost in its step: what it may do on the tool beyond the tank
  std::array<ContactMaterial, kMaxPatchMaterials> material;
  GripBlock grip;
  HeldObject held;
  GripHold hold;
  RingOnWire ring;
  PatchBalls balls;  ///< enclose() last; a patch whose balls are not of its stamp and count does without, only slower

  /// Takes all triangles out.
  void clear() {
    count = vertex_count = dropped = 0;
    moving = false;
    glide_s = given_j = 0;
    hold = {};
    ring.count = 0;
  }
  /// Of the i-th triangle.
  std::array<Vec3, 3> corners(std::int32_t i) const { return at_corners(vertex, i); }
  /// Velocity of that point of the i-th triangle, m/s.
  Vec3 velocity_at(std::int32_t i, const Barycentric& weight) const {
    return moving ? interpolate(weight, at_corners(velocity, i)) : Vec3::Zero();
  }

 private:
  std::array<Vec3, 3> at_corners(const std::array<Vec3, kMaxPatchVertices>& value, std::int32_t i) const {
    const auto& [a, b, c] = triangle[static_cast<std::size_t>(i)].corner;
    return {value[a], value[b], value[c]};
  }
};

/// Appends a piece of surface that stands still; its triangles' ids count up from `first_id`. What finds no room is
/// counted in `dropped`.
void add_surface(ContactPatch& patch, std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles,
                 std::int32_t first_id, std::int32_t material);
/// The same of one triangle.
void add_triangle(ContactPatch& patch, const std::array<Vec3, 3>& vertex, std::int32_t id, std::int32_t material = 0);

}  // namespace trocar
