#include "haptics/identification/base_parameters.h"

#include <Eigen/QR>

#include "haptics/identification/seeded_draw.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr int kMotions = 80;           // 480 rows for 46 columns
constexpr double kIndependent = 1e-9;  // of a column's norm; dependent ones leave some 1e-15
constexpr double kLeastDetA = 0.3;

/// First moments in the order of IdentifiedGravity, then inertias, rotors, the moments along joint axes, masses.
std::vector<int> preference() {
  std::vector<int> order{body_parameter(0, 1), body_parameter(0, 2), body_parameter(0, 3),
                         body_parameter(1, 1), body_parameter(1, 2), body_parameter(2, 1),
                         body_parameter(2, 2), body_parameter(3, 1), body_parameter(3, 2)};
  for (int body = 0; body < kBodies; ++body) {
    for (int item = 4; item < kBodyParameters; ++item) order.push_back(body_parameter(body, item));
  }
  for (int i = 0; i < kArmJoints; ++i) order.push_back(rotor_parameter(i));
  for (int body = 1; body < kBodies; ++body) order.push_back(body_parameter(body, 3));
  for (int body = 0; body < kBodies; ++body) order.push_back(body_parameter(body, 0));
  return order;
}

Eigen::MatrixXd stacked_regressor() {
  SeededDraw draw(1);
  Eigen::MatrixXd Y(kMotions * kArmJoints, kMassParameters);
  for (int k = 0; k < kMotions;) {
    JointVector q, qd, qdd;
    for (int i = 0; i < kArmJoints; ++i) {
      q[i] = draw.between(kJointRange[i].low, kJointRange[i].high);
      qd[i] = draw.between(-3, 3);
      qdd[i] = draw.between(-20, 20);
    }
    if (arm_state(q).det_a < kLeastDetA) continue;
    Y.middleRows(k * kArmJoints, kArmJoints) = torque_regressor(q, qd, qdd);
    ++k;
  }
  return Y;
}

}  // namespace

Eigen::Matrix<double, kArmJoints, Eigen::Dynamic> BaseSet::columns(const TorqueRegressor& Y) const {
  Eigen::Matrix<double, kArmJoints, Eigen::Dynamic> out(kArmJoints, size());
  for (int k = 0; k < size(); ++k) out.col(k) = Y.col(kept[static_cast<std::size_t>(k)]);
  return out;
}

BaseSet base_parameters() {
  const Eigen::MatrixXd Y = stacked_regressor();
  Eigen::MatrixXd basis(Y.rows(), 0);
  BaseSet set;
  for (const int index : preference()) {
    const Eigen::VectorXd column = Y.col(index);
    Eigen::VectorXd rest = column;
    for (int pass = 0; pass < 2; ++pass) rest -= (basis * (basis.transpose() * rest)).eval();
    if (rest.norm() <= kIndependent * column.norm()) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols<1>() = rest.normalized();
    set.kept.push_back(index);
  }
  Eigen::MatrixXd kept(Y.rows(), set.size());
  for (int k = 0; k < set.size(); ++k) kept.col(k) = Y.col(set.kept[static_cast<std::size_t>(k)]);
  set.grouping = kept.colPivHouseholderQr().solve(Y);
  set.grouping = set.grouping.unaryExpr([](double c) { return std::abs(c) < 1e-9 ? 0.0 : c; });
  return set;
}

}  // namespace trocar
