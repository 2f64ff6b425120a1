// The stiffness that this device can display without making energy, in the direction of a contact force.
//
//   K_max = min(2 b / T, b / (T/2 + Td), 2 fc / Delta)
// b and fc: damping and Coulomb friction felt at the stylus along the force, as far as the model is sure of them
// (DeviceModel::friction_sure()); Delta: what one encoder count moves it (Colgate and Schenkel 1997; Abbott and Okamura
// 2005; with delay after Hulin). The device gives the direction as a lever g = J^T e: its torque for 1 N, m. Motion
// along e is taken as the one that meets least friction: b = 1 / sum(g_i^2 / b_i), fc = min(fc_i / |g_i|); Delta =
// max(|g_i| count_i). So the limit errs on the safe side whatever the hand holds fast. Thread: haptic task; pure, no
// allocation.
#pragma once

#include <limits>

#include "haptics/device/device_model.h"

namespace trocar {

/// The device at the stylus along one direction.
struct TipFriction {
  double viscous_n_s_per_m = 0, coulomb_n = 0, count_m = 0;
};

struct StiffnessLimit {
  double k_max = std::numeric_limits<double>::infinity();  ///< N/m
  double share = 1;                                        ///< of the asked stiffness that k_max leaves
};

/// @param lever joint torque for a unit force, m.
TipFriction tip_friction(const DeviceModel& model, const JointVector& lever);

/// @param asked stiffness of the contact as rendered, N/m; @param delay_s Td beyond the hold.
StiffnessLimit stiffness_limit(const DeviceModel& model, const JointVector& lever, double asked, double period_s,
                               double delay_s);

}  // namespace trocar
