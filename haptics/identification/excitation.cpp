#include "haptics/identification/excitation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "haptics/control/gravity.h"
#include "haptics/identification/seeded_draw.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/link_clearance.h"

namespace trocar {
namespace {

constexpr double kMargin = 10 * kDegree;
constexpr double kLeastPathDetA = 0.3;
constexpr double kMostWeight = 0.28;  // N m at a joint: 64 mN m at the motor, of 100
constexpr double kPathWay = 0.08;     // rad to either side of a static pose
constexpr int kPathPoints = 60;
constexpr double kCentreShare = 0.3;             // of the reach, for the centre of a trajectory
constexpr double kMostSpeed = 4, kMostRoll = 8;  // rad/s; the roll joint is light and free
constexpr int kSteps = 24;                       // of the amplitude

JointVector middle_of_box() {
  JointVector middle;
  for (int i = 0; i < kArmJoints; ++i) middle[i] = 0.5 * (kJointRange[i].low + kJointRange[i].high);
  middle[5] = 0;
  return middle;
}

JointVector reach_of_box() {
  JointVector reach;
  for (int i = 0; i < kArmJoints; ++i) reach[i] = 0.5 * (kJointRange[i].high - kJointRange[i].low) - kMargin;
  return reach;
}

bool way_allowed(const JointVector& from, const JointVector& to, const DeviceModel& model) {
  constexpr int kPoints = 12;
  for (int k = 0; k <= kPoints; ++k) {
    if (!pose_allowed(from + k * (to - from) / kPoints, model)) return false;
  }
  return true;
}

bool path_allowed(const FourierPath& path, const DeviceModel& model) {
  for (int k = 0; k < kPathPoints; ++k) {
    const FourierPath::Point p = path.at(k * path.period_s() / kPathPoints);
    if (!pose_allowed(p.q, model)) return false;
    if (p.qd.head<5>().cwiseAbs().maxCoeff() > kMostSpeed || std::abs(p.qd[5]) > kMostRoll) return false;
  }
  return true;
}

FourierPath drawn_path(SeededDraw& draw, double span, const DeviceModel& model) {
  FourierPath path;
  const JointVector reach = reach_of_box();
  do {
    for (int i = 0; i < kArmJoints; ++i)
      path.centre[i] = middle_of_box()[i] + kCentreShare * span * draw.between(-1, 1) * reach[i];
  } while (!pose_allowed(path.centre, model));
  FourierPath shape = path;
  for (int i = 0; i < kArmJoints; ++i) {
    for (int h = 0; h < FourierPath::kHarmonics; ++h) {
      const double size = 0.5 * reach[i] * (h + 1) / FourierPath::kHarmonics;  // fast ones tell inertia
      shape.sine(i, h) = size * draw.between(-1, 1);
      shape.cosine(i, h) = size * draw.between(-1, 1);
    }
  }
  // Joint by joint in turn the amplitude grows while the whole path stays allowed.
  JointVector share = JointVector::Zero();
  const auto scaled = [&](const JointVector& by) {
    FourierPath out = shape;
    for (int i = 0; i < kArmJoints; ++i) out.sine.row(i) *= by[i], out.cosine.row(i) *= by[i];
    return out;
  };
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < kArmJoints; ++i) {
      JointVector more = share;
      more[i] += 1.0 / kSteps;
      if (path_allowed(scaled(more), model)) share = more;
    }
  }
  return scaled(span * share);
}

Eigen::MatrixXd regressor_along(const FourierPath& path, const BaseSet& base) {
  Eigen::MatrixXd Y(kPathPoints * kArmJoints, base.size() + 2 * kArmJoints);
  Y.setZero();
  for (int k = 0; k < kPathPoints; ++k) {
    const FourierPath::Point p = path.at(k * path.period_s() / kPathPoints);
    Y.block(k * kArmJoints, 0, kArmJoints, base.size()) = base.columns(torque_regressor(p.q, p.qd, p.qdd));
    for (int i = 0; i < kArmJoints; ++i) {
      Y(k * kArmJoints + i, base.size() + i) = p.qd[i] > 0 ? 1 : -1;
      Y(k * kArmJoints + i, base.size() + kArmJoints + i) = p.qd[i];
      if (std::abs(p.qd[i]) < kSlow) Y.row(k * kArmJoints + i).setZero();
    }
  }
  return Y;
}

}  // namespace

bool pose_allowed(const JointVector& q, const DeviceModel& model) {
  if (joint_limit_margin(q) < kMargin - 1e-12) return false;
  const ArmState arm = arm_state(q);
  if (arm.det_a < kLeastPathDetA || gravity_torque(model, arm).cwiseAbs().maxCoeff() > kMostWeight) return false;
  const Mat3 R_WP = rotation_W_Wprime() * arm.R_WPprime * rotation_P_Pprime().transpose();
  return link_clearance(q.head<3>(), R_WP).clear();
}

std::vector<StaticPose> draw_static_poses(std::uint64_t seed, int count, double span, const DeviceModel& model) {
  SeededDraw draw(seed);
  const JointVector middle = middle_of_box(), reach = reach_of_box();
  std::vector<StaticPose> poses;
  JointVector last = middle;
  for (int tried = 0; static_cast<int>(poses.size()) < count; ++tried) {
    StaticPose pose;
    for (int i = 0; i < kArmJoints; ++i) {
      pose.q[i] = middle[i] + span * draw.between(-1, 1) * reach[i];
      pose.sign[i] = draw.sign();
    }
    const JointVector ahead = pose.q + kPathWay * pose.sign, behind = pose.q - kPathWay * pose.sign;
    if (!pose_allowed(pose.q, model) || !pose_allowed(ahead, model) || !pose_allowed(behind, model)) continue;
    if (tried < 100000 && !way_allowed(last, behind, model)) continue;
    poses.push_back(pose);
    last = behind;
  }
  return poses;
}

FourierPath::Point FourierPath::at(double t) const {
  Point p{centre, JointVector::Zero(), JointVector::Zero()};
  for (int h = 0; h < kHarmonics; ++h) {
    const double w = 2 * std::numbers::pi * base_hz * (h + 1), s = std::sin(w * t), c = std::cos(w * t);
    p.q += sine.col(h) * s + cosine.col(h) * c;
    p.qd += w * (sine.col(h) * c - cosine.col(h) * s);
    p.qdd -= w * w * (sine.col(h) * s + cosine.col(h) * c);
  }
  return p;
}

double condition_number(const Eigen::MatrixXd& Y) {
  Eigen::MatrixXd scaled = Y;
  for (int k = 0; k < Y.cols(); ++k) {
    const double norm = Y.col(k).norm();
    if (!(norm > 0)) return std::numeric_limits<double>::infinity();
    scaled.col(k) /= norm;
  }
  // Roots of the Gram matrix' eigenvalues: columns of length 1 and condition numbers far below 1e8 lose nothing by the
  // square, and a singular value decomposition costs a minute of compiling.
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled.transpose() * scaled, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(squares[0] > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(squares[squares.size() - 1] / squares[0]);
}

FourierPath search_excitation(std::uint64_t seed, int candidates, double span, const DeviceModel& model,
                              const BaseSet& base) {
  SeededDraw draw(seed);
  FourierPath best;
  best.condition = std::numeric_limits<double>::infinity();
  for (int k = 0; k < candidates; ++k) {
    FourierPath path = drawn_path(draw, span, model);
    path.condition = condition_number(regressor_along(path, base));
    if (k == 0 || path.condition < best.condition) best = path;
  }
  return best;
}

}  // namespace trocar
