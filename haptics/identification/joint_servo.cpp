#include "haptics/identification/joint_servo.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

constexpr double kStillS = 0.2, kSettleS = 0.5;  // encoders watched with torque off; held after the jig has opened
constexpr int kMostCounts = 30;                  // a millisecond: 22 rad/s
constexpr double kLongestRest_s = 120;
constexpr int kInertiaTicks = 20;
// Enough to servo by, nothing is identified from them.
constexpr double kRotor = 1.95e-5;  // kg m2 at the joint: 10.3 g cm2 over 0.23 squared [F]
constexpr double kLegs = 1e-4;      // kg m2, platform and legs [assumed]
constexpr double kStylus = 8e-5;    // kg m2, a pen of 12 cm [assumed]

double hottest_of(const std::vector<MotorHeat>& heat) {
  double hottest = 0;
  for (const MotorHeat& motor : heat) hottest = std::max(hottest, motor.winding_c());
  return hottest;
}

}  // namespace

Eigen::VectorXd servo_masses(const DeviceModel& model) {
  Eigen::VectorXd pi = Eigen::VectorXd::Zero(kMassParameters);
  const auto add = [&](int body, double mass, const Vec3& r, double about_com) {
    const Mat3 I = (about_com + mass * r.squaredNorm()) * Mat3::Identity() - mass * r * r.transpose();
    pi[body_parameter(body, 0)] += mass;
    for (int k = 0; k < 3; ++k) pi[body_parameter(body, 1 + k)] += mass * r[k];
    for (int i = 0, item = 4; i < 3; ++i) {
      for (int j = i; j < 3; ++j) pi[body_parameter(body, item++)] += I(i, j);
    }
  };
  const Mat3 R_Pp_Wp = arm_state(home_angles()).R_WPprime.transpose();
  for (const PlatformWeight& w : model.platform_weights) add(0, w.weight_n / kGravity, R_Pp_Wp * w.home_W, 0);
  add(0, 0, Vec3::Zero(), kLegs);
  add(3, model.stylus_weight_n / kGravity, Vec3::Zero(), kStylus);
  for (int i = 0; i < kArmJoints; ++i) pi[rotor_parameter(i)] = kRotor;
  return pi;
}

JointServo::JointServo(DataAcquisition& daq, const DeviceModel& model, const ServoGains& gains)
    : daq_(daq),
      model_(model),
      gains_(gains),
      period_s_(1 / daq.capabilities().rate_hz),
      dac_bits_(daq.capabilities().dac_bits),
      heat_(kArmJoints),
      q_(home_angles()),
      qd_(JointVector::Zero()),
      reference_(q_),
      masses_(servo_masses(model)) {
  for (int i = 0; i < kArmJoints; ++i) {
    const Transmission& t = model_.transmission[static_cast<std::size_t>(i)];
    velocity_.emplace_back(count_size(t), period_s_);
    limit_[i] = max_joint_torque(t);
  }
  const DaqSample first = daq_.read();
  if ((first.digital_in & kHomeBeam) == 0) throw EnvironmentError("device: not in its home jig");
  counts_.reset(first.counts);
  for (long n = std::lround(kStillS / period_s_); n > 0; --n) {
    if (latch() != q_) throw EnvironmentError("device: an encoder moves in the home jig");
  }
  daq_.arm(true);
  const PathPoint home{reference_, JointVector::Zero()};
  for (long n = std::lround(kSettleS / period_s_); n > 0; --n) step(home);
}

JointServo::~JointServo() {
  daq_.write({});
  daq_.arm(false);
}

JointVector JointServo::latch() {
  const DaqSample sample = daq_.read();
  if (sample.valid != 0x7F || sample.elapsed_periods != 1)
    throw EnvironmentError("device: a SYNC was missed or not latched");
  if ((sample.digital_in & (kEmergencyStop | kWatchdogFired)) != 0)
    throw EnvironmentError("device: its safety chain has opened");
  const auto delta = counts_.advance(sample.counts);
  ChannelVector home = ChannelVector::Zero();
  home.head<kArmJoints>() = home_angles();
  for (int i = 0; i < kArmJoints; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    if (std::abs(static_cast<double>(delta[channel])) > kMostCounts * period_s_ * 1000) {
      throw EnvironmentError("device: the counts of joint " + std::to_string(i + 1) + " have jumped by " +
                             std::to_string(delta[channel]));
    }
    qd_[i] = velocity_[channel].update(counts_.total()[channel], 1);
  }
  return joint_positions(model_, counts_.total(), home).head<kArmJoints>();
}

