// Where the identifier sends the arm: static poses over the workspace, and trajectories of a few sines.
//
// A pose is allowed 10 deg from every joint limit, with det A >= 0.3, link l1 clear of base and legs, and a weight (of
// the model given) that leaves the motors room; so is every point of a trajectory and of the way between poses. Poses
// are drawn uniformly in the joint box, shrunk about its middle by `span`. A trajectory has five harmonics of 0.1 Hz a
// joint; of many drawn by the seed, each stretched to the largest amplitude that is allowed, that with the least
// condition number of its regressor is taken. SI, radians. Thread: any.
#pragma once

#include <vector>

#include "haptics/device/device_model.h"
#include "haptics/identification/base_parameters.h"
#include "haptics/identification/joint_servo.h"

namespace trocar {

/// Slower than this friction is neither Coulomb nor viscous, rad/s: such moments do not count.
inline constexpr double kSlow = 0.12;

/// A pose that is passed slowly forth and back, all joints at once, in this pattern of signs.
struct StaticPose {
  JointVector q, sign;
};

std::vector<StaticPose> draw_static_poses(std::uint64_t seed, int count, double span, const DeviceModel& model);

struct FourierPath {
  static constexpr int kHarmonics = 5;
  JointVector centre = JointVector::Zero();
  Eigen::Matrix<double, kArmJoints, kHarmonics> sine = Eigen::Matrix<double, kArmJoints, kHarmonics>::Zero();
  Eigen::Matrix<double, kArmJoints, kHarmonics> cosine = Eigen::Matrix<double, kArmJoints, kHarmonics>::Zero();
  double base_hz = 0.1;
  double condition = 0;  ///< of the unit-column regressor along the path

  struct Point {
    JointVector q, qd, qdd;
  };
  Point at(double t) const;
  double period_s() const { return 1 / base_hz; }
};

/// @param candidates trajectories drawn. @param span of the largest allowed amplitude that is used.
FourierPath search_excitation(std::uint64_t seed, int candidates, double span, const DeviceModel& model,
                              const BaseSet& base);

/// Whether the arm may be there.
bool pose_allowed(const JointVector& q, const DeviceModel& model);

/// Largest over smallest singular value with every column scaled to length one; infinite when a column vanishes.
double condition_number(const Eigen::MatrixXd& Y);

}  // namespace trocar
