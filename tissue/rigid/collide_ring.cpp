#include <algorithm>
#include <array>
#include <cmath>

#include "tissue/rigid/collide.h"

namespace trocar {
namespace {

constexpr double kAlong = 0.002;  // m between the points of an axis that are looked at
constexpr int kCorners = 3;

using Vec2 = Eigen::Vector2d;

/// Signed distance, < 0 inside, and where it grows fastest.
struct FarOff {
  double distance_m = 0;
  Vec3 away = Vec3::UnitZ();
};

/// Outward normal of a side of the triangle.
Vec2 side_normal(int side) {
  const double angle = -M_PI / 2 + side * 2 * M_PI / kCorners;
  return {std::cos(angle), std::sin(angle)};
}

Vec2 corner_of(int index, double side_distance_m) {
  const double angle = -M_PI * 5 / 6 + index * 2 * M_PI / kCorners;
  return 2 * side_distance_m * Vec2(std::cos(angle), std::sin(angle));
}

/// In the plane of the ring.
FarOff off_outline(const Vec2& at, const RingShape& ring) {
  const double radius = at.norm();
  const Vec2 to_axis = radius > 1e-12 ? Vec2(-at / radius) : Vec2::UnitX();
  const FarOff hole{ring.hole_radius_m - radius, Vec3(to_axis.x(), to_axis.y(), 0)};
  if (hole.distance_m >= 0) return hole;
  int side = 0;
  for (int k = 1; k < kCorners; ++k)
    if (side_normal(k).dot(at) > side_normal(side).dot(at)) side = k;
  const Vec2 normal = side_normal(side);
  const double beyond = normal.dot(at) - ring.side_distance_m;
  const FarOff flat{beyond, Vec3(normal.x(), normal.y(), 0)};
  if (beyond <= 0) return beyond > hole.distance_m ? flat : hole;
  const Vec2 from = corner_of(side, ring.side_distance_m), to = corner_of((side + 1) % kCorners, ring.side_distance_m);
  const double share = std::clamp((at - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
  const Vec2 off = at - (from + share * (to - from));
  return {off.norm(), Vec3(off.x(), off.y(), 0) / std::max(1e-12, off.norm())};
}

FarOff off_ring(const Vec3& at_B, const RingShape& ring) {
  const FarOff level = off_outline(at_B.head<2>(), ring);
  const FarOff upright{std::abs(at_B.z()) - ring.half_height_m, Vec3(0, 0, at_B.z() < 0 ? -1 : 1)};
  if (level.distance_m <= 0 && upright.distance_m <= 0) return level.distance_m > upright.distance_m ? level : upright;
  const Vec3 off = std::max(0.0, level.distance_m) * level.away + std::max(0.0, upright.distance_m) * upright.away;
  return {off.norm(), off / std::max(1e-12, off.norm())};
}

}  // namespace

Vec3 RingShape::corner(int index) const {
  const Vec2 level = corner_of(index % kCorners, side_distance_m);
  return X_TB * Vec3(level.x(), level.y(), index < kCorners ? -half_height_m : half_height_m);
}

RigidContacts capsule_ring(const CapsuleShape& capsule, const RingShape& ring) {
  const Pose X_BT = ring.X_TB.inverse();
  const Vec3 from = X_BT * capsule.from_T, way = X_BT * capsule.to_T - from;
  const double reach = ring.half_height_m + capsule.radius_m;
  double first = 0, last = 1;  // of the axis, near enough to the ring in height
  if (std::abs(way.z()) > 1e-9) {
    const double low = (-reach - from.z()) / way.z(), high = (reach - from.z()) / way.z();
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  } else if (std::abs(from.z()) > reach) {
    return {};
  }
  if (first > last) return {};
  std::array<RigidContact, 2> deepest;  // in the lower half, in the upper half
  const auto look_at = [&](double share) {
    const Vec3 at = from + std::clamp(share, first, last) * way;
    const FarOff off = off_ring(at, ring);
    RigidContact& known = deepest[at.z() < 0 ? 0 : 1];
    const double depth = capsule.radius_m - off.distance_m;
    if (depth > known.depth_m) known = {ring.X_TB * (at - off.distance_m * off.away), ring.X_TB.R * off.away, depth};
  };
  const int steps = std::max(1, static_cast<int>(std::ceil((last - first) * way.norm() / kAlong)));
  for (int k = 0; k <= steps; ++k) look_at(first + (last - first) * k / steps);
  if (std::abs(way.z()) > 1e-9) {  // at its rims
    look_at((-ring.half_height_m - from.z()) / way.z());
    look_at((ring.half_height_m - from.z()) / way.z());
  }
  RigidContacts out;
  for (const RigidContact& contact : deepest)
    if (contact.depth_m > 0) out.add(contact);
  return out;
}

RigidContacts ring_ring(const RingShape& a, const RingShape& b, double skin_m) {
  RigidContacts out;
  const double reach =
      std::hypot(2 * a.side_distance_m, a.half_height_m) + std::hypot(2 * b.side_distance_m, b.half_height_m);
  if ((a.X_TB.p - b.X_TB.p).norm() > reach + skin_m) return out;
  const auto edges_in = [&](const RingShape& ring, const RingShape& other, double sign) {
    for (int k = 0; k < kCorners; ++k) {
      const int next = (k + 1) % kCorners;
      const std::array<CapsuleShape, 3> edges{{{ring.corner(k), ring.corner(k + kCorners), skin_m},
                                               {ring.corner(k), ring.corner(next), skin_m},
                                               {ring.corner(k + kCorners), ring.corner(next + kCorners), skin_m}}};
      for (const CapsuleShape& edge : edges) {
        const RigidContacts touch = capsule_ring(edge, other);
        for (int c = 0; c < touch.count; ++c) {
          RigidContact contact = touch.at[static_cast<std::size_t>(c)];
          contact.normal_T *= sign;
          out.add(contact);
        }
      }
    }
  };
  edges_in(a, b, 1);
  edges_in(b, a, -1);
  return out;
}

RigidContacts ring_plane(const RingShape& ring, double height_m) {
  RigidContacts out;
  for (int i = 0; i < 2 * kCorners; ++i) {
    const Vec3 corner = ring.corner(i);
    if (corner.z() < height_m) out.add({corner, Vec3::UnitZ(), height_m - corner.z()});
  }
  return out;
}

}  // namespace trocar
