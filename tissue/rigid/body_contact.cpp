#include "tissue/rigid/body_contact.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kCarryStep = 3e-4;  // m, well below the thinnest wall of a ring
constexpr int kMostCarrySteps = 100;
constexpr double kPlayKept = 0.75;
constexpr int kPushes = 8;  // out of peg after peg, in one step

RigidContact deepest_of(const std::vector<PegPost>& pegs, const RigidBody& body) {
  RigidContact deepest;
  const double reach = body.half.norm();
  for (const PegPost& peg : pegs) {
    if ((peg.foot_T - body.X_TB.p).head<2>().norm() > 2 * reach + peg.radius_m) continue;
    const RigidContacts touch = capsule_body(capsule_of(peg), body);
    for (int c = 0; c < touch.count; ++c)
      if (touch.at[static_cast<std::size_t>(c)].depth_m > deepest.depth_m)
        deepest = touch.at[static_cast<std::size_t>(c)];
  }
  return deepest;
}

}  // namespace

RigidContacts capsule_body(const CapsuleShape& capsule, const RigidBody& body) {
  return body.is_ring() ? capsule_ring(capsule, body.ring()) : capsule_box(capsule, body.shape());
}

RigidContacts body_body(const RigidBody& a, const RigidBody& b, double skin_m) {
  if (a.is_ring() && b.is_ring()) return ring_ring(a.ring(), b.ring(), skin_m);
  const Vec3 skin = Vec3::Constant(skin_m / 2);
  return box_box({a.X_TB, a.half + skin}, {b.X_TB, b.half + skin});
}

RigidContacts body_plane(const RigidBody& body, double height_m) {
  return body.is_ring() ? ring_plane(body.ring(), height_m) : box_plane(body.shape(), height_m);
}

double lowest(const RigidBody& body) {
  const int corners = body.is_ring() ? 6 : 8;
  double z = 1e9;
  for (int i = 0; i < corners; ++i)
    z = std::min(z, (body.is_ring() ? body.ring().corner(i) : body.shape().corner(i)).z());
  return z;
}

CapsuleShape capsule_of(const PegPost& peg) {
  return {peg.foot_T, peg.foot_T + Vec3(0, 0, peg.height_m - peg.radius_m), peg.radius_m};
}

/// A peg of thickness d, in a hole of width D along L of it, leans by t at most: D cos t - L sin t = d. Most of the
/// play is kept, so that what leans at most does not jam.
void turn_on_pegs(const std::vector<PegPost>& pegs, RigidBody& ring) {
  const Vec3 hole = ring.X_TB.R.col(2) * (ring.X_TB.R(2, 2) < 0 ? -1 : 1);
  const double lean = std::acos(std::min(1.0, hole.z()));
  for (const PegPost& peg : pegs) {
    if ((peg.foot_T - ring.X_TB.p).head<2>().norm() > ring.hole_radius_m) continue;
    const double lower = ring.X_TB.p.z() - ring.half.z() * hole.z();
    const double along = std::clamp(peg.foot_T.z() + peg.height_m - lower, 0.0, 2 * ring.half.z());
    const double width = 2 * ring.hole_radius_m, play = ring.hole_radius_m - peg.radius_m;
    const double filled = 2 * (peg.radius_m + kPlayKept * play);
    const double most = std::acos(filled / std::hypot(width, along)) - std::atan2(along, width);
    if (lean <= most) return;
    ring.X_TB.R = Eigen::AngleAxisd(lean - most, hole.cross(Vec3::UnitZ()).normalized()) * ring.X_TB.R;
    return;
  }
}

void carry_past(const std::vector<PegPost>& pegs, const Vec3& to_T, RigidBody& body) {
  if (pegs.empty()) {
    body.X_TB.p = to_T;
    return;
  }
  const Vec3 way = to_T - body.X_TB.p;
  const int steps = std::clamp(static_cast<int>(std::ceil(way.norm() / kCarryStep)), 1, kMostCarrySteps);
  for (int k = 0; k < steps; ++k) {
    body.X_TB.p += way / steps;
    for (int push = 0; push < kPushes; ++push) {
      const RigidContact touch = deepest_of(pegs, body);
      if (touch.depth_m < 1e-6) break;
      body.X_TB.p -= touch.depth_m * touch.normal_T;
    }
  }
}

}  // namespace trocar
