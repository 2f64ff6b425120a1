#include "haptics/control/damping_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trocar {

PlacedDamping place_damping(double power_w, const JointVector& qd, const JointVector& headroom,
                            const JointVector& weight) {
  PlacedDamping placed;
  if (!(power_w > 0) || !qd.allFinite()) return placed;
  std::array<bool, kArmJoints> held{};
  double left_w = power_w;
  while (left_w > 0 && placed.passes < kArmJoints) {
    double mobility = 0;  // qd^T Q^-1 qd of the joints that are free
    for (int i = 0; i < kArmJoints; ++i) {
      if (!held[static_cast<std::size_t>(i)]) mobility += weight[i] * weight[i] * qd[i] * qd[i];
    }
    if (mobility <= 0) break;
    ++placed.passes;
    const double multiplier = left_w / mobility;
    bool all_fit = true;
    for (int i = 0; i < kArmJoints; ++i) {
      if (held[static_cast<std::size_t>(i)]) continue;
      const double room = std::max(0.0, headroom[i]);
      placed.torque[i] = -multiplier * weight[i] * weight[i] * qd[i];
      if (std::abs(placed.torque[i]) <= room) continue;
      placed.torque[i] = -std::copysign(room, qd[i]);
      held[static_cast<std::size_t>(i)] = true;
      all_fit = false;
    }
    if (all_fit) return placed;
    left_w = power_w;
    for (int i = 0; i < kArmJoints; ++i) {
      if (held[static_cast<std::size_t>(i)]) left_w += placed.torque[i] * qd[i];
    }
  }
  placed.unplaced_w = std::max(0.0, power_w + placed.torque.dot(qd));
  return placed;
}

JointVector moving_joints(const JointVector& qd) {
  return (qd.array().abs() < kDampedFrom).select(JointVector::Zero(), qd);
}

JointVector headroom_against(const JointVector& qd, const JointVector& carried, const JointVector& limit) {
  JointVector room;
  for (int i = 0; i < kArmJoints; ++i) room[i] = std::max(0.0, limit[i] + std::copysign(1.0, qd[i]) * carried[i]);
  return room;
}

}  // namespace trocar
