#include "haptics/device/plant/device_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_dynamics_test {
namespace {

using test::kDegree;

constexpr double kStep = 50e-6;

// Kinetic energy from nothing but differences of positions: oracle for the mass matrix.
double kinetic_energy_by_differences(const PlantParameters& p, const JointVector& q, const JointVector& qd) {
  const Mat3& R_WB = base_rotation_WB();
  const Mat3 R_WP_home = configuration_at(home_joint_angles(p.link1, p.link2)).q_WP.toRotationMatrix();
  const double h = 1e-4;
  const auto rate = [&](const auto& f) {
    using Value = decltype(f(q));
    const auto at = [&](double t) { return f(JointVector(q + t * qd)); };
    return Value((at(-2 * h) - at(2 * h) + 8.0 * (at(h) - at(-h))) / (12.0 * h));
  };
  const auto spin = [](const Mat3& R_dot, const Mat3& R) {
    const Mat3 s = R_dot * R.transpose();
    return Vec3(s(2, 1), s(0, 2), s(1, 0));
  };
  const auto platform = [](const JointVector& x) { return Mat3(configuration_at(x).q_WP.toRotationMatrix()); };
  const auto kin = [&](const JointVector& x) { return evaluate_kinematics(configuration_at(x), p.link1, p.link2); };
  double energy = 0;
  for (const PlatformMass& m : p.platform_masses) {
    const Vec3 r_P = R_WP_home.transpose() * R_WB * m.position_home;
    energy += 0.5 * m.mass * rate([&](const JointVector& x) { return Vec3(platform(x) * r_P); }).squaredNorm();
  }
  energy += 0.5 * p.platform_inertia * spin(rate(platform), platform(q)).squaredNorm();
  const Vec3 v = rate([&](const JointVector& x) { return Vec3(kin(x).p6 + kin(x).R_W6 * p.stylus_com); });
  const Mat3 R6 = kin(q).R_W6;
  const Vec3 w6 = R6.transpose() * spin(rate([&](const JointVector& x) { return Mat3(kin(x).R_W6); }), R6);
  energy += 0.5 * p.stylus_mass * v.squaredNorm() + 0.5 * w6.dot(p.stylus_inertia.cwiseProduct(w6));
  for (int i = 0; i < kArmJoints; ++i) {
    const ChannelParameters& c = p.channel[i];
    energy += 0.5 * c.rotor_inertia * std::pow(qd[i] / c.ratio, 2);
  }
  return energy;
}

JointVector random_rates(PlantRandom& random, double half_width) {
  JointVector qd;
  for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(half_width);
  return qd;
}

TEST(PlantDynamics, KineticEnergyAgreesWithDifferencesOfPositions) {
  PlantParameters p = draw_parameters(5);  // off-centre masses, so that no term hides behind a zero
  p.gravity = 0;
  p.stylus_com = {0.004, -0.003, 0.006};
  DevicePlant plant(p);
  PlantRandom random(21);
  for (int n = 0; n < 30; ++n) {
    const JointVector q = test::random_joints(random), qd = random_rates(random, 4.0);
    plant.place(q, 0.02);
    plant.set_joint_rates(qd);
    const double oracle = kinetic_energy_by_differences(p, q, qd);
    EXPECT_NEAR(plant.energy(), oracle, 1e-8 * oracle);
  }
}

TEST(PlantDynamics, MassMatrixIsSymmetricAndPositiveOverTheWorkspace) {
  DevicePlant plant(nominal_parameters());
  PlantRandom random(22);
  for (int n = 0; n < 500; ++n) {
    plant.place(test::random_joints(random, 2.0), 0.02);
    const Mat6 M = plant.mass_matrix();
    EXPECT_LT((M - M.transpose()).cwiseAbs().maxCoeff(), 1e-15);
    const Eigen::SelfAdjointEigenSolver<Mat6> eigen(M, Eigen::EigenvaluesOnly);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 1e-6);  // kg m2; the lightest motion is the roll, 3e-5
  }
}

