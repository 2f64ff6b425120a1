// Gravity of the device: potential and holding torque.
//
// Three weights turn with the platform by ONE rotation, p(q) = R(q) R(home)^T p(home); the stylus weight sits at the
// stylus origin. tau_g = dV/dq = -sum J_i^T G_i. The thesis' (4.3) to (4.7) add three partial rotations and are wrong
// even at home (docs/thesis_errata.md). Thread: pure functions, any thread; no allocation.
#pragma once

#include "haptics/device/device_model.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

/// Torque that holds the arm against gravity, N m.
JointVector gravity_torque(const DeviceModel& model, const ArmState& arm);

/// Potential energy over z_W' = 0, J.
double gravity_potential(const DeviceModel& model, const ArmState& arm);

}  // namespace trocar
