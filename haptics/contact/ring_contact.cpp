#include "haptics/contact/ring_contact.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kFlattest = 0.6;  // least |n.t| reckoned with: 53 deg between normal and wire
constexpr double kNothing = 1e-9;  // m

/// Unit tangent at a vertex: along the chord of its neighbours.
Vec3 tangent_at(std::span<const Vec3> line_T, std::size_t i) {
  const Vec3& before = line_T[i == 0 ? 0 : i - 1];
  const Vec3& after = line_T[std::min(i + 1, line_T.size() - 1)];
  return (after - before).normalized();
}

}  // namespace

std::optional<RingCrossing> cross_ring(std::span<const Vec3> line_T, const Vec3& centre_T, const Vec3& normal_T) {
  std::optional<RingCrossing> best;
  double along = 0, nearest = 0;
  for (std::size_t i = 0; i + 1 < line_T.size(); ++i) {
    const Vec3 &from = line_T[i], &to = line_T[i + 1];
    const double length = (to - from).norm();
    const double before = normal_T.dot(from - centre_T), after = normal_T.dot(to - centre_T);
    if ((before <= 0) != (after <= 0)) {
      const double share = before / (before - after);
      const Vec3 point = from + share * (to - from);
      const double distance = (point - centre_T).norm();
      if (!best || distance < nearest) {
        nearest = distance;
        const Vec3 tangent = (1 - share) * tangent_at(line_T, i) + share * tangent_at(line_T, i + 1);
        best = RingCrossing{point, tangent.normalized(), along + share * length};
      }
    }
    along += length;
  }
  return best;
}

RingTouch touch_ring(const RingOnWire& ring, const Pose& X_TI, const Twist& V_TI_T) {
  RingTouch touch;
  const Vec3 centre = X_TI * ring.centre_I, n = X_TI.R * ring.normal_I;
  const auto crossing = cross_ring({ring.point_T.data(), static_cast<std::size_t>(ring.count)}, centre, n);
  if (!crossing) return touch;
  const Vec3 offset = crossing->point_T - centre;
  const double distance = offset.norm(), depth = distance - ring.play_m;
  touch.point_T = crossing->point_T;
  if (depth <= 0 || distance < kNothing) return touch;
  const Vec3 e = offset / distance, &t = crossing->tangent_T;
  const double across = std::copysign(std::max(std::abs(n.dot(t)), kFlattest), n.dot(t));
  const Vec3 way = e - n * (t.dot(e) / across);
  const Vec3 lever = crossing->point_T - X_TI.p;
  touch.depth_m = depth;
  touch.spring_I_T.force = ring.stiffness_n_per_m * depth * way;
  touch.spring_I_T.moment = lever.cross(touch.spring_I_T.force);
  touch.stored_j = 0.5 * ring.stiffness_n_per_m * depth * depth;
  touch.normal_T = way.normalized();
  const double approach = -way.dot(V_TI_T.linear + V_TI_T.angular.cross(lever));
  touch.damping_factor = std::max(0.0, 1 + 1.5 * ring.damping_s_per_m * approach);
  return touch;
}

}  // namespace trocar
