#include "scenarios/hands/turn_plan.h"

#include <cmath>
#include <numbers>

#include "haptics/least_turn.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

Mat3 rotation_by(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle < 1e-12) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

TurnPlan::TurnPlan(const Mat3& R_from, const Mat3& R_to, double duration_s) : R_from_(R_from), duration_s_(duration_s) {
  const Eigen::AngleAxisd turn(Mat3(R_from.transpose() * R_to));
  axis_ = turn.axis();
  angle_rad_ = turn.angle();
}

Wrist::Held Wrist::held(const Mat3& R_TI) const {
  const Vec3 shaft = R_TI.col(2), hinge = R_TI.col(0);
  const Vec3 unrolled = least_turn(R_TI_first_.col(2), shaft) * R_TI_first_.col(0);
  return {shaft, std::atan2(unrolled.cross(hinge).dot(shaft), unrolled.dot(hinge))};
}

Wrist::Held Wrist::held(const Mat3& R_TI, const Held& near) const {
  Held out = held(R_TI);
  out.roll_rad = near.roll_rad + std::remainder(out.roll_rad - near.roll_rad, 2 * std::numbers::pi);
  return out;
}

Mat3 Wrist::holding(const Held& held) const {
  const Eigen::Quaterniond swing = least_turn(R_TI_first_.col(2), held.shaft_T);
  return Eigen::AngleAxisd(held.roll_rad, held.shaft_T).toRotationMatrix() * (swing * R_TI_first_);
}

Mat3 WristPlan::at(double t_s) const {
  const double share = minimum_jerk(t_s / duration_s_);
  return wrist_.holding({(from_.shaft_T + share * (to_.shaft_T - from_.shaft_T)).normalized(),
                         from_.roll_rad + share * (to_.roll_rad - from_.roll_rad)});
}

Mat3 TurnPlan::at(double t_s) const {
  return R_from_ * rotation_by(axis_ * (angle_rad_ * minimum_jerk(t_s / duration_s_)));
}

}  // namespace trocar
