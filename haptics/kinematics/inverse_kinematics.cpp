#include "haptics/kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

constexpr double kReachTolerance = 1e-12;    // m; rounding of |OA| for a straight arm
constexpr double kParallelTolerance = 1e-9;  // |AO x Z6| / |AO| under which the arm plane is undefined

double positive_turn(double angle) {
  const double turned = std::fmod(angle, 2 * std::numbers::pi);
  return turned < 0 ? turned + 2 * std::numbers::pi : turned;
}

/// Joint angles for one orientation of the arm plane. @param z4 unit axis of the elbow in W'.
JointVector angles_for_plane(const Pose& X_WS, double th4, const Vec3& z4) {
  const double s4 = std::sin(th4), c4 = std::cos(th4);
  // Stylus origin in P' for this elbow angle; z of P' is -z4. Two directions fix the rotation.
  const Vec3 p_Pp(-kLink1 - kLink2 * c4, kLink2 * s4, 0);
  const auto triad = [](const Vec3& x, const Vec3& z) {
    const Vec3 unit = x.normalized();
    return (Mat3() << unit, z, unit.cross(z)).finished();
  };
  const Mat3 R_W_Pp = triad(X_WS.p, -z4) * triad(p_Pp, Vec3::UnitZ()).transpose();
  const Mat3 R_WP = rotation_W_Wprime() * R_W_Pp * rotation_P_Pprime().transpose();

  const Mat3 R_Pp_4 = (Mat3() << -c4, s4, 0, s4, c4, 0, 0, 0, -1).finished();
  const Mat3 T = (R_W_Pp * R_Pp_4).transpose() * X_WS.R;
  JointVector q;
  q << active_angles(R_WP), th4, std::atan2(T(1, 2), T(0, 2)), positive_turn(std::atan2(-T(2, 0), -T(2, 1)));
  return q;
}

}  // namespace

InverseSolutions inverse_kinematics(const Pose& X_WS) {
  InverseSolutions solutions;
  const double reach = X_WS.p.norm();
  solutions.missed_by_m = std::max({0.0, reach - (kLink1 + kLink2), (kLink1 - kLink2) - reach});
  if (solutions.missed_by_m > kReachTolerance) return solutions;
  solutions.missed_by_m = 0;

  const double cosine = (kLink1 * kLink1 + kLink2 * kLink2 - reach * reach) / (2 * kLink1 * kLink2);
  const double th4 = std::acos(std::clamp(cosine, -1.0, 1.0)) - std::numbers::pi;
  const Vec3 normal = (-X_WS.p).cross(X_WS.R.col(2));
  if (normal.norm() < kParallelTolerance * reach) return solutions;

  for (const double sign : {1.0, -1.0}) {
    InverseCandidate& candidate = solutions.candidate[solutions.count++];
    candidate.q = angles_for_plane(X_WS, th4, sign * normal.normalized());
    candidate.in_limits = joint_limit_margin(candidate.q) >= 0;
  }
  return solutions;
}

std::optional<JointVector> inverse_within_limits(const Pose& X_WS, const JointVector& near) {
  const InverseSolutions solutions = inverse_kinematics(X_WS);
  std::optional<JointVector> best;
  double best_distance = 0;
  for (int i = 0; i < solutions.count; ++i) {
    if (!solutions.candidate[i].in_limits) continue;
    JointVector q = solutions.candidate[i].q;
    q[5] += 2 * std::numbers::pi * std::round((near[5] - q[5]) / (2 * std::numbers::pi));
    const double distance = (q - near).norm();
    if (!best || distance < best_distance) {
      best = q;
      best_distance = distance;
    }
  }
  return best;
}

JointVector home_angles() {
  const InverseSolutions solutions = inverse_kinematics(home_pose());
  JointVector q = solutions.candidate[solutions.candidate[0].in_limits ? 0 : 1].q;
  q[5] -= 2 * std::numbers::pi * std::round(q[5] / (2 * std::numbers::pi));
  return q;
}

}  // namespace trocar
