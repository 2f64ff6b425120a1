// The pinch axis: a jaw on its own motor.
#include <gtest/gtest.h>

#include "haptics/device/plant/device_plant.h"
#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_pinch_test {
namespace {

constexpr double kStep = 50e-6;

struct Pinch {
  Pinch() : plant(parameters) { plant.enable_amplifiers(true); }
  void drive(double motor_force, double finger_force, double seconds) {
    // Only the jaw matters here: hold the arm's weight so that nothing else moves far.
    plant.command_volts(test::volts_for(parameters, plant.holding_torque(), motor_force));
    for (int n = 0; n < static_cast<int>(std::lround(seconds / kStep)); ++n) plant.step(kStep, {{}, finger_force});
  }
  double opening() const { return plant.motion().jaw; }
  PlantParameters parameters = nominal_parameters();
  DevicePlant plant;
};

TEST(PlantPinch, PositiveCurrentOpensAndNegativeCloses) {
  Pinch pinch;
  pinch.drive(0.5, 0, 0.02);
  EXPECT_GT(pinch.opening(), 0.0201);
  pinch.plant.place(pinch.plant.angles(), 0.02);
  pinch.drive(-0.5, 0, 0.02);
  EXPECT_LT(pinch.opening(), 0.0199);
}

TEST(PlantPinch, FullCommandGivesTwelveNewton) {
  Pinch pinch;
  ChannelVector volts = ChannelVector::Zero();
  volts[kPinchChannel] = 10;
  pinch.plant.clamp(true);
  pinch.plant.command_volts(volts);
  for (int n = 0; n < 100; ++n) pinch.plant.step(kStep, {});
  EXPECT_NEAR(pinch.plant.motor_loads()[kPinchChannel], 12.5, 0.01);
}

TEST(PlantPinch, ForceBelowFrictionHoldsTheJaw) {
  Pinch pinch;
  pinch.drive(0, 0.035, 1.0);
  const double start = pinch.opening();
  pinch.drive(0, 0.035, 2.0);
  EXPECT_NEAR(pinch.opening(), start, 1e-9);
  EXPECT_NEAR(start, 0.02, 2e-5);
}

TEST(PlantPinch, MotorAndFingerBalance) {
  Pinch pinch;
  pinch.drive(2.0, -2.0, 0.5);
  EXPECT_NEAR(pinch.opening(), 0.02, 1e-3);
  EXPECT_LT(std::abs(pinch.plant.motion().jaw_rate), 1e-6);
}

TEST(PlantPinch, TravelEndsAtThirtyMillimetresAndAtZero) {
  Pinch pinch;
  pinch.drive(0, 5.0, 1.0);
  EXPECT_NEAR(pinch.opening(), 0.030, 5.5 / 20000);
  EXPECT_LT(std::abs(pinch.plant.motion().jaw_rate), 1e-4);
  pinch.drive(0, -5.0, 1.0);
  EXPECT_NEAR(pinch.opening(), 0.0, 5.5 / 20000);
}

}  // namespace
}  // namespace trocar::plant_pinch_test
