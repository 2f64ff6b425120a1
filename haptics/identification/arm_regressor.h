// Joint torques of the arm as a matrix times its mass parameters: tau = Y(q, qd, qdd) pi.
//
// The controller's own rigid-body model, written apart from the simulated plant: four bodies (platform with link 1 and
// motors, link 2, wrist, stylus) on the spherical shoulder, and six rotors seen through their capstans. Newton-Euler at
// the origin of each body's frame, projected by its Jacobian:
//   f = m a + (al x + w x w x) mr,   n = I al + w x I w + mr x a,   a = acceleration of the origin minus gravity
// which is linear in the ten parameters m, mr, I (about the origin) of a body. Shoulder accelerations follow from
// A omega = B theta' differentiated (spherical_parallel.h).
// Frames of the bodies: P' (origin O), 4 (elbow), 5 (stylus origin, x along the roll axis, z along the elbow axis), 6 =
// S. SI. Thread: pure functions, any thread.
#pragma once

#include <array>
#include <string>

#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kBodies = 4;
inline constexpr int kBodyParameters = 10;                                      ///< m, mr (3), I (6)
inline constexpr int kMassParameters = kBodies * kBodyParameters + kArmJoints;  ///< bodies, then rotors

using TorqueRegressor = Eigen::Matrix<double, kArmJoints, kMassParameters>;

/// Index of a parameter: body 0..3 (platform, link 2, wrist, stylus), item 0 m, 1..3 mr, 4..9 Ixx Ixy Ixz Iyy Iyz Izz.
constexpr int body_parameter(int body, int item) { return body * kBodyParameters + item; }
constexpr int rotor_parameter(int joint) { return kBodies * kBodyParameters + joint; }

/// "P.mx", "4.Ixy", "rotor 3", ...
std::string mass_parameter_name(int index);
/// kg, kg m or kg m2.
std::string mass_parameter_unit(int index);

/// @param q rad, @param qd rad/s, @param qdd rad/s2. Columns in kg, kg m, kg m2; rows N m.
TorqueRegressor torque_regressor(const JointVector& q, const JointVector& qd, const JointVector& qdd,
                                 double gravity = kGravity);

/// Inertia matrix of the joints for parameters pi, kg m2.
Mat6 inertia_matrix(const JointVector& q, const Eigen::VectorXd& pi);

}  // namespace trocar
