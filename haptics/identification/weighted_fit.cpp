#include "haptics/identification/weighted_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace trocar {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kWeightPasses = 5;

/// Normal equations by joint, all columns.
struct Normal {
  std::array<Matrix, kArmJoints> G;
  std::array<Vector, kArmJoints> b;
  JointVector square = JointVector::Zero(), rows = JointVector::Zero();
};

Normal normal_of(const TorqueRows& data) {
  Normal n;
  for (int j = 0; j < kArmJoints; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    const Matrix Y = data.rows(j);
    const Vector t = data.torques(j);
    n.G[joint] = Y.transpose() * Y;
    n.b[joint] = Y.transpose() * t;
    n.square[j] = t.squaredNorm();
    n.rows[j] = static_cast<double>(t.size());
  }
  return n;
}

/// Solves for the used columns; the rest stay 0.
struct Solution {
  Vector value;
  Matrix inverse;  ///< of the weighted normal matrix over the used columns
  std::vector<int> used;
};

Solution solve(const Normal& n, const JointVector& weight, const std::vector<int>& used) {
  const auto m = static_cast<Eigen::Index>(used.size());
  Matrix G = Matrix::Zero(m, m);
  Vector b = Vector::Zero(m);
  for (int j = 0; j < kArmJoints; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    for (Eigen::Index r = 0; r < m; ++r) {
      b[r] += weight[j] * n.b[joint][used[static_cast<std::size_t>(r)]];
      for (Eigen::Index c = 0; c < m; ++c) {
        G(r, c) += weight[j] * n.G[joint](used[static_cast<std::size_t>(r)], used[static_cast<std::size_t>(c)]);
      }
    }
  }
  const Vector scale = G.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * G * scale.asDiagonal();
  const Eigen::LDLT<Matrix> factor(scaled);
  Solution s;
  s.used = used;
  s.inverse = scale.asDiagonal() * factor.solve(Matrix::Identity(m, m)) * scale.asDiagonal();
  const Vector x = scale.asDiagonal() * factor.solve(scale.asDiagonal() * b);
  s.value = Vector::Zero(n.b[0].size());
  for (Eigen::Index r = 0; r < m; ++r) s.value[used[static_cast<std::size_t>(r)]] = x[r];
  return s;
}

JointVector residual_rms(const TorqueRows& data, const Vector& value) {
  JointVector rms = JointVector::Zero();
  for (int j = 0; j < kArmJoints; ++j) {
    if (data.size(j) == 0) continue;
    rms[j] = (data.torques(j) - data.rows(j) * value).norm() / std::sqrt(static_cast<double>(data.size(j)));
  }
  return rms;
}

/// One over the residual variance of each joint.
JointVector weights_of(const Normal& n, const Vector& value) {
  JointVector weight = JointVector::Zero();
  for (int j = 0; j < kArmJoints; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    const double square = n.square[j] - 2 * value.dot(n.b[joint]) + value.dot(n.G[joint] * value);
    if (n.rows[j] > 0) weight[j] = 1 / std::max(square / n.rows[j], 1e-12);  // 1e-6 N m: under any DAC step
  }
  return weight;
}

/// Variances of the used columns, groups as observations.
Vector variances(const TorqueRows& data, const Solution& s, const JointVector& weight) {
  const auto m = static_cast<Eigen::Index>(s.used.size());
  Matrix u = Matrix::Zero(data.group_count(), m);
  for (int j = 0; j < kArmJoints; ++j) {
    const Matrix Y = data.rows(j);
    const Vector rest = weight[j] * (data.torques(j) - Y * s.value);
    for (Eigen::Index k = 0; k < Y.rows(); ++k) {
      const int group = data.groups(j)[static_cast<std::size_t>(k)];
      for (Eigen::Index c = 0; c < m; ++c) u(group, c) += rest[k] * Y(k, s.used[static_cast<std::size_t>(c)]);
    }
  }
  return (u * s.inverse).colwise().squaredNorm().transpose();
}

}  // namespace

