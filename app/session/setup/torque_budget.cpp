#include "app/session/setup/torque_budget.h"

#include <algorithm>
#include <cmath>

#include "haptics/control/motor_heat.h"
#include "haptics/device/transmission.h"

namespace trocar {
namespace {

constexpr double kLongestHold_s = 60, kHeatStep_s = 0.05;

/// Largest current up to `most_a` that a winding bears for `held_s`, from cold.
double held_current(double most_a, double held_s) {
  if (seconds_until_fading(most_a) >= held_s) return most_a;
  double low = 0, high = most_a;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (seconds_until_fading(middle) >= held_s ? low : high) = middle;
  }
  return low;
}

}  // namespace

JointVector torque_of(const ArmState& arm, const Wrench& F) {
  Vec6 w;
  w << F.force, F.moment;
  return arm.J_WS.transpose() * w;
}

double current_of(const DeviceModel& device, int joint, double torque) {
  const Transmission& t = device.transmission[static_cast<std::size_t>(joint)];
  return torque * t.ratio / t.torque_constant;
}

double seconds_until_fading(double current_a) {
  MotorHeat heat;
  double t = 0;
  for (; t < kLongestHold_s && heat.share() >= 1; t += kHeatStep_s) heat.update(current_a, kHeatStep_s);
  return std::min(t, kLongestHold_s);
}

JointVector torque_budget(const DeviceModel& device, double held_s) {
  JointVector budget;
  for (int i = 0; i < kArmJoints; ++i) {
    const double most = max_joint_torque(device.transmission[static_cast<std::size_t>(i)]);
    const double current = std::abs(current_of(device, i, most));
    budget[i] = most * held_current(current, held_s) / current;
  }
  return budget;
}

double share_beyond_gravity(const JointVector& budget, const JointVector& gravity, const JointVector& torque) {
  double share = 1e9;
  for (int i = 0; i < kArmJoints; ++i) {
    const double load = std::abs(torque[i]);
    if (load < 1e-9) continue;
    const double left = budget[i] - std::copysign(1.0, torque[i]) * gravity[i];
    share = std::min(share, std::max(0.0, left) / load);
  }
  return share;
}

}  // namespace trocar
