#include "haptics/device/plant/plant_motor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trocar::plant_motor_test {
namespace {

PlantMotor joint_motor(const PlantParameters& p) { return {p.channel[0], p}; }

double settled(PlantMotor& motor, double volts, double rate) {
  double load = 0;
  for (int n = 0; n < 100; ++n) load = motor.advance(volts, rate, 50e-6);
  return load;
}

TEST(PlantMotor, FullCommandIsOneHundredMillinewtonMetresAtTheMotor) {
  const PlantParameters p = nominal_parameters();
  PlantMotor motor = joint_motor(p);
  const double load = settled(motor, 10.0, 0.0);
  EXPECT_NEAR(motor.current(), 4.31, 1e-9);
  EXPECT_NEAR(load * p.channel[0].ratio, 0.100, 1e-4);
  EXPECT_NEAR(load, 0.4348, 1e-4);
  EXPECT_NEAR(settled(motor, -10.0, 0.0), -load, 1e-12);
}

TEST(PlantMotor, CurrentFollowsWithTheAmplifiersTimeConstant) {
  const PlantParameters p = nominal_parameters();
  PlantMotor motor = joint_motor(p);
  motor.advance(1.0, 0.0, p.amplifier_time_constant);
  EXPECT_NEAR(motor.current(), 0.431 * (1 - std::exp(-1.0)), 1e-12);
  PlantMotor in_steps = joint_motor(p);
  for (int n = 0; n < 8; ++n) in_steps.advance(1.0, 0.0, p.amplifier_time_constant / 8);
  EXPECT_NEAR(in_steps.current(), motor.current(), 1e-12) << "the step must be exact";
}

TEST(PlantMotor, BackEmfEatsTheHeadroom) {
  const PlantParameters p = nominal_parameters();
  const ChannelParameters& c = p.channel[0];
  PlantMotor motor = joint_motor(p);
  const double rate = 0.8 * p.bus_voltage / c.torque_constant * c.ratio;  // 80 % of no-load speed
  settled(motor, 10.0, rate);
  EXPECT_NEAR(motor.current(), 0.2 * p.bus_voltage / c.resistance, 1e-9);
  settled(motor, 10.0, rate * 1.5);
  EXPECT_NEAR(motor.current(), 0.0, 1e-12) << "no drive beyond no-load speed";
  settled(motor, -10.0, rate);
  EXPECT_NEAR(motor.current(), -4.31, 1e-9) << "braking has headroom";
}

TEST(PlantMotor, AmplifierPeakBoundsTheCurrent) {
  PlantParameters p = nominal_parameters();
  p.bus_voltage = 80;
  PlantMotor motor = joint_motor(p);
  settled(motor, 100.0, 0.0);
  EXPECT_NEAR(motor.current(), p.current_limit, 1e-9);
}

TEST(PlantMotor, InhibitTakesTheCurrentAwayAtOnce) {
  const PlantParameters p = nominal_parameters();
  PlantMotor motor = joint_motor(p);
  settled(motor, 10.0, 0.0);
  motor.cut();
  EXPECT_EQ(motor.output_load(), 0.0);
}

}  // namespace
}  // namespace trocar::plant_motor_test
