#include "haptics/mapping/port_forces.h"

#include <algorithm>

namespace trocar {

Wrench PortForces::friction(double depth_m, double roll_rad, const Vec3& u) {
  if (!started_) {
    started_ = true;
    last_depth_m_ = depth_m;
    axial_m_ = roll_rad_ = 0;
    return {};
  }
  const double slip_m = p_.axial_friction_n / p_.axial_stiffness_n_per_m;
  const double slip_rad = p_.roll_friction_n_m / p_.roll_stiffness_n_m_per_rad;
  axial_m_ = std::clamp(axial_m_ + depth_m - last_depth_m_, -slip_m, slip_m);
  roll_rad_ = std::clamp(roll_rad_ + roll_rad, -slip_rad, slip_rad);
  last_depth_m_ = depth_m;
  return {-p_.axial_stiffness_n_per_m * axial_m_ * u, -p_.roll_stiffness_n_m_per_rad * roll_rad_ * u};
}

double PortForces::stored_j() const {
  return 0.5 *
         (p_.axial_stiffness_n_per_m * axial_m_ * axial_m_ + p_.roll_stiffness_n_m_per_rad * roll_rad_ * roll_rad_);
}

Wrench alignment_wrench(const InstrumentMap& map, const Pose& X_WS, double stiffness_n_m_per_rad) {
  if (!map.fulcrum) return {};
  const Pose X_TS = map.mapped_stylus(X_WS);
  const Vec3 w = map.fulcrum->followed_axis(X_TS.p).cross(X_TS.R.col(2)) * stiffness_n_m_per_rad;
  // The direction that Z6 is to have turns with the shaft: its moment acts on the handle as one on the instrument does.
  const Wrench on_handle = map.fulcrum->handle_wrench(X_TS, {Vec3::Zero(), w});
  const Mat3 R_WT = map.X_TW.R.transpose();
  return {map.motion_scale * (R_WT * on_handle.force), -(R_WT * w)};
}

double alignment_energy_j(const InstrumentMap& map, const Pose& X_WS, double stiffness_n_m_per_rad) {
  if (!map.fulcrum) return 0;
  const Pose X_TS = map.mapped_stylus(X_WS);
  return stiffness_n_m_per_rad * (1 - map.fulcrum->followed_axis(X_TS.p).dot(X_TS.R.col(2)));
}

}  // namespace trocar
