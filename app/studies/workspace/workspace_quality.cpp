#include "app/studies/workspace/workspace_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/control/gravity.h"
#include "haptics/device/transmission.h"

namespace trocar {

double worst_direction_force(const DeviceModel& model, const ArmState& arm, const JointVector& holding,
                             double motor_nm) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kArmJoints; ++i) {
    const double lever = arm.J_WS.col(i).head<3>().norm();
    if (lever < 1e-9) continue;  // theta5 and theta6 turn about the stylus origin
    const double torque = motor_nm / model.transmission[static_cast<std::size_t>(i)].ratio - std::abs(holding[i]);
    least = std::min(least, std::max(0.0, torque) / lever);
  }
  return least;
}

double steady_winding_c(const MotorHeatParameters& p, double current_a) {
  // T - T0 = R_th I^2 R (1 + a (T - T0)), linear in T.
  const double rise = (p.winding_to_case_k_per_w + p.case_to_air_k_per_w) * current_a * current_a * p.resistance_ohm;
  const double left = 1 - p.copper_per_k * rise;
  return left > 0 ? p.ambient_c + rise / left : std::numeric_limits<double>::infinity();
}

PostureQuality posture_quality(const DeviceModel& model, const JointVector& q) {
  const ArmState arm = arm_state(q);
  const JointVector holding = gravity_torque(model, arm);
  PostureQuality out;
  out.det_a = arm.det_a;
  out.smallest_singular = smallest_singular_value(arm.J_WS, kConditioningLength_m);
  out.force_before_n = worst_direction_force(model, arm, JointVector::Zero(), kContinuousMotor_nm);
  out.continuous_n = worst_direction_force(model, arm, holding, kContinuousMotor_nm);
  out.peak_n = worst_direction_force(model, arm, holding, kPeakMotor_nm);
  for (int i = 0; i < kArmJoints; ++i) {
    const Transmission& t = model.transmission[static_cast<std::size_t>(i)];
    const double motor = std::abs(holding[i]) * t.ratio;
    out.gravity_motor_nm = std::max(out.gravity_motor_nm, motor);
    out.winding_c = std::max(out.winding_c, steady_winding_c({}, motor / t.torque_constant));
    out.step_m = std::max(out.step_m, arm.J_WS.col(i).head<3>().norm() * count_size(t));
  }
  return out;
}

}  // namespace trocar