void TorqueRows::add(int joint, int group, const Eigen::RowVectorXd& row, double torque) {
  Joint& to = joint_[static_cast<std::size_t>(joint)];
  to.rows.insert(to.rows.end(), row.data(), row.data() + row.size());
  to.torque.push_back(torque);
  to.group.push_back(group);
  group_count_ = std::max(group_count_, group + 1);
}

void TorqueRows::append(const TorqueRows& other) {
  const int first = group_count_;
  for (std::size_t j = 0; j < kArmJoints; ++j) {
    const Joint& from = other.joint_[j];
    joint_[j].rows.insert(joint_[j].rows.end(), from.rows.begin(), from.rows.end());
    joint_[j].torque.insert(joint_[j].torque.end(), from.torque.begin(), from.torque.end());
    for (const int group : from.group) joint_[j].group.push_back(first + group);
  }
  group_count_ = first + other.group_count_;
}

Matrix TorqueRows::rows(int joint) const {
  const Joint& from = joint_[static_cast<std::size_t>(joint)];
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(from.rows.data(), size(joint), columns_);
}

Vector TorqueRows::torques(int joint) const {
  return Eigen::Map<const Vector>(joint_[static_cast<std::size_t>(joint)].torque.data(), size(joint));
}

Matrix TorqueRows::stacked() const {
  int total = 0;
  for (int j = 0; j < kArmJoints; ++j) total += size(j);
  Matrix Y(total, columns_);
  for (int j = 0, at = 0; j < kArmJoints; at += size(j++)) Y.middleRows(at, size(j)) = rows(j);
  return Y;
}

Vector TorqueFit::values() const {
  Vector v(static_cast<Eigen::Index>(parameter.size()));
  for (std::size_t i = 0; i < parameter.size(); ++i) v[static_cast<Eigen::Index>(i)] = parameter[i].value;
  return v;
}

TorqueFit fit_torques(const TorqueRows& data, std::vector<FitParameter> columns, double drop_above) {
  TorqueFit fit;
  fit.parameter = std::move(columns);
  const Normal normal = normal_of(data);
  std::vector<int> used;
  for (int i = 0; i < data.columns(); ++i) used.push_back(i);
  JointVector weight = JointVector::Ones();
  for (bool again = true; again;) {
    Solution s = solve(normal, weight, used);
    for (int pass = 0; pass < kWeightPasses; ++pass) {
      weight = weights_of(normal, s.value);
      s = solve(normal, weight, used);
    }
    const Vector variance = variances(data, s, weight);
    std::size_t worst = 0;
    double worst_share = 0;
    for (std::size_t k = 0; k < used.size(); ++k) {
      FitParameter& p = fit.parameter[static_cast<std::size_t>(used[k])];
      p.value = s.value[used[k]];
      p.deviation = std::sqrt(variance[static_cast<Eigen::Index>(k)]);
      const bool possible = p.positive ? p.value > 0 : p.value != 0;
      const double share = possible ? p.deviation / std::abs(p.value) : std::numeric_limits<double>::infinity();
      if (share > worst_share) worst_share = share, worst = k;
    }
    again = worst_share > drop_above && used.size() > 1;
    if (!again) break;
    FitParameter& leaves = fit.parameter[static_cast<std::size_t>(used[worst])];
    leaves.used = false;
    leaves.value = 0;
    ++fit.dropped;
    used.erase(used.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  fit.residual = residual_rms(data, fit.values());
  return fit;
}

JointVector prediction_error(const TorqueFit& fit, const TorqueRows& data) {
  JointVector share = residual_rms(data, fit.values());
  for (int j = 0; j < kArmJoints; ++j) {
    share[j] /= data.torques(j).norm() / std::sqrt(std::max(1.0, static_cast<double>(data.size(j))));
  }
  return share;
}

}  // namespace trocar
