// What the device is worth at one posture: conditioning, force in its worst direction, weight and heat, resolution.
//
// Worst-direction force without moment: every joint i must stay within T_i, so along n the force is
// min_i (T_i - |tau_g,i|) / |J_v,i . n| and at worst min_i (T_i - |tau_g,i|) / |J_v,i| (J_v,i column i, linear part;
// T = motor torque / ratio, tau_g holding torque). Winding temperature: steady state of the two-node model of
// motor_heat.h under the current that carries the weight, for ever. SI. Thread: pure functions, any thread.
#pragma once

#include "haptics/control/motor_heat.h"
#include "haptics/device/device_model.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

inline constexpr double kContinuousMotor_nm = 0.028;  ///< continuous rating of the motor [M]
inline constexpr double kPeakMotor_nm = 0.100;        ///< +-10 V of command
inline constexpr double kConditioningLength_m = 0.2;  ///< linear rows of J are divided by it

struct PostureQuality {
  double det_a = 0;
  double smallest_singular = 0;         ///< of J with its linear rows over 0.2 m
  double force_before_n = 0;            ///< worst direction, continuous, weight neglected
  double continuous_n = 0, peak_n = 0;  ///< worst direction after the weight; 0 when the weight alone is too much
  double gravity_motor_nm = 0;          ///< largest motor torque that carries the weight
  double winding_c = 0;                 ///< hottest motor, steady; infinite when it runs away
  double step_m = 0;                    ///< largest move of the stylus by one encoder count
};

PostureQuality posture_quality(const DeviceModel& model, const JointVector& q);

/// Worst-direction force of a motor torque. @param holding joint torques taken by the weight, or zero.
double worst_direction_force(const DeviceModel& model, const ArmState& arm, const JointVector& holding,
                             double motor_nm);

/// Winding temperature after a constant current for ever, deg C; infinite above the current that copper runs away at.
double steady_winding_c(const MotorHeatParameters& p, double current_a);

}  // namespace trocar
