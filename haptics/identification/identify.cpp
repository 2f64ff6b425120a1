#include "haptics/identification/identify.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "haptics/control/gravity.h"
#include "haptics/identification/measured_rows.h"
#include "haptics/identification/seeded_draw.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kPassSpeed = 0.15;  // rad/s: beyond the Stribeck zone, slow enough for M qd' qd to vanish
constexpr double kPassWay = 0.07;    // rad to either side
constexpr double kPassMiddle = 0.6;  // share of a pass that counts
constexpr double kFadeIn_s = 2;      // a trajectory's amplitude grows from rest
constexpr double kOverlap_s = 0.2;   // measured before and after, for the filters
constexpr int kCheckedPoses = 200;
constexpr std::uint64_t kUnseenSeed = 0xA5A5A5A5A5A5A5A5ull, kNextSeed = 0x9E3779B97F4A7C15ull;

/// Forth through the pose, or back.
MotionTrace pass_through(JointServo& servo, const StaticPose& pose, double direction) {
  const JointVector rate = direction * kPassSpeed * pose.sign;
  const double half = kPassWay / kPassSpeed;
  servo.move_to(pose.q - 1.15 * half * rate);
  const auto path = [&](double t) { return PathPoint{pose.q + (t - 1.15 * half) * rate, rate}; };
  servo.follow(path, 0.15 * half);  // up to speed
  return servo.follow([&](double t) { return path(t + 0.15 * half); }, 2 * half);
}

MotionTrace run_trajectory(JointServo& servo, const FourierPath& fourier) {
  const auto faded = [&](double t) {
    const FourierPath::Point p = fourier.at(t);
    const double s = std::min(1.0, t / kFadeIn_s), r = 1 - s;
    const double share = s * s * s * (10 - 15 * s + 6 * s * s), growth = 30 * s * s * r * r / kFadeIn_s;
    const JointVector away = p.q - fourier.centre;
    return PathPoint{fourier.centre + share * away, share * p.qd + growth * away};
  };
  servo.move_to(fourier.centre);
  servo.follow(faded, kFadeIn_s);
  return servo.follow([&](double t) { return faded(t + kFadeIn_s); }, fourier.period_s() + 2 * kOverlap_s);
}

TorqueRows measure_poses(JointServo& servo, const Identification& id, const DeviceModel& nominal) {
  TorqueRows rows(column_count(id.base));
  int group = 0;
  for (const StaticPose& pose : draw_static_poses(id.request.seed, id.request.poses, id.request.span, nominal)) {
    for (const double direction : {1.0, -1.0}) {
      const MotionTrace pass = pass_through(servo, pose, direction);
      add_pass(pass, direction * kPassSpeed * pose.sign, id.base, kPassMiddle, group++, rows);
    }
  }
  return rows;
}

/// Half sums and half differences of the passes of each pose.
StaticFindings judge_poses(const TorqueRows& rows, const BaseSet& base, const DeviceModel& nominal) {
  StaticFindings found;
  Eigen::MatrixXd G(0, kGravityParameters + kArmJoints);
  Eigen::VectorXd half_sums(0);
  for (int j = 0; j < kArmJoints; ++j) {
    const Eigen::MatrixXd Y = rows.rows(j);
    const Eigen::VectorXd tau = rows.torques(j);
    const Eigen::Index n = tau.size() / 2, at = half_sums.size();
    G.conservativeResize(at + n, Eigen::NoChange);
    half_sums.conservativeResize(at + n);
    double sum = 0, squares = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double friction = 0.5 * (tau[2 * k] - tau[2 * k + 1]) * Y(2 * k, base.size() + kCoulombColumn + j);
      sum += friction, squares += friction * friction;
      half_sums[at + k] = 0.5 * (tau[2 * k] + tau[2 * k + 1]);
      G.row(at + k).head(kGravityParameters) = 0.5 * (Y.row(2 * k) + Y.row(2 * k + 1)).head(kGravityParameters);
      G.row(at + k).tail(kArmJoints) = Eigen::RowVectorXd::Unit(kArmJoints, j);
    }
    found.coulomb[j] = sum / n;
    found.coulomb_deviation[j] = std::sqrt(std::max(0.0, squares / n - found.coulomb[j] * found.coulomb[j]));
  }
  const Eigen::VectorXd rest = half_sums - G * G.colPivHouseholderQr().solve(half_sums);
  const Eigen::VectorXd given = half_sums - G.leftCols(kGravityParameters) * gravity_parameters(nominal) / kGravity;
  for (int j = 0; j < kArmJoints; ++j) {
    const Eigen::Index n = half_sums.size() / kArmJoints;
    found.gravity_residual[j] = rest.segment(j * n, n).norm() / std::sqrt(double(n));
    found.nominal_residual[j] = given.segment(j * n, n).norm() / std::sqrt(double(n));
  }
  return found;
}

void require_excitation(double condition, const IdentifyRequest& request) {
  if (condition <= request.most_condition) return;
  std::ostringstream text;
  text << "identification: too little excitation, the regressor's condition number is " << condition << ", at most "
       << request.most_condition << " is worth fitting (span " << request.span << ", " << request.poses << " poses)";
  throw InputError(text.str());
}

