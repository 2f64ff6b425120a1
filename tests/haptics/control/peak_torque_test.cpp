// Short-term peak torque: given while winding and amplifier bear it, never less than what lasts.
#include "haptics/control/peak_torque.h"

#include <gtest/gtest.h>

namespace trocar::peak_torque_test {
namespace {

constexpr double kStep = 1e-3;
using Windings = std::array<double, kChannels>;

Windings all_at(double celsius) {
  Windings windings;
  windings.fill(celsius);
  return windings;
}

/// Arm whose motors may give `motor_nm` for a short time.
DeviceModel arm_with(double motor_nm) {
  DeviceModel model;
  for (int i = 0; i < kArmJoints; ++i) {
    Transmission& t = model.transmission[static_cast<std::size_t>(i)];
    t.amps_per_volt *= motor_nm / t.max_motor_torque;
    t.max_motor_torque = motor_nm;
  }
  return model;
}

TEST(PeakTorque, TheThesisArmIsNeverLimited) {
  const DeviceModel model;
  PeakTorque peak({}, model, {});
  const ChannelVector most = peak.most();
  for (int k = 0; k < 20000; ++k) EXPECT_EQ(peak.update(most, all_at(119), kStep), most);
}

TEST(PeakTorque, AWarmWindingGetsWhatLasts) {
  const DeviceModel model = arm_with(0.2);
  PeakTorque peak({}, model, {});
  const double ratio = model.transmission[0].ratio;
  EXPECT_NEAR(peak.most()[0], 0.2 / ratio, 0.001);
  const auto at = [&](double celsius) { return peak.update(ChannelVector::Zero(), all_at(celsius), kStep)[0] * ratio; };
  EXPECT_NEAR(at(25), 0.2, 1e-3);
  EXPECT_NEAR(at(85), 0.2, 1e-3);
  EXPECT_NEAR(at(92.5), 0.15, 1e-3);
  EXPECT_NEAR(at(100), 0.1, 1e-9);
  EXPECT_NEAR(at(119), 0.1, 1e-9) << "from there on heat fades the contact, as ever";
  const double pinch = peak.update(ChannelVector::Zero(), all_at(119), kStep)[kPinchChannel];
  EXPECT_DOUBLE_EQ(pinch, peak.most()[kPinchChannel]) << "the pinch has no peak";
}

TEST(PeakTorque, TheAmplifierGivesItsPeakForTwoSecondsOnly) {
  const DeviceModel model = arm_with(0.2);
  const double ratio = model.transmission[0].ratio, six_amps = 6 * model.transmission[0].torque_constant / ratio;
  PeakTorque peak({}, model, {});
  ChannelVector limit = peak.most();
  double above_s = 0, largest_step = 0;
  for (int k = 0; k < 6000; ++k) {
    const double before = limit[0];
    above_s += limit[0] > 1.01 * six_amps ? kStep : 0;
    limit = peak.update(limit, all_at(25), kStep);
    largest_step = std::max(largest_step, before - limit[0]);
  }
  EXPECT_NEAR(limit[0], six_amps, 0.02 * six_amps);
  EXPECT_NEAR(above_s, 2, 0.05);
  EXPECT_LT(largest_step, 0.002) << "and never falls by a step";
  for (int k = 0; k < 10000; ++k) limit = peak.update(ChannelVector::Zero(), all_at(25), kStep);
  EXPECT_DOUBLE_EQ(limit[0], peak.most()[0]) << "rested";
}

}  // namespace
}  // namespace trocar::peak_torque_test
