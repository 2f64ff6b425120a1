// How much a rod is bent and twisted between two neighbouring segments, and how that changes with them.
//
// Discrete elastic rods (Bergou et al. 2008, 2010): the curvature binormal kb = 2 t_a x t_b / (1 + t_a . t_b), of
// length 2 tan(phi / 2), read in the mean of both segments' material frames; the twist is the angle from the first
// frame, carried over to the second tangent by the smallest rotation, to the second frame. All integrated over the
// bend, so without unit. Frames are orthonormal, t along the segment, d1 x d2 = t. Thread: pure functions, any.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct SegmentFrame {
  Vec3 t = Vec3::UnitZ(), d1 = Vec3::UnitX(), d2 = Vec3::UnitY();
  double length_m = 1;
};

/// Components: curvature binormal along d2, along -d1; twist about t.
using BendStrain = Vec3;

/// Rows: the components of the strain.
struct BendGradient {
  Mat3 by_a, by_b;            ///< by the first and the second segment's edge vector, 1/m
  Vec3 by_turn_a, by_turn_b;  ///< by a turn of the material frame about its own tangent, 1/rad
};

/// A vector at right angles to `from`, carried over to one at right angles to `to` by the smallest rotation. Units.
Vec3 carried_over(const Vec3& d, const Vec3& from, const Vec3& to);

/// @param near_twist the last one, rad: the new one is that of its turns that is nearest
BendStrain bend_strain(const SegmentFrame& a, const SegmentFrame& b, double near_twist);
BendGradient bend_gradient(const SegmentFrame& a, const SegmentFrame& b, const BendStrain& strain);

}  // namespace trocar
