#include "tissue/rigid/collide.h"

#include <algorithm>

#include <fcl/fcl.h>

#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kThread = 1e-4;     // m, radius of the thread that stands for a capsule's axis
constexpr double kTolerance = 1e-9;  // m, of FCL's distance

fcl::Transform3d transform(const Pose& X) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  out.linear() = X.R;
  out.translation() = X.p;
  return out;
}

fcl::Transform3d along(const Vec3& middle, const Vec3& axis) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  if (axis.norm() > 0) out.linear() = least_turn(Vec3::UnitZ(), axis).toRotationMatrix();
  out.translation() = middle;
  return out;
}

fcl::Boxd box_of(const BoxShape& box) { return fcl::Boxd(fcl::Vector3d(2 * box.half)); }

fcl::Capsuled thread_of(const CapsuleShape& capsule) {
  return fcl::Capsuled(kThread, (capsule.to_T - capsule.from_T).norm());
}

/// FCL's normals point from the first to the second.
RigidContacts collected(const fcl::CollisionResultd& result) {
  RigidContacts out;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    out.add({contact.pos, -contact.normal, std::max(0.0, contact.penetration_depth)});
  }
  return out;
}

template <typename A, typename B>
RigidContacts overlap(const A& a, const fcl::Transform3d& X_a, const B& b, const fcl::Transform3d& X_b) {
  fcl::CollisionRequestd request(RigidContacts::kMost, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  fcl::collide(&a, X_a, &b, X_b, request, result);
  return collected(result);
}

struct Nearest {
  double distance = 0;  ///< of the axis, <= 0 when it enters the box
  Vec3 on_box = Vec3::Zero(), on_axis = Vec3::Zero();
};

Nearest nearest(const CapsuleShape& capsule, const BoxShape& box) {
  const fcl::DistanceRequestd request(true, false, 0, 0, kTolerance, fcl::GST_LIBCCD);
  fcl::DistanceResultd result;
  const fcl::Capsuled thread = thread_of(capsule);
  const fcl::Boxd solid = box_of(box);
  const double distance =
      fcl::distance(&thread, along((capsule.from_T + capsule.to_T) / 2, capsule.to_T - capsule.from_T), &solid,
                    transform(box.X_TB), request, result);
  if (distance <= 0) return {};
  const Vec3 away = (result.nearest_points[0] - result.nearest_points[1]).normalized();
  return {distance + kThread, result.nearest_points[1], result.nearest_points[0] - kThread * away};
}

}  // namespace

RigidContacts box_box(const BoxShape& a, const BoxShape& b) {
  if ((a.X_TB.p - b.X_TB.p).norm() > a.half.norm() + b.half.norm()) return {};
  return overlap(box_of(a), transform(a.X_TB), box_of(b), transform(b.X_TB));
}

RigidContacts capsule_box(const CapsuleShape& capsule, const BoxShape& box) {
  const Nearest near = nearest(capsule, box);
  RigidContacts out;
  if (near.distance > 0) {
    const double depth = capsule.radius_m - near.distance;
    if (depth > 0) out.add({near.on_box, (near.on_axis - near.on_box).normalized(), depth});
    return out;
  }
  const RigidContacts inside =
      overlap(thread_of(capsule), along((capsule.from_T + capsule.to_T) / 2, capsule.to_T - capsule.from_T),
              box_of(box), transform(box.X_TB));
  if (inside.count == 0) return out;
  RigidContact deepest = inside.at[0];
  deepest.depth_m += capsule.radius_m;
  out.add(deepest);
  return out;
}

RigidContacts box_plane(const BoxShape& box, double height_m) {
  RigidContacts out;
  if (box.X_TB.p.z() - box.half.norm() > height_m) return out;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = box.corner(i);
    if (corner.z() < height_m) out.add({corner, Vec3::UnitZ(), height_m - corner.z()});
  }
  return out;
}

RigidContacts capsule_plane(const CapsuleShape& capsule, double height_m) {
  RigidContacts out;
  for (const Vec3& end : {capsule.from_T, capsule.to_T}) {
    const double depth = height_m + capsule.radius_m - end.z();
    if (depth > 0) out.add({end - capsule.radius_m * Vec3::UnitZ(), Vec3::UnitZ(), depth});
  }
  return out;
}

RigidContacts box_cylinder(const BoxShape& box, const CylinderShape& cylinder) {
  return overlap(box_of(box), transform(box.X_TB), fcl::Cylinderd(cylinder.radius_m, cylinder.length_m),
                 along(cylinder.centre_T, cylinder.axis_T));
}

double axis_distance(const CapsuleShape& capsule, const BoxShape& box) { return nearest(capsule, box).distance; }

}  // namespace trocar
