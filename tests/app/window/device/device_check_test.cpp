// The check beside the briefing: it measures, and what is wrong with a device turns its line red.
#include <gtest/gtest.h>

#include <memory>

#include "app/window/device/device_check.h"
#include "haptics/device/plant/plant_parameters.h"

namespace trocar::device_check_test {
namespace {

using What = DeviceCheck::What;
using State = DeviceCheck::State;

DeviceCheck::Line line(const DeviceCheck& check, What what) { return check.lines()[static_cast<std::size_t>(what)]; }

TEST(DeviceCheck, DrawnDevicesPassAndTheirNumbersAreSaid) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulatedDaqConfig device;
    device.seed = seed;
    const DeviceCheck check(device);
    ASSERT_TRUE(check.wait(300));
    EXPECT_TRUE(check.sound()) << seed;
    for (const DeviceCheck::Line& l : check.lines())
      EXPECT_EQ(l.detail, "") << seed << ": " << l.value << " against " << l.limit;
    EXPECT_GT(line(check, What::kFriction).value, 0.005) << "a real arm has some";
    EXPECT_GT(line(check, What::kBoard).count, 5);
  }
}

TEST(DeviceCheck, TheBoardIsThatOfItsBackEnd) {
  const DeviceCheck check({}, {}, kEmulatedMc4000Backend);
  ASSERT_TRUE(check.wait(300));
  EXPECT_TRUE(check.sound()) << line(check, What::kBoard).detail;
  const DeviceCheck none({}, {}, "mc5000");
  ASSERT_TRUE(none.wait(300));
  EXPECT_EQ(line(none, What::kBoard).state, State::kFailed) << "nothing else is looked at in its place";
}

TEST(DeviceCheck, TooMuchOfAnythingIsRed) {
  const DeviceCheck check({}, {.weight_n = 1e-6, .friction_n = 1e-6, .energy_j = 1e-3});
  ASSERT_TRUE(check.wait(300));
  EXPECT_EQ(line(check, What::kWeight).state, State::kFailed);
  EXPECT_EQ(line(check, What::kFriction).state, State::kFailed);
  EXPECT_FALSE(check.sound());
}

TEST(DeviceCheck, FrictionIsSeenThroughTheSeam) {
  SimulatedDaqConfig smooth, rough;
  smooth.plant = nominal_parameters();
  rough.plant = nominal_parameters();
  for (ChannelParameters& channel : rough.plant->channel) {
    channel.friction.coulomb *= 1.6;
  }
  const DeviceCheck one(smooth), other(rough);
  ASSERT_TRUE(one.wait(300) && other.wait(300));
  EXPECT_GT(line(other, What::kFriction).value, 1.5 * line(one, What::kFriction).value)
      << "0.6 of the friction is on top of what the loop makes up for";
}

TEST(DeviceCheck, ArmThatDoesNotFollowIsRedWhateverTheForcesSay) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  for (ChannelParameters& channel : device.plant->channel) channel.friction.coulomb *= 12;
  const DeviceCheck check(device);
  ASSERT_TRUE(check.wait(300));
  EXPECT_EQ(line(check, What::kFriction).state, State::kFailed);
}

TEST(DeviceCheck, FaultOfTheDeviceIsAFailureInWords) {
  SimulatedDaqConfig device;
  device.faults.push_back(
      {.kind = InjectedFaultKind::kEncoderJump, .at_s = 2.0, .duration_s = 0.001, .channel = 2, .value = 4000});
  const DeviceCheck check(device);
  ASSERT_TRUE(check.wait(300));
  EXPECT_FALSE(check.sound());
  EXPECT_EQ(line(check, What::kPassivity).state, State::kFailed);
  EXPECT_NE(line(check, What::kPassivity).detail.find("encoder-jump"), std::string::npos)
      << line(check, What::kPassivity).detail;
}

TEST(DeviceCheck, LeavingDoesNotWaitForTheEnd) {
  const auto check = std::make_unique<DeviceCheck>(SimulatedDaqConfig{});
  EXPECT_FALSE(check->finished());
}

}  // namespace
}  // namespace trocar::device_check_test
