#include "scenarios/kinds/camera/scope_view.h"

#include <cmath>

namespace trocar {
namespace {

constexpr double kUpright = 1e-3;  // of "up" across the line of sight, below which level means nothing

}  // namespace

Mat3 picture_in_instrument(double tilt_rad) {
  Mat3 R_IC;
  R_IC.col(0) = Vec3::UnitY();
  R_IC.col(1) = -Vec3::UnitX();
  R_IC.col(2) = Vec3::UnitZ();
  return R_IC * Eigen::AngleAxisd(-tilt_rad, Vec3::UnitX()).toRotationMatrix();
}

std::optional<double> horizon_of(const Mat3& R_TC) {
  const double right = R_TC(2, 0), up = -R_TC(2, 1);
  if (std::hypot(right, up) < kUpright) return std::nullopt;
  return std::atan2(right, up);
}

Mat3 level_instrument(const Vec3& axis_T) {
  Mat3 R_TI;
  R_TI.col(1) = axis_T.cross(Vec3::UnitZ()).normalized();
  R_TI.col(0) = R_TI.col(1).cross(axis_T);
  R_TI.col(2) = axis_T;
  return R_TI;
}

}  // namespace trocar
