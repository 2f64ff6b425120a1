// What the motors can give: joint torques of a wrench at the stylus, and how much of them can be held.
//
// A motor's torque is bounded at once by its current and, held, by the heat of its winding. SI units, W'. Thread: any;
// not for the tick.
#pragma once

#include "haptics/device/device_model.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

inline constexpr double kHeldTime_s = 5;  ///< the hard limit must be rendered this long from cold

/// tau = J^T F. @param F at the stylus.
JointVector torque_of(const ArmState& arm, const Wrench& F);

double current_of(const DeviceModel& device, int joint, double torque);

/// Until a winding fades, from cold; at most 60.
double seconds_until_fading(double current_a);

/// Largest torque of each joint that its motor gives at once and still after `held_s` from cold.
JointVector torque_budget(const DeviceModel& device, double held_s = kHeldTime_s);

/// Largest share of `torque` that every joint can add to gravity within the budget; 1e9 when it asks nothing.
double share_beyond_gravity(const JointVector& budget, const JointVector& gravity, const JointVector& torque);

}  // namespace trocar
