// Elastic cables: the rotor as a body behind a spring, against closed forms and energy.
#include "haptics/device/plant/plant_cable.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "haptics/device/plant/device_plant.h"
#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_cable_test {
namespace {

constexpr double kStep = 50e-6;

PlantParameters with_cables(PlantParameters p, double stiffness, double damping = 0.02) {
  for (CableParameters& cable : p.options.cable) cable = {stiffness, damping, 0.5};
  return p;
}

double rotor(const PlantParameters& p) { return p.channel[0].rotor_inertia / std::pow(p.channel[0].ratio, 2); }

/// Seconds between upward crossings of `level`, mean over the crossings of a trace.
template <class F>
double period_of(const F& value, int steps) {
  double last = value(), first_s = -1, last_s = 0;
  int crossings = 0;
  for (int n = 1; n <= steps; ++n) {
    const double now = value();
    if (last < 0 && now >= 0) {
      last_s = (n - now / (now - last)) * kStep;
      if (first_s < 0)
        first_s = last_s;
      else
        ++crossings;
    }
    last = now;
  }
  return (last_s - first_s) / crossings;
}

TEST(PlantCable, RotorBehindAHeldJointSwingsAtItsOwnFrequency) {
  const PlantParameters p = nominal_parameters();
  for (const double k : {50.0, 100.0, 200.0}) {
    PlantCable cable({k, 0, 0}, rotor(p), {});
    cable.place(0, 1.0);
    const double period = period_of(
        [&] {
          cable.drift(kStep / 2);
          cable.linearise(0, 0, 0, kStep);
          cable.advance(0, kStep);
          cable.drift(kStep / 2);
          return cable.angle();
        },
        4000);
    const double omega = std::sqrt(k / rotor(p));
    // The implicit midpoint swings slower by (omega dt)^2/12: 2 parts in 1000 at the stiffest.
    EXPECT_NEAR(2 * std::numbers::pi / period / omega, 1 - std::pow(omega * kStep, 2) / 12, 2e-4) << k;
  }
}

TEST(PlantCable, SpringAloneKeepsItsEnergyAtAnyStep) {
  for (const double dt : {50e-6, 1e-3, 1e-2}) {
    PlantCable cable({200, 0, 0}, 1.95e-5, {});
    cable.place(0.01, 2.0);
    // The midpoint rule keeps the energy at the ends of its steps.
    const double before = cable.energy(0);
    for (int n = 0; n < 1000; ++n) {
      cable.drift(dt / 2);
      cable.linearise(0, 0, 0, dt);
      cable.advance(0, dt);
      cable.drift(dt / 2);
    }
    EXPECT_NEAR(cable.energy(0) / before, 1, 1e-9) << dt;
  }
}

TEST(PlantCable, CarriesTheMotorsLoadWithItsStretch) {
  PlantParameters p = with_cables(test::conservative_parameters(), 100);
  p.gravity = 0;
  test::idealise_drive(p);
  DevicePlant plant(p);
  plant.clamp(true);
  plant.enable_amplifiers(true);
  JointVector tau;
  tau << 0.1, -0.05, 0.02, 0.2, -0.1, 0.03;
  plant.command_volts(test::volts_for(p, tau));
  for (int n = 0; n < 20000; ++n) plant.step(kStep, {});
  const JointVector stretch = (plant.motor_outputs() - plant.outputs()).head<kArmJoints>();
  EXPECT_LT((stretch - tau / 100).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(plant.motor_outputs()[kPinchChannel], plant.outputs()[kPinchChannel]) << "the pinch has no cable";
}

TEST(PlantCable, FreeMotionKeepsItsEnergy) {
  // Damping off: arm, rotors and springs together keep what they have (1e-4 relative a second at 50 us).
  PlantParameters p = with_cables(test::conservative_parameters(), 100, 0);
  DevicePlant plant(p);
  const double floor = plant.energy();
  JointVector qd;
  qd << 1.0, -0.8, 0.7, 1.5, -2.0, 3.0;
  plant.set_joint_rates(qd);
  const double start = plant.energy();
  double worst = 0, most_stretch = 0;
  for (int n = 0; n < 20000; ++n) {
    plant.step(kStep, {});
    worst = std::max(worst, std::abs(plant.energy() - start));
    most_stretch = std::max(most_stretch, (plant.motor_outputs() - plant.outputs()).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(most_stretch, 1e-6) << "the cables must have worked at all";
  EXPECT_LT(worst / (start - floor), 1e-4);
}

TEST(PlantCable, LegStopsAndWholeTurnsGiveNoEnergy) {
  // Seeds 1, 3 and 5 swing into leg stops, which take energy, and turn shoulder motors past half a turn.
  double lost = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    PlantParameters p = draw_parameters(seed);
    for (ChannelParameters& c : p.channel) {
      c.friction.coulomb = c.friction.viscous = 0;
      c.stop.lower = -std::numeric_limits<double>::infinity();
      c.stop.upper = std::numeric_limits<double>::infinity();
    }
    DevicePlant plant(with_cables(p, 50, 0));
    const double floor = plant.energy();
    JointVector qd;
    qd << 1.0, -0.8, 0.7, 1.5, -2.0, 3.0;
    plant.set_joint_rates(qd);
    const double start = plant.energy();
    double most = start;
    for (int n = 0; n < 40000; ++n) {
      plant.step(kStep, {});
      most = std::max(most, plant.energy());
    }
    EXPECT_LT((most - start) / (start - floor), 1e-4) << "seed " << seed;
    lost = std::max(lost, (start - plant.energy()) / (start - floor));
  }
  EXPECT_GT(lost, 0.01) << "some leg must have struck";
}

TEST(PlantCable, WhatIsLostIsWhatTheDampingMakesWarm) {
  PlantParameters p = with_cables(test::conservative_parameters(), 60, 0.02);
  p.gravity = 0;
  const auto balance = [&](double dt) {
    DevicePlant plant(p);
    plant.enable_amplifiers(true);
    plant.set_joint_rates(JointVector::Constant(1.0));
    // Ringing rotors: the load of a code that the plant then loses.
    JointVector tau = JointVector::Constant(0.2);
    plant.command_volts(test::volts_for(p, tau));
    for (int n = 0; n < std::lround(0.01 / dt); ++n) plant.step(dt, {});
    plant.enable_amplifiers(false);
    const double start = plant.energy();
    double warm = 0;
    for (int n = 0; n < std::lround(0.02 / dt); ++n) {
      const double before = plant.cable_loss();
      plant.step(dt, {});
      warm += 0.5 * dt * (before + plant.cable_loss());
    }
    return std::pair(start - plant.energy(), warm);
  };
  const auto [lost, warm] = balance(kStep);
  EXPECT_GT(lost, 1e-6);
  // The damping is taken at the end of the step: first order, so a quarter of the step has about a quarter of the gap.
  EXPECT_NEAR(lost / warm, 1, 0.1);
  const auto [fine_lost, fine_warm] = balance(kStep / 4);
  EXPECT_LT(std::abs(fine_lost / fine_warm - 1), 0.5 * std::abs(lost / warm - 1));
}

TEST(PlantCable, WhatASwingLosesIsWhatFrictionAndCablesTook) {
  for (const double stiffness : {0.0, 100.0}) {
    PlantParameters p = with_cables(nominal_parameters(), stiffness);
    for (ChannelParameters& c : p.channel) c.stop = test::conservative_parameters().channel[0].stop;
    DevicePlant plant(p);
    PlantRandom random(7);
    plant.place(test::random_joints(random, 30), 0.02);
    JointVector rates;
    rates << 0.8, -0.6, 0.7, 1.2, -1.0, 2.0;
    plant.set_joint_rates(rates);
    const double before = plant.energy(), taken_before = plant.dissipated_j();
    for (int n = 0; n < 4000; ++n) plant.step(kStep, {});
    const double lost = before - plant.energy(), taken = plant.dissipated_j() - taken_before;
    EXPECT_GT(taken, 3e-3) << stiffness;
    EXPECT_NEAR(lost, taken, 0.01 * taken) << stiffness << ": implicit friction loses a little by itself";
  }
}

TEST(PlantCable, AVeryStiffCableIsTheRigidDevice) {
  PlantParameters rigid = test::conservative_parameters(), stiff = with_cables(rigid, 1e4, 0.2);
  DevicePlant a(rigid), b(stiff);
  for (DevicePlant* plant : {&a, &b}) {
    plant->set_joint_rates(JointVector::Constant(0.5));
    for (int n = 0; n < 4000; ++n) plant->step(kStep, {});
  }
  EXPECT_LT((a.angles() - b.angles()).cwiseAbs().maxCoeff(), 2e-3);
}

TEST(PlantCable, MassMatrixWithoutRotorsIsSymmetricAndPositiveOverTheWorkspace) {
  DevicePlant elastic(with_cables(nominal_parameters(), 100)), rigid(nominal_parameters());
  PlantRandom random(22);
  for (int n = 0; n < 300; ++n) {
    const JointVector q = test::random_joints(random, 2.0);
    elastic.place(q, 0.02);
    rigid.place(q, 0.02);
    const Mat6 M = elastic.mass_matrix();
    EXPECT_LT((M - M.transpose()).cwiseAbs().maxCoeff(), 1e-15);
    const Eigen::SelfAdjointEigenSolver<Mat6> own(M, Eigen::EigenvaluesOnly),
        rotors(rigid.mass_matrix() - M, Eigen::EigenvaluesOnly);
    EXPECT_GT(own.eigenvalues().minCoeff(), 1e-6);
    EXPECT_GT(rotors.eigenvalues().minCoeff(), 0) << "what the cables hold apart is the rotors";
  }
}

TEST(PlantCable, FrictionIsSharedBetweenMotorAndJoint) {
  const PlantParameters p = nominal_parameters();
  const FrictionParameters whole = p.channel[0].friction;
  const FrictionParameters joint = friction_behind_cable(whole, {100, 0.02, 0.25});
  EXPECT_DOUBLE_EQ(joint.coulomb, 0.75 * whole.coulomb);
  EXPECT_DOUBLE_EQ(joint.viscous, 0.75 * whole.viscous);
  EXPECT_EQ(friction_behind_cable(whole, {}).coulomb, whole.coulomb);
}

TEST(PlantCable, AShakenElasticDeviceStaysFinite) {
  PlantParameters p = with_cables(nominal_parameters(), 50);
  DevicePlant plant(p);
  plant.enable_amplifiers(true);
  PlantRandom random(4);
  for (int n = 0; n < 40000; ++n) {
    if (n % 20 == 0) {
      ChannelVector volts;
      for (int i = 0; i < kChannels; ++i) volts[i] = random.symmetric(10);
      plant.command_volts(volts);
    }
    plant.step(kStep, {{test::random_vector(random, 5), Vec3::Zero()}, 0});
    ASSERT_TRUE(plant.motor_outputs().allFinite()) << n;
  }
  EXPECT_LT((plant.motor_outputs() - plant.outputs()).cwiseAbs().maxCoeff(), 0.1);
}

}  // namespace
}  // namespace trocar::plant_cable_test
