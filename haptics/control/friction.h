// Friction feed-forward: part of the identified Coulomb and viscous torque, never at rest.
//
// tau = share (tau_c tanh(qd / v0) + b qd), share <= 0.7, off inside the dead band and while the passivity budget is in
// debt: compensating stiction from the sign of a noisy velocity makes a limit cycle. Thread: haptic task.
#pragma once

#include <cmath>

#include "haptics/device/device_model.h"

namespace trocar {

struct FrictionFeedForward {
  double share = 0.5;
  double knee_rad_s = 0.3;       ///< v0
  double dead_band_rad_s = 0.02;
  double debt_j = 0;             ///< most that the passivity budget may owe; in free air DAC rounding alone owes 1e-8 to 1e-6 J
};

inline JointVector friction_torque(const DeviceModel& model, const FrictionFeedForward& p, const JointVector& qd) {
  JointVector torque;
  for (int i = 0; i < kArmJoints; ++i) {
    const double moving = std::abs(qd[i]) > p.dead_band_rad_s ? 1 : 0;
    torque[i] = moving * p.share * (model.coulomb[i] * std::tanh(qd[i] / p.knee_rad_s) + model.viscous[i] * qd[i]);
  }
  return torque;
}

}  // namespace trocar