void take_result(Identification& id) {
  const int first = id.base.size();
  const Eigen::VectorXd v = id.fit.values();
  id.device.identified_gravity = gravity_of(kGravity * v.head(kGravityParameters));
  id.device.coulomb = v.segment<kArmJoints>(first + kCoulombColumn);
  id.device.viscous = v.segment<kArmJoints>(first + kViscousColumn);
  id.offset = v.segment<kArmJoints>(first + kOffsetColumn);
}

/// Base parameters as mass parameters that give the same torques: the kept ones, all others zero.
Eigen::VectorXd as_mass_parameters(const Identification& id) {
  Eigen::VectorXd pi = Eigen::VectorXd::Zero(kMassParameters);
  for (int k = 0; k < id.base.size(); ++k) pi[id.base.kept[std::size_t(k)]] = id.fit.values()[k];
  return pi;
}

void check_consistency(Identification& id, const DeviceModel& nominal) {
  const Eigen::VectorXd pi = as_mass_parameters(id);
  id.least_inertia = std::numeric_limits<double>::infinity();
  for (const StaticPose& pose : draw_static_poses(id.request.seed ^ kUnseenSeed, kCheckedPoses, 1, nominal)) {
    const Mat6 M = inertia_matrix(pose.q, pi);
    const Eigen::MatrixXd symmetric = 0.5 * (M + M.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
    id.least_inertia = std::min(id.least_inertia, solver.eigenvalues()[0]);
  }
  if (!(id.least_inertia > 0)) id.doubts.push_back("the inertia matrix is not positive definite everywhere");
  for (int j = 0; j < kArmJoints; ++j) {
    const std::string joint = " of joint " + std::to_string(j + 1);
    if (!(id.device.coulomb[j] > 0)) id.doubts.push_back("Coulomb friction" + joint + " is not positive");
    if (id.device.viscous[j] < 0) id.doubts.push_back("viscous friction" + joint + " is negative");
  }
}

/// The model given, in the columns of the fit: weights and friction, no inertia.
TorqueFit as_fit(const DeviceModel& model, const BaseSet& base) {
  TorqueFit fit;
  fit.parameter = fit_columns(base);
  const Eigen::VectorXd g = gravity_parameters(model) / kGravity;
  for (int k = 0; k < kGravityParameters; ++k) fit.parameter[std::size_t(k)].value = g[k];
  for (int j = 0; j < kArmJoints; ++j) {
    fit.parameter[std::size_t(base.size() + kCoulombColumn + j)].value = model.coulomb[j];
    fit.parameter[std::size_t(base.size() + kViscousColumn + j)].value = model.viscous[j];
  }
  return fit;
}

void check_unseen(Identification& id, const MotionTrace& trace, const DeviceModel& nominal) {
  TorqueRows all(column_count(id.base)), moving(column_count(id.base));
  add_trajectory(trace, id.base, false, all);
  add_trajectory(trace, id.base, true, moving);
  id.prediction_error = prediction_error(id.fit, all);
  id.moving_error = prediction_error(id.fit, moving);
  id.nominal_error = prediction_error(as_fit(nominal, id.base), all);
  for (int k = 0; k < all.size(0); ++k) {
    id.unseen_t.push_back(k * kRow_s);
    id.unseen_torque.emplace_back();
    id.unseen_predicted.emplace_back();
  }
  for (int j = 0; j < kArmJoints; ++j) {
    const Eigen::VectorXd tau = all.torques(j), predicted = all.rows(j) * id.fit.values();
    for (int k = 0; k < all.size(j); ++k) {
      id.unseen_torque[std::size_t(k)][j] = tau[k];
      id.unseen_predicted[std::size_t(k)][j] = predicted[k];
    }
  }
}

}  // namespace

Identification identify(DataAcquisition& daq, const DeviceModel& nominal, const IdentifyRequest& request) {
  Identification id;
  id.request = request;
  id.base = base_parameters();
  id.device = nominal;
  JointServo servo(daq, nominal);
  TorqueRows rows = measure_poses(servo, id, nominal);
  id.poses = judge_poses(rows, id.base, nominal);
  for (int k = 0; k < request.trajectories; ++k) {
    const std::uint64_t seed = request.seed + kNextSeed * static_cast<std::uint64_t>(k + 1);
    TorqueRows more(column_count(id.base));
    add_trajectory(run_trajectory(servo, search_excitation(seed, request.candidates, request.span, nominal, id.base)),
                   id.base, true, more);
    rows.append(more);
  }
  id.condition = condition_number(rows.stacked());
  require_excitation(id.condition, request);
  id.fit = fit_torques(rows, fit_columns(id.base), request.drop_above);
  take_result(id);
  check_consistency(id, nominal);
  const FourierPath unseen = search_excitation(request.seed ^ kUnseenSeed, 1, 1, nominal, id.base);
  check_unseen(id, run_trajectory(servo, unseen), nominal);
  id.hottest_c = servo.hottest_c();
  id.duration_s = servo.time_s();
  return id;
}

}  // namespace trocar
