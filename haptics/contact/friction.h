// Friction feed-forward: part of the identified Coulomb and viscous torque, never at rest.
//
// tau = share (tau_c tanh(qd / v0) + b qd), share <= 0.7, off inside the dead band and while the passivity budget is in
// debt: compensating stiction from the sign of a noisy velocity makes a limit cycle. The rates are smoothed first:
// friction hardly changes with speed, so what lag costs is little, and the knee can lie near rest without noise
// crossing it. A joint that has turned back is not helped until its smoothed rate has too. Thread: haptic task; no
// allocation.
#pragma once

#include <cmath>

#include "haptics/device/device_model.h"

namespace trocar {

struct FrictionFeedForward {
  double share = 0.7;        ///< the most that budgets allow; never more than kOfSure of what friction surely takes
  double knee_rad_s = 0.03;  ///< v0: 3 times the noise of the smoothed rates (`trocar study transparency`)
  double dead_band_rad_s = 0.02;
  double smoothing_s = 0.02;  ///< time constant of the rates' low-pass
  double debt_j = 1e-4;       ///< most that the passivity budget may owe: six joints that turn back owe half of it
  double play_rad = 1e-3;     ///< way that friction gives back when a joint turns, half [assumed: the plant's bristles]

  static constexpr double kOfSure = 0.92;
};

inline JointVector friction_torque(const DeviceModel& model, const FrictionFeedForward& p, const JointVector& qd) {
  JointVector torque;
  for (int i = 0; i < kArmJoints; ++i) {
    const double moving = std::abs(qd[i]) > p.dead_band_rad_s ? 1 : 0;
    torque[i] = moving * p.share * (model.coulomb[i] * std::tanh(qd[i] / p.knee_rad_s) + model.viscous[i] * qd[i]);
  }
  return torque;
}

/// Low-pass of the joint rates for the feed-forward, rad/s.
class SmoothedRates {
 public:
  SmoothedRates(const FrictionFeedForward& p, double period_s)
      : gain_(p.smoothing_s > 0 ? 1 - std::exp(-period_s / p.smoothing_s) : 1) {}

  void reset() { rate_.setZero(); }
  /// One period. @return smoothed rates, zero where a joint moves the other way by now.
  JointVector update(const JointVector& qd) {
    rate_ += gain_ * (qd - rate_);
    return (rate_.array() * qd.array() >= 0).select(rate_, 0);
  }

 private:
  double gain_;
  JointVector rate_ = JointVector::Zero();
};

}  // namespace trocar
