#include "tissue/rigid/rigid_body.h"

namespace trocar {

Mat3 RigidBody::inverse_inertia() const {
  const Vec3 squares = half.cwiseProduct(half);  // of a box: m/3 (b^2 + c^2) in half extents
  const Vec3 inertia =
      mass_kg / 3 * Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  return X_TB.R * inertia.cwiseInverse().asDiagonal() * X_TB.R.transpose();
}

void RigidBody::apply(const Vec3& impulse_T, const Vec3& point_T) {
  velocity_T += impulse_T / mass_kg;
  spin_T += inverse_inertia() * (point_T - X_TB.p).cross(impulse_T);
}

void RigidBody::drift(double dt_s) {
  X_TB.p += dt_s * velocity_T;
  const double angle = spin_T.norm() * dt_s;
  if (angle <= 0) return;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, spin_T.normalized()));
  X_TB.R = (turn * Eigen::Quaterniond(X_TB.R)).normalized().toRotationMatrix();
}

}  // namespace trocar
