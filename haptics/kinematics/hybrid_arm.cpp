#include "haptics/kinematics/hybrid_arm.h"

#include <algorithm>
#include <limits>

#include <Eigen/SVD>

#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

/// Rotation from P' to frame 5 and 4 (thesis 2.34): elbow and wrist turn about the same axis, -z of P'.
Mat3 rotation_Pprime_4(double th4) {
  const double s = std::sin(th4), c = std::cos(th4);
  return (Mat3() << -c, s, 0, s, c, 0, 0, 0, -1).finished();
}

Mat3 rotation_4_6(double th5, double th6) {
  const double s5 = std::sin(th5), c5 = std::cos(th5), s6 = std::sin(th6), c6 = std::cos(th6);
  return (Mat3() << s5 * c6, -s5 * s6, c5, -c5 * c6, c5 * s6, s5, -s6, -c6, 0).finished();
}

}  // namespace

ArmState arm_state(const JointVector& q) {
  static const Mat3 R_Wp_W = rotation_W_Wprime().transpose();
  static const Mat3 R_P_Pp = rotation_P_Pprime();
  const SphericalParallelState shoulder = spherical_parallel(q.head<3>());

  ArmState state;
  state.q = q;
  state.det_a = shoulder.det_a;
  state.R_WPprime = R_Wp_W * shoulder.R_WP * R_P_Pp;
  state.elbow_W = state.R_WPprime.col(0) * -kLink1;
  const Mat3 R_W4 = state.R_WPprime * rotation_Pprime_4(q[3]);
  state.X_WS.p = state.elbow_W + R_W4.col(0) * kLink2;
  state.X_WS.R = R_W4 * rotation_4_6(q[4], q[5]);

  const Mat3 omega_rates = R_Wp_W * shoulder.rates;
  for (int i = 0; i < 3; ++i) {
    state.J_WS.block<3, 1>(0, i) = omega_rates.col(i).cross(state.X_WS.p);
    state.J_WS.block<3, 1>(3, i) = omega_rates.col(i);
  }
  const Vec3 z4 = R_W4.col(2);
  state.J_WS.block<3, 1>(0, 3) = z4.cross(state.X_WS.p - state.elbow_W);
  state.J_WS.block<3, 1>(3, 3) = z4;
  state.J_WS.block<3, 1>(3, 4) = z4;
  state.J_WS.block<3, 1>(3, 5) = state.X_WS.R.col(2);
  return state;
}

double smallest_singular_value(const Mat6& J, double length_m) {
  Mat6 scaled = J;
  scaled.topRows<3>() /= length_m;
  return Eigen::JacobiSVD<Mat6>(scaled).singularValues()[5];
}

double joint_limit_margin(const JointVector& q) {
  double margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kArmJoints; ++i) {
    if (!kJointRange[i].limited) continue;
    margin = std::min({margin, q[i] - kJointRange[i].low, kJointRange[i].high - q[i]});
  }
  return margin;
}

}  // namespace trocar
