#include "haptics/control/kalman_velocity.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr int kToSteadyState = 4000;        // iterations; the gains stand still to 1e-12 after some 300
constexpr std::uint32_t kLongestGap = 100;  // periods: beyond, the filter starts anew

Mat3 transition(double T) { return (Mat3() << 1, T, T * T / 2, 0, 1, T, 0, 0, 1).finished(); }

/// Covariance that white jerk of density q adds in one period.
Mat3 jerk_noise(double q, double T) {
  const double T2 = T * T, T3 = T2 * T;
  return q * (Mat3() << T3 * T2 / 20, T3 * T / 8, T3 / 6, T3 * T / 8, T3 / 3, T2 / 2, T3 / 6, T2 / 2, T).finished();
}

}  // namespace

KalmanVelocity::KalmanVelocity(double quantum, double period_s)
    : quantum_(quantum), period_s_(period_s), step_(transition(period_s)), gain_(Vec3::Zero()) {
  // In counts: R = 1/12.
  constexpr double kR = 1.0 / 12;
  const Mat3 Q = jerk_noise(kJerkDensityPerQuantum2, period_s_);
  Mat3 P = Mat3::Identity();
  for (int i = 0; i < kToSteadyState; ++i) {
    P = step_ * P * step_.transpose() + Q;
    gain_ = P.col(0) / (P(0, 0) + kR);
    P -= gain_ * P.row(0).eval();
    P = (0.5 * (P + P.transpose())).eval();
  }
}

double KalmanVelocity::update(std::int64_t count, std::uint32_t elapsed_periods) {
  if (!started_ || elapsed_periods > kLongestGap) {
    started_ = true;
    origin_ = count;
    state_.setZero();
    return 0;
  }
  for (std::uint32_t i = 0; i < std::max<std::uint32_t>(1, elapsed_periods); ++i) state_ = step_ * state_;
  state_ += gain_ * (static_cast<double>(count - origin_) - state_[0]);
  return state_[1] * quantum_;
}

}  // namespace trocar
