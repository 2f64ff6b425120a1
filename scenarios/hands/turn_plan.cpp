#include "scenarios/hands/turn_plan.h"

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

Mat3 TurnPlan::at(double t_s) const {
  return R_from_ * rotation_by(axis_ * (angle_rad_ * minimum_jerk(t_s / duration_s_)));
}

}  // namespace trocar
