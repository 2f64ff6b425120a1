// Link l1 in the shoulder: the thesis' figure 2.12, symmetry, and a brute-force oracle.
#include "haptics/kinematics/link_clearance.h"

#include <gtest/gtest.h>

#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/spherical_parallel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::link_clearance_test {
namespace {

TEST(LinkClearance, OnlyTheWorkingModeOfFigure212IsClearOfTheBaseRing) {
  const Vec3 theta = Vec3(30, 20, 25) * kDegree;
  EXPECT_TRUE(link_clearance(theta, assembly_mode(theta, 0)).clear());
  for (int mode = 1; mode < 4; ++mode) {
    EXPECT_LT(link_clearance(theta, assembly_mode(theta, mode)).ring_m, 0) << "figure 2.12, solution " << mode + 1;
  }
}

TEST(LinkClearance, HangsFreelyAtHome) {
  const Vec3 home = home_angles().head<3>();
  const LinkClearance room = link_clearance(home, spherical_parallel(home).R_WP);
  EXPECT_GT(room.ring_m, 0.025);
  EXPECT_GT(room.legs_m, 0.010);
}

TEST(LinkClearance, RingIsACircleThroughTheActuatorsEnds) {
  // Platform turned about the ring's axis by any angle: l1 stays on the axis, whose distance from each actuator's end
  // is d1 times the sine of the angle between them.
  for (const double angle : {0.0, 0.4, 1.1}) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3::Constant(1 / std::sqrt(3.0))).toRotationMatrix();
    const double ring = link_clearance(Vec3::Constant(0.7), R).ring_m;
    EXPECT_NEAR(ring, kBaseRing * std::sqrt(2.0 / 3) - kLinkHalfWidth - kLegHalfWidth, 1e-12);
  }
}

TEST(LinkClearance, LegsAgreeWithBruteForce) {
  test::Random random(1);
  for (int k = 0; k < 50; ++k) {
    const JointVector q = test::random_joints(random, 4, 0.2);
    const SphericalParallelState shoulder = spherical_parallel(q.head<3>());
    const Vec3 elbow = arm_state(q).elbow_W;
    double nearest = 1;
    for (int i = 0; i < 3; ++i) {
      const Vec3 U = Vec3::Unit((i + 2) % 3), V = shoulder.R_WP.col(i);
      const Vec3 W = q[i] == 0 ? Vec3::Zero()
                               : Vec3(i == 0   ? Vec3(std::sin(q[0]), -std::cos(q[0]), 0)
                                      : i == 1 ? Vec3(0, std::sin(q[1]), -std::cos(q[1]))
                                               : Vec3(-std::cos(q[2]), 0, std::sin(q[2])));
      for (int a = 0; a <= 200; ++a) {
        const double angle = std::numbers::pi / 2 * a / 200;
        for (int s = 0; s <= 200; ++s) {
          const Vec3 on_link = rotation_W_Wprime() * elbow * (s / 200.0);
          nearest = std::min(nearest, (on_link - kProximalArc * (std::cos(angle) * U + std::sin(angle) * W)).norm());
          nearest = std::min(nearest, (on_link - kDistalArc * (std::cos(angle) * W + std::sin(angle) * V)).norm());
        }
      }
    }
    const double legs = link_clearance(q.head<3>(), shoulder.R_WP).legs_m;
    // 24 against 200 steps of a quarter arc of 40 mm: 1.3 mm chords, half of it at most; 0.4 mm along the link.
    EXPECT_NEAR(legs, nearest - kLinkHalfWidth - kLegHalfWidth, 1.0e-3);
  }
}

}  // namespace
}  // namespace trocar::link_clearance_test
