#include "haptics/kinematics/link_clearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr int kArcSteps = 24;
constexpr double kBodies = kLinkHalfWidth + kLegHalfWidth;

double to_link(const Vec3& point, const Vec3& along) {
  const double s = std::clamp(point.dot(along), 0.0, kLink1);
  return (point - s * along).norm();
}

/// Nearest approach of l1 to the quarter arc from one unit axis to another on a radius.
double to_arc(const Vec3& from, const Vec3& to, double radius, const Vec3& along) {
  double nearest = 1;
  for (int k = 0; k <= kArcSteps; ++k) {
    const double a = std::numbers::pi / 2 * k / kArcSteps;
    nearest = std::min(nearest, to_link(radius * (std::cos(a) * from + std::sin(a) * to), along));
  }
  return nearest;
}

}  // namespace

LinkClearance link_clearance(const Vec3& theta, const Mat3& R_WP) {
  const Vec3 s = theta.array().sin(), c = theta.array().cos();
  const Vec3 along = R_WP * Vec3::Constant(1 / std::sqrt(3.0)), axis = Vec3::Constant(1 / std::sqrt(3.0));
  const Vec3 base[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};  // U1, U2, U3
  const Vec3 middle[] = {{s[0], -c[0], 0}, {0, s[1], -c[1]}, {-c[2], 0, s[2]}};
  // The ring seen from O is a cone about the sum of the axes: distance of l1's line from it, on the ring's sphere.
  const double ring_angle = std::acos(1 / std::sqrt(3.0)), tilt = std::acos(std::clamp(along.dot(axis), -1.0, 1.0));
  LinkClearance out;
  out.ring_m =
      kBaseRing * std::sin(std::clamp(ring_angle - tilt, -std::numbers::pi / 2, std::numbers::pi / 2)) - kBodies;
  out.legs_m = 1;
  for (int i = 0; i < 3; ++i) {
    out.legs_m = std::min({out.legs_m, to_arc(base[i], middle[i], kProximalArc, along) - kBodies,
                           to_arc(middle[i], R_WP.col(i), kDistalArc, along) - kBodies});
  }
  return out;
}

}  // namespace trocar
