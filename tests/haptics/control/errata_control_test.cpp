// Errata of the thesis, gravity, observer and contact: each test carries the printed formula, shows it fail and ours
// hold. The list with pages is docs/thesis_errata.md.
#include <gtest/gtest.h>

#include "haptics/contact/contact_renderer.h"
#include "haptics/control/gravity.h"
#include "haptics/control/passivity.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::errata_control_test {
namespace {

using test::Random;

/// Centre of mass of the platform group at home, mm, by the table's weights.
Vec3 centre_at_home_mm() {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const PlatformWeight& body : DeviceModel().platform_weights) {
    sum += body.weight_n * body.home_W;
    weight += body.weight_n;
  }
  return 1000 * sum / weight;
}

/// (4.3) to (4.7) as printed, mm; rotations about z, x and y of W'.
Vec3 centre_by_partial_rotations(double about_z, double about_x, double about_y) {
  const Vec3 home = centre_at_home_mm();
  const double Y = std::abs(home.y()), Z = std::abs(home.z()), r = std::hypot(Y, Z), beta = std::atan2(Z, Y);
  return {Y * std::sin(about_z) - Z * std::sin(about_y), -Y * std::cos(about_z) - r * std::cos(beta - about_x),
          -Z * std::cos(about_y) - r * std::sin(beta - about_x)};
}

TEST(ThesisErrata, Eq43To47AddThreeRotationsAndDoubleTheLeverAtHome) {
  const Vec3 printed = centre_by_partial_rotations(0, 0, 0), truth = centre_at_home_mm();
  EXPECT_LT((printed - Vec3(0, -8.0, -87.1)).norm(), 0.25) << "reference, from the printed 43.53 mm";
  EXPECT_LT((printed - 2 * truth).norm(), 1e-12);
  // Moment of the platform group about the centre of rotation, at home.
  const Vec3 weight(0, 0, -5.02);
  const Vec3 right = (truth / 1000).cross(weight), wrong = (printed / 1000).cross(weight);
  EXPECT_NEAR(wrong.norm() / right.norm(), 2, 1e-9);
  DeviceModel no_stylus;
  no_stylus.stylus_weight_n = 0;
  const ArmState home = arm_state(home_angles());
  const Vec3 ours = gravity_torque(no_stylus, home).head<3>();
  EXPECT_LT((ours + home.J_WS.block<3, 3>(3, 0).transpose() * right).norm(), 1e-14);
}

TEST(ThesisErrata, Eq41PrintsARoundedHeight) {
  EXPECT_NEAR(centre_at_home_mm().z(), -43.66, 0.005);
  EXPECT_GT(std::abs(centre_at_home_mm().z() - -43.53), 0.1);
  EXPECT_NEAR(centre_at_home_mm().y(), -4.0, 0.02) << "offsets of table 4.1 lie along Y as (4.2) uses them, not X";
  EXPECT_EQ(centre_at_home_mm().x(), 0);
}

TEST(ThesisErrata, Eq410NeedsTheElbowAxis) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const ArmState arm = arm_state(test::random_joints(random));
    const Vec3 moment = (arm.X_WS.p - arm.elbow_W).cross(Vec3(0, 0, -DeviceModel().stylus_weight_n));
    EXPECT_NEAR(gravity_torque({}, arm)[3], -moment.dot(arm.J_WS.col(3).tail<3>()), 1e-15);
  }
}

/// A hand moving at random through a spring wall at x = 0, sampled: positions.
std::vector<double> random_walk_through_a_wall(std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x{-0.005};
  double v = 0;
  for (int k = 0; k < 3000; ++k) {
    v += random.symmetric(0.05) - 0.02 * v - 0.5 * x.back();
    x.push_back(x.back() + v * 1e-3);
  }
  return x;
}

TEST(ThesisErrata, Eq417ObserverNeverSeesTheEnergyThatSamplingCreates) {
  constexpr double k = 150, T = 1e-3;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<double> x = random_walk_through_a_wall(seed);
    PassivityController ours({});
    double thesis = 0, least_thesis = 0, force_before = 0;
    int contacts = 0;
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double depth = std::max(0.0, x[i]), force = k * depth, dx = x[i] - x[i - 1];
      thesis += force * (dx / T);  // W(n) of (4.17), force and backward difference of the same sample
      least_thesis = std::min(least_thesis, thesis);
      ours.update({force, force_before * dx, dx, dx / T, 0.5 * force * depth});
      contacts += force_before == 0 && force > 0;
      force_before = force;
    }
    ASSERT_GT(contacts, 0) << "seed " << seed << " never met the wall";
    EXPECT_GE(least_thesis, 0) << "seed " << seed;
    EXPECT_LT(ours.min_energy_j(), -1e-7) << "seed " << seed;
  }
}

TEST(ThesisErrata, Fig416ClaimsFallingEnergyAtFirstContactButAPressRaisesIt) {
  constexpr double k = 150, depth = 0.010;
  constexpr int kSteps = 20000;  // slow: the sampling term is depth / kSteps of the whole
  PassivityController observer({});
  double before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double p = depth * i / kSteps, dx = depth / kSteps;
    observer.update({k * p, before * dx, dx, dx / 1e-3, 0.5 * k * p * p});
    if (i % 2000 == 0) {
      EXPECT_NEAR(observer.energy_j(), 0.5 * k * p * p, 0.5 * k * p * dx * 1.01) << "rises with the press";
    }
    before = k * p;
  }
  EXPECT_NEAR(observer.energy_j(), 0.5 * k * depth * depth, 1e-6);
}

TEST(ThesisErrata, Section333PrintsTheMomentWithTheLeverReversed) {
  // r is said to point from the end point to the origin of the stylus; the moment about the origin needs the reverse.
  ContactPatch patch;
  test::flat_patch(patch);
  const Vec3 tip(0.001, 0.002, -0.003), origin(0.05, 0, 0.10);
  const ContactResult felt = ContactRenderer(ContactLaw::kThesis).update(test::tip_down(tip), Twist{}, patch);
  ASSERT_TRUE(felt.contact);
  const Vec3 printed = (origin - tip).cross(felt.F_I_T.force), right = (tip - origin).cross(felt.F_I_T.force);
  EXPECT_LT((printed + right).norm(), 1e-15);
  // Virtual work about the origin: a small turn moves the end point by omega x (tip - origin).
  const Vec3 omega(0.3, -0.2, 0.1);
  EXPECT_NEAR(omega.dot(right), omega.cross(tip - origin).dot(felt.F_I_T.force), 1e-12);
  EXPECT_GT(std::abs(omega.dot(printed) - omega.cross(tip - origin).dot(felt.F_I_T.force)), 1e-3);
}

TEST(ThesisErrata, Section342CallsTheStallTorquePeakAndTheCommandMotorVoltage) {
  const Transmission t;
  EXPECT_NEAR(24 / 2.32 * t.torque_constant, 0.240, 1e-3) << "240 mNm is the stall torque at 24 V";
  EXPECT_NEAR(9660 * 2 * std::numbers::pi / 60, 1011.6, 0.05) << "rad/s without load, not 25.6";
  EXPECT_NEAR(t.amps_per_volt * 10 * t.torque_constant, 0.100, 1e-4) << "full command: 4.31 A in current mode";
}

}  // namespace
}  // namespace trocar::errata_control_test
