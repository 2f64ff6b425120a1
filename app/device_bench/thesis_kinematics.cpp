#include "app/device_bench/thesis_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar::thesis {
namespace {

JointVector degrees(double a, double b, double c, double d, double e, double f) {
  return (JointVector() << a, b, c, d, e, f).finished() * kDegree;
}

/// Rows of a printed pose, millimetres in the last column.
Pose printed(const std::array<double, 12>& t) {
  Pose X;
  X.R << t[0], t[1], t[2], t[4], t[5], t[6], t[8], t[9], t[10];
  X.p = Vec3(t[3], t[7], t[11]) * 1e-3;
  return X;
}

/// (2.34), rotation from frame 4 to P'.
Mat3 elbow_rotation(double th4) {
  const double s = std::sin(th4), c = std::cos(th4);
  return (Mat3() << -c, s, 0, s, c, 0, 0, 0, -1).finished();
}

/// (2.34), frames 5 and 6 with the misprint in the last row put right.
Mat3 wrist_rotation(double th5, double th6) {
  const double s5 = std::sin(th5), c5 = std::cos(th5), s6 = std::sin(th6), c6 = std::cos(th6);
  return (Mat3() << s5 * c6, -s5 * s6, c5, -c5 * c6, c5 * s6, s5, -s6, -c6, 0).finished();
}

/// Elbow by (2.12), (2.13), (2.15): of the two intersections the one with PROJ < 0 (algorithm 1).
Vec3 elbow_of(const Vec3& A, const Vec3& Y_A) {
  const double reach = A.norm();
  const double along = (reach * reach + kLink1 * kLink1 - kLink2 * kLink2) / (2 * reach);
  const double aside = std::sqrt(std::max(0.0, kLink1 * kLink1 - along * along));
  const Vec3 first = A / reach * along + aside * Y_A, second = A / reach * along - aside * Y_A;
  return ((first - A) / kLink2).dot(Y_A) < 0 ? first : second;
}

}  // namespace

Frames printed_frames() {
  Frames f;
  f.R_PPprime << -0.57, -0.41, -0.71, -0.57, -0.41, 0.71, -0.57, 0.82, 0;
  f.R_WWprime << 0.71, 0.41, -0.57, 0, -0.82, -0.57, -0.71, 0.41, -0.57;
  return f;
}

Frames exact_frames() { return {rotation_W_Wprime(), rotation_P_Pprime()}; }

Pose forward(const JointVector& q, const Frames& frames) {
  const Mat3 R_Pprime = frames.R_WWprime.inverse() * spherical_parallel(q.head<3>()).R_WP * frames.R_PPprime;
  Pose X;
  X.p = R_Pprime * Vec3(-kLink1 - kLink2 * std::cos(q[3]), kLink2 * std::sin(q[3]), 0);
  X.R = R_Pprime * elbow_rotation(q[3]) * wrist_rotation(q[4], q[5]);
  return X;
}

JointVector inverse(const Pose& X_WS, const Frames& frames) {
  const double reach = X_WS.p.norm();
  const double cosine = (kLink1 * kLink1 + kLink2 * kLink2 - reach * reach) / (2 * kLink1 * kLink2);
  if (!(std::abs(cosine) <= 1)) return JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
  const double th4 = std::acos(cosine) - std::numbers::pi;                      // (2.10), (2.11)
  const Vec3 X_A = -X_WS.p / reach, N = X_A.cross(X_WS.R.col(2)).normalized();  // (2.14)
  const Vec3 P4 = elbow_of(X_WS.p, N.cross(X_A));
  Mat3 R_Pdoubleprime;  // (2.18)
  R_Pdoubleprime.col(2) = -P4 / kLink1;
  R_Pdoubleprime.col(1) = -N;
  R_Pdoubleprime.col(0) = R_Pdoubleprime.col(1).cross(R_Pdoubleprime.col(2));
  const Mat3 R_Pprime = R_Pdoubleprime * (Mat3() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();  // (2.44)
  const Mat3 R_WP = frames.R_WWprime * R_Pprime * frames.R_PPprime.inverse();               // (2.20)
  const Mat3 T = (R_Pprime * elbow_rotation(th4)).transpose() * X_WS.R;                     // (2.23)
  JointVector q;
  q << active_angles(R_WP), th4, std::atan2(T(1, 2), T(0, 2)), std::atan2(-T(2, 0), -T(2, 1));
  return q;
}

const std::array<Sample, 3>& samples() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  static const std::array<Sample, 3> all{
      {{"S1", degrees(42.19, 47.76, 45, -13.65, -81.49, 0), degrees(42.19, 47.68, 45.09, -13.88, -81.43, 0),
        printed({0, -1, 0, 0.15, -0.16, 0, -0.99, -5.9, 0.99, 0, -0.16, -272.02}), Vec3::Constant(nan)},
       {"S2", degrees(64.14, 59.65, 42.03, -28.74, -78.23, -42.37),
        degrees(64.13, 59.18, 42.13, -29.81, -77.82, -42.37),
        printed({0.89, -0.44, -0.07, -94.81, 0.13, 0.41, -0.9, -83.93, 0.42, 0.8, 0.43, -232.58}),
        Vec3(-96.0068, -84.5473, -232.6072) * 1e-3},
       {"S3", degrees(35.33, 27.64, 49.57, -59.6, -87.42, -95.41), degrees(36.13, 27.34, 50.77, -59.19, -88.46, -95.41),
        printed({0.96, -0.17, -0.2, 75.62, 0.08, 0.9, -0.41, -136.44, 0.25, 0.38, 0.89, -178.28}),
        Vec3(76.5527, -137.4529, -178.4934) * 1e-3}}};
  return all;
}

JointVector example() { return degrees(30, 20, 25, -60, -50, 120); }

const std::array<Vec3, 8>& example_positions_W() {
  static const std::array<Vec3, 8> positions{
      Vec3(85.63, 218.69, 27.87) * 1e-3,    Vec3(160.43, 136.80, -107.15) * 1e-3, Vec3(69.07, 212.23, 78.24) * 1e-3,
      Vec3(165.88, -29.75, -165.93) * 1e-3, Vec3(-60.13, -227.72, -21.49) * 1e-3, Vec3(165.88, -29.75, -165.93) * 1e-3,
      Vec3(-60.74, -227.14, 25.52) * 1e-3,  Vec3(-113.72, -172.95, 114.41) * 1e-3};
  return positions;
}

}  // namespace trocar::thesis
