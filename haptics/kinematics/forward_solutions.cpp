#include "haptics/kinematics/forward_solutions.h"

#include <cmath>

#include <Eigen/LU>

#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/link_clearance.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

constexpr std::array<const char*, kForwardSolutions> kMeaning{"working assembly mode (phi2, phi3): the device",
                                                              "assembly mode (phi2, phi3 + pi)",
                                                              "assembly mode (phi2 + pi, -phi3)",
                                                              "assembly mode (phi2 + pi, pi - phi3)",
                                                              "trivial, V = (-U1, -U2, U3): the legs turn freely",
                                                              "trivial, V = (-U1, U2, -U3): the legs turn freely",
                                                              "trivial, V = (U1, -U2, -U3): the legs turn freely",
                                                              "trivial, V = (U1, U2, U3): the legs turn freely"};

double determinant_a(const Vec3& theta, const Mat3& V) {
  const Vec3 s = theta.array().sin(), c = theta.array().cos();
  const Vec3 W[] = {{s[0], -c[0], 0}, {0, s[1], -c[1]}, {-c[2], 0, s[2]}};
  Mat3 A;
  for (int i = 0; i < 3; ++i) A.row(i) = W[i].cross(V.col(i)).transpose();
  return A.determinant();
}

}  // namespace

std::array<ForwardSolution, kForwardSolutions> forward_solutions(const JointVector& q) {
  const Vec3 theta = q.head<3>();
  const Mat3 R_WprimeW = rotation_W_Wprime().transpose();
  const ArmState arm = arm_state(q);
  const Pose X_PS = Pose{R_WprimeW * spherical_parallel(theta).R_WP, Vec3::Zero()}.inverse() * arm.X_WS;
  std::array<ForwardSolution, kForwardSolutions> all;
  for (int i = 0; i < kForwardSolutions; ++i) {
    ForwardSolution& one = all[static_cast<std::size_t>(i)];
    one.meaning = kMeaning[static_cast<std::size_t>(i)];
    one.trivial = i >= 4;
    one.R_WP = one.trivial ? trivial_assembly(i - 4) : assembly_mode(theta, i);
    one.X_WS = Pose{R_WprimeW * one.R_WP, Vec3::Zero()} * X_PS;
    one.residual = loop_residual(theta, one.R_WP);
    one.ring_room_m = link_clearance(theta, one.R_WP).ring_m;
    one.det_a = determinant_a(theta, one.R_WP);
  }
  return all;
}

}  // namespace trocar
