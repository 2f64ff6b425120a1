#include "haptics/control/gravity.h"

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

/// Rotation of the platform since home, in W'.
Mat3 rotation_since_home(const ArmState& arm) {
  static const Mat3 home_inverse = arm_state(home_angles()).R_WPprime.transpose();
  return arm.R_WPprime * home_inverse;
}

/// First moments of weight in W' that turn with joint 3 and those before, 4, 5 and 6 (each with all behind it).
struct TurningMoments {
  Vec3 platform, link2, wrist, stylus;
};

TurningMoments turning_moments(const IdentifiedGravity& g, const ArmState& arm) {
  const Vec3 z4 = arm.J_WS.block<3, 1>(3, 3), z6 = arm.J_WS.block<3, 1>(3, 5);
  const Vec3 x4 = (arm.X_WS.p - arm.elbow_W) / kLink2;
  TurningMoments m;
  m.stylus = g.stylus.x() * arm.X_WS.R.col(0) + g.stylus.y() * arm.X_WS.R.col(1);
  m.wrist = m.stylus + g.wrist.x() * z6 + g.wrist.y() * z4.cross(z6);
  m.link2 = m.wrist + g.link2.x() * x4 + g.link2.y() * z4.cross(x4);
  m.platform = m.link2 + arm.R_WPprime * g.platform;
  return m;
}

JointVector identified_torque(const IdentifiedGravity& g, const ArmState& arm) {
  const TurningMoments m = turning_moments(g, arm);
  JointVector torque;
  for (int i = 0; i < kArmJoints; ++i) {
    const Vec3& moment = i < 3 ? m.platform : i == 3 ? m.link2 : i == 4 ? m.wrist : m.stylus;
    const Vec3 axis = arm.J_WS.block<3, 1>(3, i);
    torque[i] = axis.x() * moment.y() - axis.y() * moment.x();  // (axis x moment) . z
  }
  return torque;
}

}  // namespace

Eigen::Matrix<double, 9, 1> gravity_parameters(const DeviceModel& model) {
  Eigen::Matrix<double, 9, 1> p = Eigen::Matrix<double, 9, 1>::Zero();
  if (model.identified_gravity) {
    const IdentifiedGravity& g = *model.identified_gravity;
    p << g.platform, g.link2, g.wrist, g.stylus;
    return p;
  }
  const Mat3 R_home = arm_state(home_angles()).R_WPprime;
  for (const PlatformWeight& body : model.platform_weights)
    p.head<3>() += body.weight_n * (R_home.transpose() * body.home_W);
  p[0] -= model.stylus_weight_n * kLink1;
  p[3] += model.stylus_weight_n * kLink2;
  return p;
}

IdentifiedGravity gravity_of(const Eigen::Matrix<double, 9, 1>& p) {
  return {p.head<3>(), p.segment<2>(3), p.segment<2>(5), p.segment<2>(7)};
}

JointVector gravity_torque(const DeviceModel& model, const ArmState& arm) {
  if (model.identified_gravity) return identified_torque(*model.identified_gravity, arm);
  const Mat3 R = rotation_since_home(arm);
  JointVector torque = JointVector::Zero();
  for (const PlatformWeight& body : model.platform_weights) {
    const Vec3 p = R * body.home_W;
    // d(z)/d(th_i) for a point of the platform: (omega_i x p) . z
    for (int i = 0; i < 3; ++i) torque[i] += body.weight_n * arm.J_WS.block<3, 1>(3, i).cross(p).z();
  }
  torque += model.stylus_weight_n * arm.J_WS.row(2).transpose();
  return torque;
}

double gravity_potential(const DeviceModel& model, const ArmState& arm) {
  if (model.identified_gravity) return turning_moments(*model.identified_gravity, arm).platform.z();
  const Mat3 R = rotation_since_home(arm);
  double energy = model.stylus_weight_n * arm.X_WS.p.z();
  for (const PlatformWeight& body : model.platform_weights) energy += body.weight_n * (R * body.home_W).z();
  return energy;
}

}  // namespace trocar
