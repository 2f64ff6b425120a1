#include "haptics/kinematics/spherical_parallel.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace trocar {
namespace {

struct EulerZyx {
  double phi1, phi2, phi3;
};

EulerZyx working_mode(const Vec3& theta) {
  const double s1 = std::sin(theta[0]), c1 = std::cos(theta[0]);
  const double s2 = std::sin(theta[1]), c2 = std::cos(theta[1]);
  const double s3 = std::sin(theta[2]), c3 = std::cos(theta[2]);
  const double C1 = c3 * c1 * s2 * s1 - s3 * c2;
  const double C2 = s3 * s2 * s1 + c3 * c2 * c1;
  const double n = std::hypot(C1, C2);
  // phi3 without the quotient of (2.31), which is 0/0 on the face th1 = 90 deg where the pose itself is regular.
  return {theta[0], std::atan2(-C1, C2), std::atan2(s2 * n, c3 * (c2 * c2 + s2 * s2 * s1 * s1))};
}

Mat3 rotation_zyx(const EulerZyx& e) {
  return (Eigen::AngleAxisd(e.phi1, Vec3::UnitZ()) * Eigen::AngleAxisd(e.phi2, Vec3::UnitY()) *
          Eigen::AngleAxisd(e.phi3, Vec3::UnitX()))
      .toRotationMatrix();
}

/// Columns W1 W2 W3 (thesis 2.6).
Mat3 passive_axes(const Vec3& theta) {
  Mat3 axes;
  axes.col(0) << std::sin(theta[0]), -std::cos(theta[0]), 0;
  axes.col(1) << 0, std::sin(theta[1]), -std::cos(theta[1]);
  axes.col(2) << -std::cos(theta[2]), 0, std::sin(theta[2]);
  return axes;
}

}  // namespace

SphericalParallelState spherical_parallel(const Vec3& theta) {
  SphericalParallelState state;
  state.R_WP = rotation_zyx(working_mode(theta));
  const Mat3 W = passive_axes(theta);
  const Mat3& V = state.R_WP;
  const Vec3 U[3] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  Mat3 A;
  Vec3 B;
  for (int i = 0; i < 3; ++i) {
    A.row(i) = W.col(i).cross(V.col(i)).transpose();
    B[i] = U[i].cross(W.col(i)).dot(V.col(i));
  }
  state.det_a = A.determinant();
  state.rates = A.inverse() * B.asDiagonal();
  return state;
}

Mat3 assembly_mode(const Vec3& theta, int mode) {
  EulerZyx e = working_mode(theta);
  const double pi = std::numbers::pi;
  switch (mode) {
    case 1:
      e = {e.phi1, e.phi2, e.phi3 + pi};
      break;
    case 2:
      e = {e.phi1, e.phi2 + pi, -e.phi3};
      break;
    case 3:
      e = {e.phi1, e.phi2 + pi, pi - e.phi3};
      break;
    default:
      break;
  }
  return rotation_zyx(e);
}

Mat3 trivial_assembly(int index) {
  const double s = index % 2 == 0 ? 1 : -1;  // T_TO1 and T_TO3 against T_TO2 and T_TO4
  const double z = index < 2 ? -1 : 1;
  return (Mat3() << 0, -s, 0, 0, 0, -z * s, z, 0, 0).finished();
}

double loop_residual(const Vec3& theta, const Mat3& R_WP) {
  return (passive_axes(theta).cwiseProduct(R_WP)).colwise().sum().cwiseAbs().maxCoeff();
}

Vec3 active_angles(const Mat3& R_WP) {
  return {std::atan2(R_WP(1, 0), R_WP(0, 0)), std::atan2(R_WP(2, 1), R_WP(1, 1)), std::atan2(R_WP(0, 2), R_WP(2, 2))};
}

}  // namespace trocar