void JointServo::step(const PathPoint& wanted) {
  q_ = latch();
  reference_ = wanted.q;
  const JointVector error = wanted.q - q_;
  worst_error_ = std::max(worst_error_, error.cwiseAbs().maxCoeff());
  Eigen::Index joint = 0;
  if (error.cwiseAbs().maxCoeff(&joint) > gains_.lost_rad) {
    throw EnvironmentError("device: joint " + std::to_string(joint + 1) + " does not follow, " +
                           std::to_string(error[joint]) + " rad behind at " + std::to_string(q_[joint]) + " rad, " +
                           std::to_string(time_s()) + " s");
  }
  ChannelVector tau = ChannelVector::Zero();
  tau.head<kArmJoints>() = torque_for(wanted).cwiseMin(limit_).cwiseMax(-limit_);
  const DacFrame codes = dac_codes(model_, tau, dac_bits_);
  daq_.write(codes);
  asked_before_ = asked_;
  asked_ = torques_of(model_, codes, dac_bits_).head<kArmJoints>();
  for (int i = 0; i < kArmJoints; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    const Transmission& t = model_.transmission[channel];
    heat_[channel].update(asked_[i] * t.ratio / t.torque_constant, period_s_);
  }
  hottest_c_ = std::max(hottest_c_, hottest_of(heat_));
  ++ticks_;
}

JointVector JointServo::torque_for(const PathPoint& wanted) {
  if (ticks_ % kInertiaTicks == 0) M_ = inertia_matrix(wanted.q, masses_);
  const double w = gains_.stiffness;
  JointVector tau = gravity_torque(model_, arm_state(wanted.q));
  const double pass = period_s_ / (gains_.rate_lag_s + period_s_);
  once_ += pass * (wanted.qd - qd_ - once_);
  twice_ += pass * (once_ - twice_);
  tau += M_ * (w * w * (wanted.q - q_) + 2 * w * twice_);
  for (int i = 0; i < kArmJoints; ++i) {
    tau[i] += model_.coulomb[i] * std::tanh(wanted.qd[i] / gains_.friction_knee) + model_.viscous[i] * wanted.qd[i];
  }
  return tau;
}

MotionTrace JointServo::follow(const JointPath& path, double seconds) {
  MotionTrace trace;
  trace.period_s = period_s_;
  const auto n = std::lround(seconds / period_s_);
  trace.q.reserve(static_cast<std::size_t>(n));
  trace.tau.reserve(static_cast<std::size_t>(n));
  for (long k = 1; k <= n; ++k) {
    // Before this SYNC the code of the tick before last acted, after it that of the last tick.
    const JointVector acting = 0.5 * (asked_ + asked_before_);
    step(path(static_cast<double>(k) * period_s_));
    trace.q.push_back(q_);
    trace.tau.push_back(acting);
  }
  return trace;
}

void JointServo::move_to(const JointVector& q, double speed) {
  if (hottest_of(heat_) > gains_.hot_c) rest();
  const JointVector from = reference_, way = q - from;
  const double seconds = std::max(0.1, 1.875 * way.cwiseAbs().maxCoeff() / speed);  // peak of minimum jerk: 15/8
  follow(
      [&](double t) {
        const double s = std::min(1.0, t / seconds), r = 1 - s;
        return PathPoint{from + s * s * s * (10 - 15 * s + 6 * s * s) * way, 30 * s * s * r * r / seconds * way};
      },
      seconds);
}

void JointServo::rest() {
  const double hot = gains_.hot_c;
  gains_.hot_c = 1e9;  // the way to the resting pose asks no rest itself
  move_to(home_angles());
  const PathPoint home{home_angles(), JointVector::Zero()};
  for (long n = std::lround(kLongestRest_s / period_s_); n > 0 && hottest_of(heat_) > gains_.cool_c; --n) step(home);
  gains_.hot_c = hot;
}

}  // namespace trocar
