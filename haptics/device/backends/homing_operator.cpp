#include "haptics/device/backends/homing_operator.h"

#include <algorithm>

#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr int kRollJoint = kArmJoints - 1;
constexpr double kAway_deg = 13, kInLight_deg = 4.5;  // dark; surely lit
constexpr double kRate = 12 * kDegree;                // a second: less than a count in each of 1000 periods
constexpr double kQuickest_s = 0.3, kLook_s = 0.3;
/// Ways from the jig on which every joint passes a mark and no limit, deg.
constexpr double kLow_deg[] = {-41, -41, -41, -84, -42, -42}, kHigh_deg[] = {42, 42, 42, 0, 42, 42};

}  // namespace

double HomingOperator::drawn(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

void HomingOperator::lead(const JointVector& to) {
  const double seconds = std::max(kQuickest_s, (to - at_).cwiseAbs().maxCoeff() / kRate);
  world_.lead_arm(to, seconds);
  at_ = to;
  busy_until_s_ = world_.time_s() + seconds + kLook_s;
}

void HomingOperator::follow(const HomingReport& homing) {
  if (world_.time_s() < busy_until_s_) return;
  JointVector to = JointVector::Zero();
  if (homing.step == HomingStep::kMarks) {
    int joint = 0;
    while (joint + 1 < kArmJoints && !(homing.missing >> joint & 1)) ++joint;
    to[joint] = kDegree * (sweep_++ % 2 == 0 ? kLow_deg : kHigh_deg)[joint];
    return lead(to);
  }
  if (homing.step == HomingStep::kJig) {
    to[kRollJoint] = kDegree * drawn(-kInLight_deg, kInLight_deg);
    return lead(to);
  }
  if (homing.step != HomingStep::kRoll) return;
  side_ = -side_;
  to[kRollJoint] = kDegree * side_ * kAway_deg;
  lead(to);
}

}  // namespace trocar
