#include "haptics/control/torque_limiter.h"

#include <algorithm>
#include <cmath>

#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr double kSpringMargin = 8 * kDegree;       // where the springs begin
constexpr double kSpringStiffness = 3.0;            // N m/rad
constexpr double kSpringDamping = 0.02;             // N m s/rad
constexpr double kFadeFrom = 0.20, kFadeTo = 0.10;  // det A

}  // namespace

double TorqueLimiter::room(const TorqueShares& shares) const {
  const ChannelVector first = (shares.springs + shares.gravity).cwiseMax(-limit_).cwiseMin(limit_);
  double scale = 1;
  for (int i = 0; i < kChannels; ++i) {
    const double left = limit_[i] - std::copysign(1.0, shares.contact[i]) * first[i];
    if (std::abs(shares.contact[i]) > left) scale = std::min(scale, std::max(0.0, left) / std::abs(shares.contact[i]));
  }
  return scale;
}

LimitedTorque TorqueLimiter::update(const TorqueShares& shares) {
  LimitedTorque out;
  out.carried = (shares.springs + shares.gravity).cwiseMax(-limit_).cwiseMin(limit_);
  out.contact_scale = room(shares);
  const ChannelVector contact = shares.contact * out.contact_scale;
  const ChannelVector without = (out.carried + contact + shares.friction).cwiseMax(-limit_).cwiseMin(limit_);
  const ChannelVector wanted = (without + shares.alignment).cwiseMax(-limit_).cwiseMin(limit_);
  for (int i = 0; i < kChannels; ++i) {
    out.total[i] = std::clamp(wanted[i], last_[i] - step_[i], last_[i] + step_[i]);
  }
  out.contact = contact + (out.total - wanted);  // what the rate limit cut is taken from the contact's share
  last_ = out.total;
  return out;
}

ChannelVector limit_spring_torque(const JointVector& q, const JointVector& qd) {
  ChannelVector torque = ChannelVector::Zero();
  for (int i = 0; i < kArmJoints; ++i) {
    if (!kJointRange[i].limited) continue;
    const double below = kJointRange[i].low + kSpringMargin - q[i];
    const double above = q[i] - (kJointRange[i].high - kSpringMargin);
    if (below > 0) torque[i] = std::max(0.0, kSpringStiffness * below - kSpringDamping * qd[i]);
    if (above > 0) torque[i] = std::min(0.0, -kSpringStiffness * above - kSpringDamping * qd[i]);
  }
  return torque;
}

double singularity_share(double det_a) { return std::clamp((det_a - kFadeTo) / (kFadeFrom - kFadeTo), 0.0, 1.0); }

}  // namespace trocar
