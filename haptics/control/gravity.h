// Gravity of the device: potential and holding torque.
//
// Three weights turn with the platform by ONE rotation, p(q) = R(q) R(home)^T p(home); the stylus weight sits at the
// stylus origin. tau_g = dV/dq = -sum J_i^T G_i. The thesis' (4.3) to (4.7) add three partial rotations and are wrong
// even at home (docs/thesis_errata.md). A model that has been identified carries base parameters instead of weights:
// first moments of weight in P', 4, 5 and S, tau_g = dV/dq with V = z . (R_P' a + R_4 b + R_5 c + R_S d). Thread: pure
// functions, any thread; no allocation.
#pragma once

#include "haptics/device/device_model.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

/// Torque that holds the arm against gravity, N m.
JointVector gravity_torque(const DeviceModel& model, const ArmState& arm);

/// The nine base parameters of a model in the order of IdentifiedGravity, N m; those of its weights when it has none.
Eigen::Matrix<double, 9, 1> gravity_parameters(const DeviceModel& model);
IdentifiedGravity gravity_of(const Eigen::Matrix<double, 9, 1>& parameters);

/// Potential energy over z_W' = 0, J.
double gravity_potential(const DeviceModel& model, const ArmState& arm);

}  // namespace trocar
