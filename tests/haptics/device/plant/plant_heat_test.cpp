// Heat of the plant's motors: the reference's three numbers, energy, headroom.
#include "haptics/device/plant/plant_heat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/device/plant/device_plant.h"
#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_heat_test {
namespace {

HeatParameters switched_on() {
  HeatParameters p;
  p.on = true;
  return p;
}

double seconds_to(double winding_c, double current, double dt = 1e-3) {
  PlantHeat heat(switched_on(), 2.32);
  double t = 0;
  for (; heat.winding_c() < winding_c && t < 7200; t += dt) heat.advance(current, dt);
  return t;
}

TEST(PlantHeat, FullCommandReachesTheLimitInElevenSeconds) { EXPECT_NEAR(seconds_to(125, 4.31), 11, 0.5); }

TEST(PlantHeat, StallReachesTheLimitInOneAndAHalfSeconds) { EXPECT_NEAR(seconds_to(125, 10.3), 1.5, 0.1); }

TEST(PlantHeat, ContinuousCurrentNeverReachesTheLimit) {
  PlantHeat heat(switched_on(), 2.32);
  for (int n = 0; n < 360000; ++n) heat.advance(1.2, 0.01);
  EXPECT_NEAR(heat.winding_c(), 98, 1.0) << "after an hour";
  EXPECT_LT(heat.case_c(), heat.winding_c());
  EXPECT_EQ(seconds_to(125, 1.2, 0.1) >= 7200, true);
}

TEST(PlantHeat, SettlesWhereCopperLossFlowsToTheAir) {
  // Closed form: T = Ta + R_th i^2 R / (1 - R_th a i^2 R) with R_th = 17.1 K/W.
  PlantHeat heat(switched_on(), 2.32);
  for (int n = 0; n < 100000; ++n) heat.advance(0.8, 0.1);
  const double loss = 0.64 * 2.32, rise = 17.1 * loss / (1 - 17.1 * 0.0039 * loss);
  EXPECT_NEAR(heat.winding_c() - 25, rise, 1e-6 * rise);
  EXPECT_NEAR(heat.resistance(), 2.32 * (1 + 0.0039 * rise), 1e-6);
}

TEST(PlantHeat, EnergyGoesIntoCopperIronAndAir) {
  const HeatParameters p = switched_on();
  PlantHeat heat(p, 2.32);
  const double cw = p.winding_time / p.winding_to_case, cc = p.case_time / p.case_to_air, dt = 1e-3;
  double put_in = 0, given_off = 0;
  for (int n = 0; n < 20000; ++n) {
    const double i = 3 * std::sin(1e-3 * n);
    const double r = heat.resistance(), air = (heat.case_c() - p.ambient_c) / p.case_to_air;
    heat.advance(i, dt);
    put_in += 0.5 * dt * i * i * (r + heat.resistance());
    given_off += 0.5 * dt * (air + (heat.case_c() - p.ambient_c) / p.case_to_air);
  }
  const double stored = cw * (heat.winding_c() - 25) + cc * (heat.case_c() - 25);
  EXPECT_NEAR(stored + given_off, put_in, 1e-6 * put_in);
}

TEST(PlantHeat, TheStepDoesNotMatter) { EXPECT_NEAR(seconds_to(125, 4.31, 50e-6), seconds_to(125, 4.31, 1e-3), 2e-3); }

TEST(PlantHeat, AWarmMotorHasLessHeadroom) {
  PlantParameters p = nominal_parameters();
  p.options.heat.on = true;
  const ChannelParameters& c = p.channel[0];
  const double rate = 0.8 * p.bus_voltage / c.torque_constant * c.ratio;
  const auto current_at = [&](double start_c) {
    p.options.heat.start_c = start_c;
    PlantMotor motor(c, p);
    for (int n = 0; n < 100; ++n) motor.advance(10, rate, 50e-6);
    return motor.current();
  };
  EXPECT_NEAR(current_at(25), 0.2 * p.bus_voltage / c.resistance, 0.01);
  EXPECT_NEAR(current_at(125) / current_at(25), 1 / 1.39, 1e-3) << "0.39 % a kelvin over 100 K";
}

TEST(PlantHeat, MotorsOfTheDeviceWarmByTheirCurrentAndCoolWhenInhibited) {
  PlantParameters p = nominal_parameters();
  p.options.heat.on = true;
  DevicePlant plant(p);
  plant.clamp(true);
  plant.enable_amplifiers(true);
  ChannelVector volts = ChannelVector::Zero();
  volts[2] = 10;
  plant.command_volts(volts);
  for (int n = 0; n < 40000; ++n) plant.step(50e-6, {});
  PlantHeat alone(p.options.heat, 2.32);
  for (int n = 0; n < 2000; ++n) alone.advance(4.31, 1e-3);
  EXPECT_NEAR(plant.windings_c()[2], alone.winding_c(), 0.01);
  EXPECT_EQ(plant.windings_c()[0], 25);
  const double hot = plant.windings_c()[2], housing = plant.cases_c()[2];
  plant.enable_amplifiers(false);
  for (int n = 0; n < 20000; ++n) plant.step(50e-6, {});
  EXPECT_LT(plant.windings_c()[2], hot);
  EXPECT_GT(plant.cases_c()[2], housing) << "the case takes what the winding gives";
}

TEST(PlantHeat, OffItStaysAtItsStart) {
  DevicePlant plant(nominal_parameters());
  plant.clamp(true);
  plant.enable_amplifiers(true);
  plant.command_volts(ChannelVector::Constant(10));
  for (int n = 0; n < 1000; ++n) plant.step(50e-6, {});
  EXPECT_EQ(plant.windings_c(), ChannelVector::Constant(25));
}

}  // namespace
}  // namespace trocar::plant_heat_test
