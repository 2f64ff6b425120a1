#include "haptics/device/plant/plant_kinematics.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kRoot2 = std::numbers::sqrt2;
constexpr double kRoot3 = std::numbers::sqrt3;
constexpr double kRoot6 = kRoot2 * kRoot3;

// R_P_P': exact roots.
const Mat3& platform_rotation() {
  static const Mat3 R = (Mat3() << -1 / kRoot3, -1 / kRoot6, -1 / kRoot2,  //
                         -1 / kRoot3, -1 / kRoot6, 1 / kRoot2,             //
                         -1 / kRoot3, 2 / kRoot6, 0)
                            .finished();
  return R;
}

// U1 = z, U2 = x, U3 = y of W are written out in the components below.
void fill_shoulder(PlantKinematics& k) {
  const Mat3& V = k.R_WP;
  // In-plane components (x, y) of V_i about U_i: th_i = atan2(y, x) (2.21).
  const double x[3] = {V(0, 0), V(1, 1), V(2, 2)};
  const double y[3] = {V(1, 0), V(2, 1), V(0, 2)};
  double c[3], s[3];
  for (int i = 0; i < 3; ++i) {
    k.b[i] = std::hypot(x[i], y[i]);
    c[i] = x[i] / k.b[i];
    s[i] = y[i] / k.b[i];
    k.shoulder[i] = std::atan2(y[i], x[i]);
  }
  k.W << s[0], 0, -c[2], -c[0], s[1], 0, 0, -c[1], s[2];
  k.UxW << c[0], 0, s[2], s[0], c[1], 0, 0, s[1], c[2];
  for (int i = 0; i < 3; ++i) k.Sp.row(i) = k.W.col(i).cross(V.col(i)).transpose() / k.b[i];
}

Mat6 pose_jacobian(const PlantKinematics& k) {
  Mat6 S = Mat6::Identity();
  S.topLeftCorner<3, 3>() = k.Sp;
  Mat6 J_nu;
  J_nu << stylus_point_jacobian(k, k.p6), stylus_angular_jacobian(k);
  return J_nu * S.inverse();
}

}  // namespace

const Mat3& base_rotation_WB() {
  static const Mat3 R = (Mat3() << 1 / kRoot2, 1 / kRoot6, -1 / kRoot3,  //
                         0, -2 / kRoot6, -1 / kRoot3,                    //
                         -1 / kRoot2, 1 / kRoot6, -1 / kRoot3)
                            .finished();
  return R;
}

PlantKinematics evaluate_kinematics(const PlantConfiguration& c, double link1, double link2) {
  PlantKinematics k;
  k.R_WP = c.q_WP.toRotationMatrix();
  fill_shoulder(k);
  const Mat3 R_WPp = k.R_WP * platform_rotation();
  const double s4 = std::sin(c.serial[0]), c4 = std::cos(c.serial[0]);
  const double s45 = std::sin(c.serial[0] + c.serial[1]), c45 = std::cos(c.serial[0] + c.serial[1]);
  const double s6 = std::sin(c.serial[2]), c6 = std::cos(c.serial[2]);
  // Table 2.6: P' to 4 turns the z axis over, 5 adds -90 deg, 6 tilts by -90 deg about x.
  const Vec3 x5 = R_WPp * Vec3(-s45, -c45, 0);
  const Vec3 y5 = R_WPp * Vec3(-c45, s45, 0);
  k.z4 = -R_WPp.col(2);
  k.p4 = -link1 * R_WPp.col(0);
  k.p6 = k.p4 + link2 * (R_WPp * Vec3(-c4, s4, 0));
  k.z6 = y5;
  k.R_W6.col(0) = c6 * x5 - s6 * k.z4;
  k.R_W6.col(1) = -s6 * x5 - c6 * k.z4;
  k.R_W6.col(2) = y5;
  return k;
}

PlantConfiguration configuration_at(const JointVector& q) {
  const double s1 = std::sin(q[0]), c1 = std::cos(q[0]), s2 = std::sin(q[1]), c2 = std::cos(q[1]);
  const double s3 = std::sin(q[2]), c3 = std::cos(q[2]);
  const double C1 = c3 * c1 * s2 * s1 - s3 * c2;
  const double C2 = s3 * s2 * s1 + c3 * c2 * c1;
  const double phi2 = std::atan2(-C1, C2);
  const double phi3 = std::atan2(s2 * std::hypot(C1, C2), c3 * (c2 * c2 + s2 * s2 * s1 * s1));
  PlantConfiguration c;
  c.q_WP = Eigen::AngleAxisd(q[0], Vec3::UnitZ()) * Eigen::AngleAxisd(phi2, Vec3::UnitY()) *
           Eigen::AngleAxisd(phi3, Vec3::UnitX());
  c.serial = q.tail<3>();
  return c;
}

Pose stylus_pose(const PlantKinematics& k) {
  const Mat3 R_BW = base_rotation_WB().transpose();
  return {R_BW * k.R_W6, R_BW * k.p6};
}

JointVector joint_angles(const PlantConfiguration& c, const PlantKinematics& k) {
  JointVector q;
  q << k.shoulder, c.serial;
  return q;
}

NuJacobian stylus_point_jacobian(const PlantKinematics& k, const Vec3& point_W) {
  const Vec3 arm = point_W - k.p6;
  NuJacobian J;
  J.leftCols<3>() << 0, point_W[2], -point_W[1], -point_W[2], 0, point_W[0], point_W[1], -point_W[0], 0;
  J.col(3) = k.z4.cross(point_W - k.p4);
  J.col(4) = k.z4.cross(arm);
  J.col(5) = k.z6.cross(arm);
  return J;
}

NuJacobian stylus_angular_jacobian(const PlantKinematics& k) {
  NuJacobian J;
  J << Mat3::Identity(), k.z4, k.z4, k.z6;
  return J;
}

Vec3 shoulder_bias(const PlantKinematics& k, const Vec3& omega_p) {
  Vec3 bias;
  for (int i = 0; i < 3; ++i) {
    const Vec3 V = k.R_WP.col(i), V_dot = omega_p.cross(V);
    const Vec3 s = k.Sp.row(i).transpose();
    const double rate = s.dot(omega_p);
    const Vec3 a_dot = rate * k.UxW.col(i).cross(V) + k.W.col(i).cross(V_dot);
    const double b_dot = k.UxW.col(i).dot(V_dot);  // U x W' is along W, and W . V = 0
    bias[i] = (a_dot - s * b_dot).dot(omega_p) / k.b[i];
  }
  return bias;
}

JointVector home_joint_angles(double link1, double link2) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Vec3 p_home(0, -0.006, -0.272);
  const Mat3 R_home = (Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  const Mat3& R_WB = base_rotation_WB();
  JointVector q;
  q << 42.0, 48.0, 45.0, -14.0, -81.0, 0.0;  // start of the iteration
  q *= kDegree;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const PlantKinematics k = evaluate_kinematics(configuration_at(q), link1, link2);
    const Eigen::AngleAxisd turn(R_WB * R_home * k.R_W6.transpose());
    Vec6 error;
    error << R_WB * p_home - k.p6, turn.angle() * turn.axis();
    q += pose_jacobian(k).partialPivLu().solve(error);
  }
  return q;
}

}  // namespace trocar
