// The haptic loop on a plant with its options on: elastic cables, jitter, warm motors, missed counts, a hand that
// reacts.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/haptics/loop_rig.h"

namespace trocar::plant_options_loop_test {
namespace {

using test::LoopRig;
using test::working_pose;

constexpr double kWall = 300;  // N/m

SimulatedDaqConfig with_options(double cable = 100, int jitter = 2) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  for (CableParameters& c : device.plant->options.cable) c.stiffness = cable;
  device.plant->options.jitter_periods = jitter;
  device.plant->options.heat.on = true;
  return device;
}

/// Goes to the working pose, meets a floor 5 mm below at about 0.1 m/s with the hand's goal 15 mm in it, and stays.
void press(LoopRig& rig, double stiffness) {
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(0.3);
  rig.put_floor(0.005, stiffness);
  Pose into = rig.goal;
  into.p.z() -= 0.020;
  rig.move(into, 0.2);
  rig.records.clear();
  rig.keep = true;
  rig.run(1.5);
}

/// Peak to peak of the rendered force over the last half second.
double ripple(const LoopRig& rig) {
  double least = 1e9, most = -1e9;
  for (std::size_t i = rig.records.size() - 500; i < rig.records.size(); ++i) {
    const double force = rig.records[i].stylus.rendered_force_T.norm();
    least = std::min(least, force);
    most = std::max(most, force);
  }
  return most - least;
}

TEST(PlantOptionsLoop, AWallOf300StaysStableWithCablesJitterAndHeat) {
  for (const double cable : {50.0, 100.0, 200.0}) {
    LoopRig rig(with_options(cable));
    press(rig, kWall);
    ASSERT_FALSE(rig.record.stylus.fault) << fault_name(rig.record.stylus.fault.code) << " at " << cable;
    EXPECT_TRUE(rig.record.stylus.contact);
    EXPECT_GT(rig.record.stylus.rendered_force_T.norm(), 0.3);
    EXPECT_LT(ripple(rig), 0.2) << "N peak to peak, the rule of the Z-width protocol; cable " << cable;
    EXPECT_GT(rig.daq.plant().windings_c().maxCoeff(), 25.01) << "the motors have warmed up";
    EXPECT_LT(rig.daq.plant().windings_c().maxCoeff(), 125);
    EXPECT_EQ(rig.allocations, 0u);
  }
}

TEST(PlantOptionsLoop, TheWallCanAlsoBeTooStiff) {
  // Not every loop passes: without a law, at eight times the stiffness and 9 ms more delay, the same press hunts.
  SimulatedDaqConfig device = with_options();
  device.extra_delay_periods = 9;
  HapticLoopConfig loop;
  loop.passivity.law = PassivityLaw::kOff;
  LoopRig rig(device, loop);
  press(rig, 8 * kWall);
  const bool stopped = static_cast<bool>(rig.record.stylus.fault);
  EXPECT_TRUE(stopped || ripple(rig) > 0.2) << ripple(rig);
}

TEST(PlantOptionsLoop, TheControllersHeatAgreesWithThePlants) {
  // Two models written apart with the same [M] values: the controller's uses currents that it asked for.
  LoopRig rig(with_options(100, 0));
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(20);
  const double rise = rig.daq.plant().windings_c().maxCoeff() - 25;
  EXPECT_NEAR(rig.record.winding_c - 25, rise, 0.1 + 0.1 * rise) << "the hottest winding";
  EXPECT_GT(rise, 1);
}

TEST(PlantOptionsLoop, MissedCountsMoveThePoseThatTheLoopBelieves) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  device.plant->jig_error.setZero();
  const auto error_mm = [](const SimulatedDaqConfig& config) {
    LoopRig rig(config);
    rig.start();
    rig.move(working_pose(), 1.5);
    for (int k = 0; k < 3; ++k) {
      Pose aside = working_pose();
      aside.p.z() += 0.03;
      rig.move(aside, 0.5);
      rig.move(working_pose(), 0.5);
    }
    EXPECT_FALSE(rig.record.stylus.fault);
    return 1e3 * (rig.config.map.stylus_pose(rig.record.stylus.X_TI).p - rig.daq.sense().X_BS.p).norm();
  };
  const double whole = error_mm(device);
  device.plant->options.encoder.missed_per_edge = 0.02;
  EXPECT_LT(whole, 0.5);
  EXPECT_GT(error_mm(device), whole + 0.3) << "no fault says so: only homing puts it right";
}

TEST(PlantOptionsLoop, AReactingHandIsFirmHalfASecondAfterTheWall) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  device.hand = hand_parameters(GripPreset::kFingertip);
  device.hand.reaction.on = true;
  LoopRig rig(device);
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(1.0);
  ASSERT_FALSE(rig.daq.hand().reaction().touched()) << "free air is no touch";
  rig.put_floor(0.005, kWall);
  const Pose from = rig.goal;
  double touched_s = -1, closing_s = -1, firm_s = -1;
  for (int k = 0; k < 1200; ++k) {
    rig.goal.p.z() = from.p.z() - 0.045 * std::min(1.0, k / 150.0);  // 0.3 m/s
    rig.tick();
    const double t = rig.daq.time_s();
    if (touched_s < 0 && rig.record.stylus.contact) touched_s = t;
    if (closing_s < 0 && rig.daq.hand().reaction().firmness() > 0) closing_s = t;
    if (firm_s < 0 && rig.daq.hand().reaction().firmness() >= 1) firm_s = t;
  }
  ASSERT_GT(touched_s, 0);
  ASSERT_GT(firm_s, 0);
  EXPECT_GE(closing_s - touched_s, 0.150) << "no voluntary reaction before 150 ms";
  EXPECT_NEAR(firm_s - touched_s, 0.45, 0.06) << "what the fingers take to notice comes on top";
  EXPECT_NEAR(rig.daq.hand().acting().grip_stiffness, 900, 1e-9);
  EXPECT_FALSE(rig.record.stylus.fault);
}

}  // namespace
}  // namespace trocar::plant_options_loop_test
