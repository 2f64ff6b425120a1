// Contact points between rigid primitives: boxes, capsules, cylinders, triangular rings, the plane of the board.
//
// What meets a ring is in closed form: signed distance of points of an axis from a prism with a round hole, exact
// outside. Box against box, capsule against box and box against cylinder by FCL (kept in the source); against a
// horizontal plane in closed form, because FCL gives one point where a resting box needs four. A capsule is asked for
// the distance of its axis (as a thread of 0.1 mm), so overlaps up to its radius are exact to 3 um; FCL's own depth of
// a capsule is not. Frame T, m. Thread: tissue task; FCL allocates.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

struct BoxShape {
  Pose X_TB;                 ///< centre, axes along the edges
  Vec3 half = Vec3::Zero();  ///< half extents

  Vec3 corner(int index) const {
    const Vec3 sign(index & 1 ? 1 : -1, index & 2 ? 1 : -1, index & 4 ? 1 : -1);
    return X_TB * Vec3(sign.cwiseProduct(half));
  }
};

struct CapsuleShape {
  Vec3 from_T = Vec3::Zero(), to_T = Vec3::Zero();  ///< ends of the axis
  double radius_m = 0;
};

struct CylinderShape {
  Vec3 centre_T = Vec3::Zero(), axis_T = Vec3::UnitZ();
  double radius_m = 0, length_m = 0;
};

/// A prism over an equilateral triangle with a round hole along its axis (B's z through the triangle's middle, one side
/// towards B's -y): the ring of a peg transfer.
struct RingShape {
  Pose X_TB;
  double side_distance_m = 0;  ///< of the triangle's sides from the axis; its corners are twice as far
  double half_height_m = 0, hole_radius_m = 0;

  /// The three lower corners, then the three upper ones, counter-clockwise from above.
  Vec3 corner(int index) const;
};

/// Where two things overlap. The normal points from the second to the first.
struct RigidContact {
  Vec3 point_T = Vec3::Zero(), normal_T = Vec3::UnitZ();
  double depth_m = 0;
};

struct RigidContacts {
  static constexpr int kMost = 8;
  std::array<RigidContact, kMost> at;
  int count = 0;
  void add(const RigidContact& contact) {
    if (count < kMost) at[static_cast<std::size_t>(count++)] = contact;
  }
};

RigidContacts box_box(const BoxShape& a, const BoxShape& b);
/// Capsule first. At most one point.
RigidContacts capsule_box(const CapsuleShape& capsule, const BoxShape& box);
/// Box first, the half space below height_m second: every corner below.
RigidContacts box_plane(const BoxShape& box, double height_m);
/// Capsule first: at most both ends.
RigidContacts capsule_plane(const CapsuleShape& capsule, double height_m);
/// Box first, solid cylinder second.
RigidContacts box_cylinder(const BoxShape& box, const CylinderShape& cylinder);

/// Capsule first. At most one point in each half of the ring's height.
RigidContacts capsule_ring(const CapsuleShape& capsule, const RingShape& ring);
/// Where edges of one are in the other. @param skin_m distance that still counts as touching.
RigidContacts ring_ring(const RingShape& a, const RingShape& b, double skin_m);
/// Ring first, as box_plane().
RigidContacts ring_plane(const RingShape& ring, double height_m);

/// Distance of the capsule's axis from the box; 0 or less when it enters the box.
double axis_distance(const CapsuleShape& capsule, const BoxShape& box);

}  // namespace trocar
