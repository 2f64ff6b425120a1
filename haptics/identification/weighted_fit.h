// Weighted least squares of joint torques on named columns, with what the data can say about each column.
//
// Each joint's rows are weighted by one over its residual variance, found in a few passes. Standard deviations count
// whole groups of rows (one pass of a pose, one second of a trajectory) as the independent observations, since
// neighbouring samples err together: (Y'WY)^-1 (sum of u u') (Y'WY)^-1, u = the group's sum of row times weighted
// residual. Columns whose relative standard deviation exceeds a limit leave, the worst first, and the rest is fitted
// again; so do parameters that come out negative where nature allows none (a rotor, friction): the data do not tell
// them. Thread: any.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct FitParameter {
  std::string name, unit;
  double value = 0;      ///< 0 when the data cannot tell it
  double deviation = 0;  ///< standard deviation; that at which it was dropped
  bool used = true;
  bool positive = false;  ///< a value that is not above 0 is impossible
};

/// Rows of one experiment, by joint.
class TorqueRows {
 public:
  explicit TorqueRows(int columns) : columns_(columns) {}
  /// @param group observations that err together.
  void add(int joint, int group, const Eigen::RowVectorXd& row, double torque);
  void append(const TorqueRows& other);

  int columns() const { return columns_; }
  int size(int joint) const { return static_cast<int>(joint_[static_cast<std::size_t>(joint)].torque.size()); }
  Eigen::MatrixXd rows(int joint) const;
  Eigen::VectorXd torques(int joint) const;
  const std::vector<int>& groups(int joint) const { return joint_[static_cast<std::size_t>(joint)].group; }
  int group_count() const { return group_count_; }
  /// All rows under each other.
  Eigen::MatrixXd stacked() const;

 private:
  struct Joint {
    std::vector<double> rows, torque;
    std::vector<int> group;
  };
  int columns_, group_count_ = 0;
  std::array<Joint, kArmJoints> joint_;
};

struct TorqueFit {
  std::vector<FitParameter> parameter;
  JointVector residual = JointVector::Zero();  ///< rms, N m
  int dropped = 0;
  Eigen::VectorXd values() const;
};

/// @param drop_above relative standard deviation.
TorqueFit fit_torques(const TorqueRows& data, std::vector<FitParameter> columns, double drop_above);

/// rms of torque minus prediction over rms of torque, by joint.
JointVector prediction_error(const TorqueFit& fit, const TorqueRows& data);

}  // namespace trocar
