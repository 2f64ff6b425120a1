// A turn of the wrist: the shortest rotation between two orientations with the time course of a minimum-jerk movement.
// Fixed memory; does not allocate.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

class TurnPlan {
 public:
  TurnPlan() = default;
  TurnPlan(const Mat3& R_from, const Mat3& R_to, double duration_s);
  Mat3 at(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  Mat3 R_from_ = Mat3::Identity();
  Vec3 axis_ = Vec3::UnitX();  ///< in the frame turned
  double angle_rad_ = 0, duration_s_ = 0.1;
};

/// Small rotation by a rotation vector, rad.
Mat3 rotation_by(const Vec3& rotation_vector);

}  // namespace trocar
