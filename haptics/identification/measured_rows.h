// From what the servo measured to rows for the fit: regressor, friction columns, torque.
//
// Columns: base parameters, Coulomb (u), viscous (rate), offset (1), six of each. u is the sign of the rate, reached
// over the presliding way after each reversal: u' = qd (1 - u sgn qd) / kPresliding. How friction rises when slow
// (Stribeck) is no column: the motions pass that zone too fast to tell it.
// A pass of a static pose is one row a joint: the mean over its middle. A trajectory is smoothed without lag by a
// Gaussian of 10 ms, whose derivatives give rates and accelerations; then rows and torques alike pass a Gaussian of 25
// ms (6 Hz) and are taken every 20 ms. Rows in which the joint comes slower than kSlow can be left out:
// there friction is neither Coulomb nor viscous. SI. Thread: any.
#pragma once

#include "haptics/identification/base_parameters.h"
#include "haptics/identification/excitation.h"
#include "haptics/identification/joint_servo.h"
#include "haptics/identification/weighted_fit.h"

namespace trocar {

inline constexpr double kRow_s = 0.020;  ///< between rows of a trajectory

/// Names and units of all columns.
std::vector<FitParameter> fit_columns(const BaseSet& base);
int column_count(const BaseSet& base);
constexpr int kCoulombColumn = 0, kViscousColumn = kArmJoints, kOffsetColumn = 2 * kArmJoints;  ///< after the base
inline constexpr double kPresliding = 1e-3;                                                     ///< rad [assumed]

/// One pass at constant rates `qd`. @param middle share of the trace that counts.
void add_pass(const MotionTrace& pass, const JointVector& qd, const BaseSet& base, double middle, int group,
              TorqueRows& rows);

/// A trajectory; every second is a group.
void add_trajectory(const MotionTrace& trace, const BaseSet& base, bool leave_out_slow, TorqueRows& rows);

}  // namespace trocar
