#include "haptics/control/gravity.h"

#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

/// Rotation of the platform since home, in W'.
Mat3 rotation_since_home(const ArmState& arm) {
  static const Mat3 home_inverse = arm_state(home_angles()).R_WPprime.transpose();
  return arm.R_WPprime * home_inverse;
}

}  // namespace

JointVector gravity_torque(const DeviceModel& model, const ArmState& arm) {
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
  const Mat3 R = rotation_since_home(arm);
  double energy = model.stylus_weight_n * arm.X_WS.p.z();
  for (const PlatformWeight& body : model.platform_weights) energy += body.weight_n * (R * body.home_W).z();
  return energy;
}

}  // namespace trocar
