// Forward kinematics, geometric Jacobian and statics of the whole 6-DOF arm: one ArmState a tick serves pose,
// velocity, force and gravity.
//
// X_W'S by thesis (2.9) with exact constants; J_W'S is the 6x6 geometric Jacobian at the stylus origin, rows
// (linear; angular) in W': twist = J qd, tau = J^T w with w = (f, m) the wrench applied BY the device at the stylus.
// One Jacobian replaces the thesis' maps (2.71) to (2.74), two of which are misprinted (docs/thesis_errata.md).
// Thread: pure functions, any thread; no allocation.
#pragma once

#include "haptics/kinematics/device_geometry.h"
#include "haptics/quantities.h"

namespace trocar {

struct ArmState {
  JointVector q = JointVector::Zero();  ///< rad
  Pose X_WS;                            ///< stylus in W' (the code writes W for W' outside the shoulder)
  Mat6 J_WS = Mat6::Zero();             ///< m/rad and rad/rad; linear rows first
  Mat3 R_WPprime = Mat3::Identity();    ///< serial frame of the platform P' in W'
  Vec3 elbow_W = Vec3::Zero();          ///< origin of joint 4, m
  double det_a = 1;                     ///< of the shoulder, see spherical_parallel.h
};

/// @param q th1..th6, rad.
ArmState arm_state(const JointVector& q);

/// Smallest singular value of J with its linear rows divided by `length_m`. Allocates nothing, costs microseconds:
/// not for the tick.
double smallest_singular_value(const Mat6& J, double length_m);

/// Distance of each limited joint to its nearer limit, negative outside; the smallest is returned, rad.
double joint_limit_margin(const JointVector& q);

}  // namespace trocar
