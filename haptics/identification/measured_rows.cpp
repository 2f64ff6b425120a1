#include "haptics/identification/measured_rows.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kSmooth_s = 0.010, kFilter_s = 0.025, kGroup_s = 1;
constexpr double kReach = 4;  // standard deviations of a Gaussian that are kept

/// Gaussian of standard deviation s (in samples) and its first two derivatives, normalised to act on 1, t and t^2/2.
struct Kernel {
  std::vector<double> value, slope, curve;
  int half = 0;
};

Kernel gaussian(double s) {
  Kernel k;
  k.half = static_cast<int>(std::ceil(kReach * s));
  double sum = 0, first = 0, second = 0, zeroth = 0;
  for (int i = -k.half; i <= k.half; ++i) {
    const double g = std::exp(-0.5 * i * i / (s * s));
    k.value.push_back(g);
    k.slope.push_back(i * g);
    k.curve.push_back((i * i / (s * s) - 1) * g);
    sum += g;
  }
  for (int i = -k.half; i <= k.half; ++i) zeroth += k.curve[static_cast<std::size_t>(i + k.half)] / sum;
  for (int i = -k.half; i <= k.half; ++i) {
    const auto at = static_cast<std::size_t>(i + k.half);
    k.curve[at] -= zeroth * k.value[at];  // blind to a constant
    k.value[at] /= sum;
    first += i * k.slope[at];
    second += 0.5 * i * i * k.curve[at];
  }
  for (double& c : k.slope) c /= first;
  for (double& c : k.curve) c /= second;
  return k;
}

JointVector weighted(const std::vector<JointVector>& x, const std::vector<double>& weight, int centre, int half) {
  JointVector sum = JointVector::Zero();
  for (int i = -half; i <= half; ++i) {
    sum += weight[static_cast<std::size_t>(i + half)] * x[static_cast<std::size_t>(centre + i)];
  }
  return sum;
}

/// Joint rows of one instant under each other: 6 x columns. @param u -1 to 1: way in which friction is drawn.
Eigen::MatrixXd rows_at(const JointVector& q, const JointVector& qd, const JointVector& qdd, const JointVector& u,
                        const BaseSet& base) {
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(kArmJoints, column_count(base));
  Y.leftCols(base.size()) = base.columns(torque_regressor(q, qd, qdd));
  for (int i = 0; i < kArmJoints; ++i) {
    Y(i, base.size() + kCoulombColumn + i) = u[i];
    Y(i, base.size() + kViscousColumn + i) = qd[i];
    Y(i, base.size() + kOffsetColumn + i) = 1;
  }
  return Y;
}

struct Smoothed {
  std::vector<Eigen::MatrixXd> rows;
  std::vector<JointVector> tau, rate;
};

Smoothed smooth(const MotionTrace& trace, const BaseSet& base) {
  const Kernel k = gaussian(kSmooth_s / trace.period_s);
  const double dt = trace.period_s;
  Smoothed s;
  JointVector u = JointVector::Zero();
  for (int n = k.half; n + k.half < static_cast<int>(trace.q.size()); ++n) {
    const JointVector q = weighted(trace.q, k.value, n, k.half);
    const JointVector qd = weighted(trace.q, k.slope, n, k.half) / dt;
    const JointVector qdd = weighted(trace.q, k.curve, n, k.half) / (dt * dt);
    if (s.rows.empty()) u = qd.cwiseSign();  // under way
    for (int j = 0; j < kArmJoints; ++j) {
      const double way = qd[j] * dt / kPresliding;
      u[j] = (u[j] + way) / (1 + std::abs(way));
    }
    s.rows.push_back(rows_at(q, qd, qdd, u, base));
    s.tau.push_back(weighted(trace.tau, k.value, n, k.half));
    s.rate.push_back(qd);
  }
  return s;
}

}  // namespace

int column_count(const BaseSet& base) { return base.size() + 3 * kArmJoints; }

std::vector<FitParameter> fit_columns(const BaseSet& base) {
  std::vector<FitParameter> columns;
  const auto add = [&](const std::string& name, const std::string& unit, bool positive) {
    FitParameter& p = columns.emplace_back();
    p.name = name, p.unit = unit, p.positive = positive;
  };
  for (const int index : base.kept) {
    add(mass_parameter_name(index), mass_parameter_unit(index), index >= rotor_parameter(0));
  }
  for (int i = 1; i <= kArmJoints; ++i) add("Coulomb " + std::to_string(i), "N m", true);
  for (int i = 1; i <= kArmJoints; ++i) add("viscous " + std::to_string(i), "N m s/rad", true);
  for (int i = 1; i <= kArmJoints; ++i) add("offset " + std::to_string(i), "N m", false);
  return columns;
}

void add_pass(const MotionTrace& pass, const JointVector& qd, const BaseSet& base, double middle, int group,
              TorqueRows& rows) {
  const auto n = static_cast<int>(pass.q.size());
  const int skip = static_cast<int>(0.5 * (1 - middle) * n);
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(kArmJoints, column_count(base));
  JointVector tau = JointVector::Zero();
  for (int k = skip; k < n - skip; ++k) {
    tau += pass.tau[static_cast<std::size_t>(k)] / (n - 2 * skip);
    Y += rows_at(pass.q[static_cast<std::size_t>(k)], qd, JointVector::Zero(), qd.cwiseSign(), base) / (n - 2 * skip);
  }
  for (int j = 0; j < kArmJoints; ++j) rows.add(j, group, Y.row(j), tau[j]);
}

void add_trajectory(const MotionTrace& trace, const BaseSet& base, bool leave_out_slow, TorqueRows& rows) {
  const Smoothed s = smooth(trace, base);
  const Kernel k = gaussian(kFilter_s / trace.period_s);
  const int every = static_cast<int>(std::lround(kRow_s / trace.period_s));
  for (int n = k.half; n + k.half < static_cast<int>(s.tau.size()); n += every) {
    Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(kArmJoints, column_count(base));
    JointVector slowest = s.rate[static_cast<std::size_t>(n)].cwiseAbs();
    for (int i = -k.half; i <= k.half; ++i) {
      const auto at = static_cast<std::size_t>(n + i);
      Y += k.value[static_cast<std::size_t>(i + k.half)] * s.rows[at];
      slowest = slowest.cwiseMin(s.rate[at].cwiseAbs());
    }
    const JointVector tau = weighted(s.tau, k.value, n, k.half);
    const int group = static_cast<int>(n * trace.period_s / kGroup_s);
    for (int j = 0; j < kArmJoints; ++j) {
      if (!leave_out_slow || slowest[j] > kSlow) rows.add(j, group, Y.row(j), tau[j]);
    }
  }
}

}  // namespace trocar