TEST(PlantDynamics, HoldingTorqueIsTheGradientOfThePotential) {
  DevicePlant plant(draw_parameters(6));
  PlantRandom random(23);
  for (int n = 0; n < 30; ++n) {
    const JointVector q = test::random_joints(random);
    const auto potential = [&](const JointVector& x) {
      plant.place(x, 0.02);
      return plant.energy();
    };
    JointVector gradient;
    for (int i = 0; i < kArmJoints; ++i) gradient[i] = test::derivative(potential, q, i);
    plant.place(q, 0.02);
    EXPECT_LT((plant.holding_torque() - gradient).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(PlantDynamics, HoldingTorqueAtHomeIsThePublishedOne) {
  JointVector published;  // four printed digits
  published << 0.0224, -0.0224, 0, -0.0144, 0, 0;
  EXPECT_LT((DevicePlant(nominal_parameters()).holding_torque() - published).cwiseAbs().maxCoeff(), 5.1e-5);
}

// The motors balance weight and an outside wrench through a Jacobian made of differences alone: virtual work.
TEST(PlantDynamics, WrenchAndMotorsBalanceByVirtualWork) {
  PlantParameters p = test::conservative_parameters();
  test::idealise_drive(p);
  DevicePlant plant(p);
  PlantRandom random(24);
  const auto pose = [&](const JointVector& x) {
    return stylus_pose(evaluate_kinematics(configuration_at(x), p.link1, p.link2));
  };
  for (int n = 0; n < 30; ++n) {
    const JointVector q = test::random_joints(random);
    const Vec3 force = test::random_vector(random, 2.0), moment = test::random_vector(random, 0.2);
    JointVector tau;  // J^T w
    for (int i = 0; i < kArmJoints; ++i) {
      const Vec3 v = test::derivative([&](const JointVector& x) { return pose(x).p; }, q, i);
      const Mat3 s = test::derivative([&](const JointVector& x) { return pose(x).R; }, q, i) * pose(q).R.transpose();
      tau[i] = v.dot(force) + Vec3(s(2, 1), s(0, 2), s(1, 0)).dot(moment);
    }
    plant.place(q, 0.02);
    plant.enable_amplifiers(true);
    plant.command_volts(test::volts_for(p, plant.holding_torque() - tau));
    // The least inertia is 3e-5 kg m2: a torque error of 1e-9 N m gives 3.4e-5 rad/s2.
    plant.step(1e-6, {{force, moment}, 0});
    EXPECT_LT(plant.rates().cwiseAbs().maxCoeff() / 1e-6, 3.4e-5) << "pose " << n;
  }
}

double swing_drift(const PlantParameters& p, const JointVector& q, const JointVector& qd, double seconds) {
  DevicePlant plant(p);
  plant.place(q, 0.02);
  const double floor = plant.energy();
  plant.set_joint_rates(qd);
  const double start = plant.energy(),
               scale = start - floor;  // the motion's own energy, not the arbitrary potential zero
  double worst = 0;
  const int steps = static_cast<int>(seconds / kStep);
  for (int n = 0; n < steps; ++n) {
    plant.step(kStep, {});
    worst = std::max(worst, std::abs(plant.energy() - start));
  }
  return worst / scale / seconds;
}

TEST(PlantDynamics, FreeMotionKeepsItsEnergy) {
  const PlantParameters p = test::conservative_parameters();
  JointVector qd;
  qd << 1.0, -0.8, 0.7, 1.5, -2.0, 3.0;
  EXPECT_LT(swing_drift(p, home_joint_angles(p.link1, p.link2), qd, 2.0), 1e-4);
}

TEST(PlantDynamics, WeightlessMotionKeepsItsEnergyFromManyPoses) {
  PlantParameters p = test::conservative_parameters();
  p.gravity = 0;
  PlantRandom random(25);
  for (int n = 0; n < 10; ++n) {
    const JointVector q = test::random_joints(random, 25);
    EXPECT_LT(swing_drift(p, q, random_rates(random, 2.0), 0.1), 1e-4) << "pose " << n;
  }
}

TEST(PlantDynamics, StepIsOfSecondOrder) {
  const PlantParameters p = test::conservative_parameters();
  const auto swing = [&](double dt) {
    DevicePlant plant(p);
    plant.set_joint_rates(JointVector::Constant(0.8));
    for (int n = 0; n < static_cast<int>(std::lround(0.1 / dt)); ++n) plant.step(dt, {});
    return plant.angles();
  };
  const JointVector fine = swing(12.5e-6);
  const double coarse = (swing(400e-6) - fine).norm(), half = (swing(200e-6) - fine).norm();
  EXPECT_GT(coarse / half, 3.0);  // 4 for second order, 2 for first
}

TEST(PlantDynamics, WorkOfAForceBecomesKineticEnergy) {
  PlantParameters p = test::conservative_parameters();
  p.gravity = 0;
  DevicePlant plant(p);
  const Wrench push{{0.3, -0.2, 0.4}, {0.01, 0.02, -0.01}};
  double work = 0;
  for (int n = 0; n < 2000; ++n) {
    const Twist before = plant.motion().V_BS;
    plant.step(kStep, {push, 0});
    const Twist after = plant.motion().V_BS;
    work += 0.5 * kStep * push.force.dot(before.linear + after.linear);
    work += 0.5 * kStep * push.moment.dot(before.angular + after.angular);
  }
  EXPECT_GT(work, 1e-3);
  EXPECT_NEAR(plant.energy(), work, 1e-3 * work);
}

TEST(PlantDynamics, MotionIsTheDerivativeOfThePose) {
  DevicePlant plant(nominal_parameters());
  plant.set_joint_rates(JointVector::Constant(1.0));
  for (int n = 0; n < 10; ++n) plant.step(kStep, {});
  const StylusMotion before = plant.motion();
  plant.step(kStep, {});
  const StylusMotion after = plant.motion();
  const Vec3 v = (after.X_BS.p - before.X_BS.p) / kStep;
  const Eigen::AngleAxisd turn(after.X_BS.R * before.X_BS.R.transpose());
  EXPECT_LT((v - 0.5 * (before.V_BS.linear + after.V_BS.linear)).norm(), 1e-4 * v.norm());
  const Vec3 w = turn.angle() / kStep * turn.axis();
  EXPECT_LT((w - 0.5 * (before.V_BS.angular + after.V_BS.angular)).norm(), 1e-4 * w.norm());
}

}  // namespace
}  // namespace trocar::plant_dynamics_test
