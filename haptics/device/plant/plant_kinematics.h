// Kinematics of the plant, written apart from the controller's: platform orientation and serial angles are the
// state, the shoulder angles follow from it in closed form (thesis 2.21), so there is no branch to choose.
//
//   nu = [omega_p (in W); th4'; th5'; th6'],   q' = S nu,   S = blkdiag(Sp, I3)
//   row i of Sp = (W_i x V_i)^T / ((U_i x W_i) . V_i),  U = (z, x, y) of W,  V_i = columns of R_WP
// Stylus chain behind the platform by Table 2.6 (thesis). Everything in W unless a name says otherwise; W' (z up) is
// R_WB() away. Thread: pure functions, any thread, no allocation.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

/// Configuration of the arm.
struct PlantConfiguration {
  Eigen::Quaterniond q_WP = Eigen::Quaterniond::Identity();  ///< platform in W
  Vec3 serial = Vec3::Zero();                                ///< th4, th5, th6 (unwrapped), rad
};

/// Everything geometric about one configuration.
struct PlantKinematics {
  Mat3 R_WP, R_W6;  ///< platform, stylus
  Vec3 p4, p6;      ///< elbow, stylus origin, m
  Vec3 z4, z6;      ///< elbow (and first wrist) axis, roll axis
  Vec3 shoulder;    ///< th1..th3, rad
  Mat3 W;           ///< columns: passive axes
  Mat3 UxW;         ///< columns: U_i x W_i
  Vec3 b;           ///< (U_i x W_i) . V_i, the distance from a shoulder lock-up, 1 at best
  Mat3 Sp;          ///< shoulder rates = Sp omega_p
};

/// Rotation from W' to W: columns are W' axes in W.
const Mat3& base_rotation_WB();

PlantKinematics evaluate_kinematics(const PlantConfiguration& c, double link1, double link2);

/// Configuration at joint angles th1..th6 (2.29 to 2.31 in the form that holds on the whole joint box).
PlantConfiguration configuration_at(const JointVector& q);

/// Pose of the stylus in W'.
Pose stylus_pose(const PlantKinematics& k);

/// Joint angles th1..th6.
JointVector joint_angles(const PlantConfiguration& c, const PlantKinematics& k);

/// 3x6 maps from nu to the velocity of a point fixed in the stylus body and to the stylus' angular velocity, in W.
using NuJacobian = Eigen::Matrix<double, 3, 6>;
NuJacobian stylus_point_jacobian(const PlantKinematics& k, const Vec3& point_W);
NuJacobian stylus_angular_jacobian(const PlantKinematics& k);

/// Rate of Sp times omega_p: the shoulder's velocity-product term.
Vec3 shoulder_bias(const PlantKinematics& k, const Vec3& omega_p);

/// Joint angles of the home pose in the jig: position (0,-6,-272) mm and rotation rows (0,-1,0), (0,0,-1), (1,0,0)
/// in W', solved by Newton's method on these kinematics.
JointVector home_joint_angles(double link1, double link2);

}  // namespace trocar
