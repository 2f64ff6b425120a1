// Linear-algebra vocabulary shared by every module. SI units and radians throughout.
//
// Monogram notation: X_AB is the pose of frame B in frame A; p_A a point in A; F_B_A a wrench on B expressed in A.
// Frames: W' device base (z up), S stylus, T theatre (scene, z up), I instrument (at the tip, z along the shaft
// towards the tip). docs/frames_and_units.md draws them. Thread: plain values, any thread.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trocar {

inline constexpr int kArmJoints = 6;              ///< th1..th3 shoulder, th4 elbow, th5 th6 wrist
inline constexpr int kPinchChannel = kArmJoints;  ///< index of the pinch among the channels
inline constexpr int kChannels = kArmJoints + 1;  ///< arm joints, then the pinch

inline constexpr double kGravity = 9.81;  ///< m/s2, as the weights of the thesis' table 4.1 were divided

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using JointVector = Eigen::Matrix<double, kArmJoints, 1>;
using ChannelVector = Eigen::Matrix<double, kChannels, 1>;

/// Rigid pose X_AB: p_A = R * p_B + p.
struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();  ///< m

  Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
  Vec3 operator*(const Vec3& point) const { return R * point + p; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Velocity of a frame: linear part at its origin.
struct Twist {
  Vec3 linear = Vec3::Zero();   ///< m/s
  Vec3 angular = Vec3::Zero();  ///< rad/s
};

/// Force and moment on a body; the moment is about the origin named where the value is declared.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m

  Wrench operator+(const Wrench& other) const { return {force + other.force, moment + other.moment}; }
  Wrench operator*(double scale) const { return {force * scale, moment * scale}; }
};

}  // namespace trocar
