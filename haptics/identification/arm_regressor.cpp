#include "haptics/identification/arm_regressor.h"

#include <cmath>

#include <Eigen/LU>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

/// Motion of one body's frame, all in that frame; Jacobians from joint rates.
struct BodyMotion {
  Vec3 a, w, al;
  Eigen::Matrix<double, 3, kArmJoints> Jv, Jw;
};

/// The same in W', before it is turned into the body's frame.
struct Chain {
  Vec3 p = Vec3::Zero(), a = Vec3::Zero(), w = Vec3::Zero(), al = Vec3::Zero();
};

/// Angular acceleration of the platform in W: A al = B theta'' + B' theta' - A' omega.
Vec3 platform_acceleration(const Vec3& theta, const Mat3& V, const Vec3& omega, const Vec3& thd, const Vec3& thdd) {
  const Vec3 U[3] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  const double s[3] = {std::sin(theta[0]), std::sin(theta[1]), std::sin(theta[2])};
  const double c[3] = {std::cos(theta[0]), std::cos(theta[1]), std::cos(theta[2])};
  const Vec3 W[3] = {{s[0], -c[0], 0}, {0, s[1], -c[1]}, {-c[2], 0, s[2]}};  // thesis (2.6)
  Mat3 A;
  Vec3 right;
  for (int i = 0; i < 3; ++i) {
    const Vec3 v = V.col(i), v_dot = omega.cross(v);
    const Vec3 w_dot = thd[i] * U[i].cross(W[i]);
    A.row(i) = W[i].cross(v).transpose();
    const double b = U[i].cross(W[i]).dot(v);
    const double b_dot = U[i].cross(w_dot).dot(v) + U[i].cross(W[i]).dot(v_dot);
    right[i] = b * thdd[i] + b_dot * thd[i] - (w_dot.cross(v) + W[i].cross(v_dot)).dot(omega);
  }
  return A.partialPivLu().solve(right);
}

Chain turned_by(const Chain& before, const Vec3& axis, double rate, double acceleration) {
  Chain after = before;
  after.w += rate * axis;
  after.al += acceleration * axis + before.w.cross(rate * axis);
  return after;
}

Chain carried_to(const Chain& body, const Vec3& p) {
  const Vec3 r = p - body.p;
  Chain there = body;
  there.p = p;
  there.a += body.al.cross(r) + body.w.cross(body.w.cross(r));
  return there;
}

BodyMotion in_frame(const Mat3& R, const Chain& c, const ArmState& arm, int moving_joints) {
  BodyMotion m;
  m.a = R.transpose() * c.a;
  m.w = R.transpose() * c.w;
  m.al = R.transpose() * c.al;
  m.Jw.setZero();
  m.Jv.setZero();
  for (int i = 0; i < moving_joints; ++i) {
    const Vec3 axis = arm.J_WS.block<3, 1>(3, i);
    const Vec3 pivot = i < 3 ? Vec3::Zero() : i == 3 ? arm.elbow_W : arm.X_WS.p;
    m.Jw.col(i) = R.transpose() * axis;
    m.Jv.col(i) = R.transpose() * axis.cross(c.p - pivot);
  }
  return m;
}

void fill_body(const BodyMotion& m, int body, TorqueRegressor& Y) {
  const auto put = [&](int item, const Vec3& f, const Vec3& n) {
    Y.col(body_parameter(body, item)) = m.Jv.transpose() * f + m.Jw.transpose() * n;
  };
  put(0, m.a, Vec3::Zero());
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = Vec3::Unit(k);
    put(1 + k, m.al.cross(e) + m.w.cross(m.w.cross(e)), e.cross(m.a));
  }
  int item = 4;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      Mat3 E = Mat3::Zero();
      E(i, j) = E(j, i) = 1;
      put(item++, Vec3::Zero(), E * m.al + m.w.cross(E * m.w));
    }
  }
}

}  // namespace

std::string mass_parameter_name(int index) {
  static const std::array<const char*, kBodies> bodies{"P", "4", "5", "6"};
  static const std::array<const char*, kBodyParameters> items{"m",   "mx",  "my",  "mz",  "Ixx",
                                                              "Ixy", "Ixz", "Iyy", "Iyz", "Izz"};
  if (index >= kBodies * kBodyParameters) return "rotor " + std::to_string(index - kBodies * kBodyParameters + 1);
  return std::string(bodies[static_cast<std::size_t>(index / kBodyParameters)]) + "." +
         items[static_cast<std::size_t>(index % kBodyParameters)];
}

std::string mass_parameter_unit(int index) {
  if (index >= kBodies * kBodyParameters) return "kg m2";
  const int item = index % kBodyParameters;
  return item == 0 ? "kg" : item < 4 ? "kg m" : "kg m2";
}

TorqueRegressor torque_regressor(const JointVector& q, const JointVector& qd, const JointVector& qdd, double gravity) {
  const ArmState arm = arm_state(q);
  const Mat3 R_Wp_W = rotation_W_Wprime().transpose();
  const Mat3 R_WP = R_Wp_W.transpose() * arm.R_WPprime * rotation_P_Pprime().transpose();
  Chain platform;
  platform.a = gravity * Vec3::UnitZ();
  platform.w = arm.J_WS.block<3, 3>(3, 0) * qd.head<3>();
  platform.al =
      R_Wp_W * platform_acceleration(q.head<3>(), R_WP, R_Wp_W.transpose() * platform.w, qd.head<3>(), qdd.head<3>());
  const Vec3 z4 = arm.J_WS.block<3, 1>(3, 3), z6 = arm.J_WS.block<3, 1>(3, 5);
  const Chain link2 = turned_by(carried_to(platform, arm.elbow_W), z4, qd[3], qdd[3]);
  const Chain wrist = turned_by(carried_to(link2, arm.X_WS.p), z4, qd[4], qdd[4]);
  const Chain stylus = turned_by(wrist, z6, qd[5], qdd[5]);
  const auto frame = [](const Vec3& x, const Vec3& z) { return (Mat3() << x, z.cross(x), z).finished(); };

  TorqueRegressor Y = TorqueRegressor::Zero();
  fill_body(in_frame(arm.R_WPprime, platform, arm, 3), 0, Y);
  fill_body(in_frame(frame((arm.X_WS.p - arm.elbow_W).normalized(), z4), link2, arm, 4), 1, Y);
  fill_body(in_frame(frame(z6, z4), wrist, arm, 5), 2, Y);
  fill_body(in_frame(arm.X_WS.R, stylus, arm, 6), 3, Y);
  for (int i = 0; i < kArmJoints; ++i) Y(i, rotor_parameter(i)) = qdd[i];
  return Y;
}

Mat6 inertia_matrix(const JointVector& q, const Eigen::VectorXd& pi) {
  Mat6 M;
  for (int i = 0; i < kArmJoints; ++i) M.col(i) = torque_regressor(q, JointVector::Zero(), Vec6::Unit(i), 0) * pi;
  return M;
}

}  // namespace trocar
