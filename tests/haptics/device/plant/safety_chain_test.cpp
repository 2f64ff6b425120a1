// What the back-end does without the controller: emergency stop, enabling switch, watchdog, DAC readback; and the
// failures of bus, drives and board that the controller meets only at the seam.
#include <gtest/gtest.h>

#include <vector>

#include "haptics/device/simulated_daq.h"

namespace trocar::safety_chain_test {
namespace {

SimulatedDaqConfig with(const InjectedFault& fault) {
  SimulatedDaqConfig config;
  config.faults.push_back(fault);
  return config;
}

constexpr std::int32_t kCode = 3000;

/// A device whose hand holds still, with constant codes written after every read.
struct Rig {
  explicit Rig(const SimulatedDaqConfig& config) : daq(config) { daq.arm(true); }
  const DaqSample& step(bool write = true) {
    daq.set_hand_intent(daq.sense().X_BS, 0.02);
    sample = daq.read();
    DacFrame frame;
    frame.codes.fill(kCode);
    if (write) daq.write(frame);
    return sample;
  }
  void run(int periods) {
    for (int k = 0; k < periods; ++k) step();
  }
  double torque() const { return daq.plant().motor_loads().cwiseAbs().maxCoeff(); }

  SimulatedDaq daq;
  DaqSample sample;
};

TEST(SafetyChain, TheEmergencyStopTakesTheCurrentAwayByWire) {
  Rig rig(with({InjectedFaultKind::kEmergencyStop, 0.1, 0.05, 0, 0}));
  rig.run(99);
  EXPECT_GT(rig.torque(), 0.01);
  EXPECT_FALSE(rig.sample.digital_in & kEmergencyStop);
  rig.step();
  EXPECT_TRUE(rig.sample.digital_in & kEmergencyStop);
  EXPECT_EQ(rig.torque(), 0) << "in the very period, though the controller still arms and writes";
  rig.run(60);
  EXPECT_FALSE(rig.sample.digital_in & kEmergencyStop);
}

TEST(SafetyChain, AnOpenSwitchTakesTheCurrentAwayByWire) {
  Rig injected(with({InjectedFaultKind::kDeadmanOpen, 0.1, 0.05, 0, 0})), pressed({});
  injected.run(100);
  EXPECT_FALSE(injected.sample.digital_in & kDeadman);
  EXPECT_EQ(injected.torque(), 0);
  injected.run(60);
  EXPECT_TRUE(injected.sample.digital_in & kDeadman);
  pressed.run(100);
  EXPECT_TRUE(pressed.sample.digital_in & kDeadman);
  pressed.daq.press_deadman(false);
  pressed.step();
  EXPECT_FALSE(pressed.sample.digital_in & kDeadman);
  EXPECT_EQ(pressed.torque(), 0);
}

TEST(Watchdog, ZeroesTheDacsAfterSixteenMillisecondsWithoutAWrite) {
  Rig rig({});
  rig.run(100);
  for (int k = 1; k <= 16; ++k) {
    rig.step(false);
    EXPECT_FALSE(rig.sample.digital_in & kWatchdogFired) << k << " ms";
    EXPECT_GT(rig.torque(), 0.01);
  }
  rig.step(false);
  EXPECT_TRUE(rig.sample.digital_in & kWatchdogFired);
  rig.step(false);
  EXPECT_LT(rig.torque(), 0.01) << "what is left is the DACs' offset";
  rig.run(5);
  EXPECT_TRUE(rig.sample.digital_in & kWatchdogFired) << "writing again does not bring the torque back";
  EXPECT_LT(rig.torque(), 0.01);
  rig.daq.arm(false);
  rig.daq.arm(true);
  rig.run(5);
  EXPECT_FALSE(rig.sample.digital_in & kWatchdogFired);
}

TEST(Watchdog, CountsTimeAtEveryRate) {
  SimulatedDaqConfig config;
  config.rate_hz = 4000;
  Rig rig(config);
  rig.run(100);
  int silent = 0;
  for (; silent < 200 && !(rig.sample.digital_in & kWatchdogFired); ++silent) rig.step(false);
  EXPECT_EQ(silent, 65) << "16 ms and one period";
}

TEST(Watchdog, FiresWhenWritesAreLost) {
  Rig rig(with({InjectedFaultKind::kWatchdog, 0.1, 0.03, 0, 0}));
  rig.run(115);
  EXPECT_FALSE(rig.sample.digital_in & kWatchdogFired);
  rig.run(2);
  EXPECT_TRUE(rig.sample.digital_in & kWatchdogFired);
}

TEST(DacReadback, NamesTheChannelThatDoesNotHoldItsCode) {
  Rig rig(with({InjectedFaultKind::kDacStuck, 0.002, 0, 5, 0}));
  rig.run(1);
  EXPECT_EQ(rig.sample.digital_in & (0x7Fu << 8), 0u);
  rig.run(5);
  EXPECT_EQ(rig.sample.digital_in & (0x7Fu << 8), std::uint32_t{kDacMismatch} << 5) << "stuck at the code zero";
  SimulatedDaqConfig blind = with({InjectedFaultKind::kDacStuck, 0.002, 0, 5, 0});
  blind.dac_readback = false;
  Rig without(blind);
  without.run(10);
  EXPECT_EQ(without.sample.digital_in & (0x7Fu << 8), 0u);
}

TEST(DacReadback, AStuckDacKeepsItsCodeThroughADisarm) {
  Rig rig(with({InjectedFaultKind::kDacStuck, 0.05, 0, 2, 0}));
  rig.run(60);
  EXPECT_EQ(rig.sample.digital_in & (0x7Fu << 8), 0u) << "the code it should hold is the one it is stuck at";
  rig.daq.arm(false);
  rig.daq.write({});
  rig.daq.set_hand_intent(rig.daq.sense().X_BS, 0.02);
  EXPECT_TRUE(channel_input(rig.daq.read().digital_in, kDacMismatch, 2));
}

TEST(Delay, CodesComeLaterWhileItLastsAndReadbackSeesNothing) {
  SimulatedDaqConfig late = with({InjectedFaultKind::kDelay, 0.060, 0.040, 0, 7});
  Rig rig(late);
  rig.run(70);
  // A step of the code: it shows in the loads 2 periods later when sound, 7 more while it lasts.
  int periods = 0;
  const double before = rig.daq.plant().motor_loads()[1];
  for (double change = 0; change < 1e-3 && periods < 30; ++periods) {
    rig.daq.set_hand_intent(rig.daq.sense().X_BS, 0.02);
    rig.sample = rig.daq.read();
    DacFrame frame;
    frame.codes.fill(2 * kCode);
    rig.daq.write(frame);
    change = std::abs(rig.daq.plant().motor_loads()[1] - before);
    EXPECT_EQ(rig.sample.digital_in & (0x7Fu << 8), 0u);
  }
  EXPECT_EQ(periods, 3 + 7);
}

TEST(Drives, OutputsAreSeenOnTheirChannelOnly) {
  Rig fault(with({InjectedFaultKind::kDriveFault, 0.05, 0.01, 3, 0}));
  Rig hot(with({InjectedFaultKind::kOverTemperature, 0.05, 0, 6, 0}));
  fault.run(55);
  hot.run(55);
  for (int i = 0; i < kChannels; ++i) {
    EXPECT_EQ(channel_input(fault.sample.digital_in, kDriveFault, i), i == 3);
    EXPECT_EQ(channel_input(hot.sample.digital_in, kDriveHot, i), i == 6);
  }
  fault.run(10);
  EXPECT_FALSE(channel_input(fault.sample.digital_in, kDriveFault, 3));
}

TEST(SensorSilence, RepeatsTheLastSampleAndSaysThatNoPeriodElapsed) {
  Rig rig(with({InjectedFaultKind::kSensorSilence, 0.1, 0.02, 0, 0}));
  rig.run(99);
  const DaqSample last = rig.sample;
  for (int k = 0; k < 20; ++k) {
    rig.step();
    EXPECT_EQ(rig.sample.elapsed_periods, 0u);
    EXPECT_EQ(rig.sample.counts, last.counts);
  }
  rig.step();
  EXPECT_EQ(rig.sample.elapsed_periods, 1u);
  EXPECT_NEAR(rig.daq.time_s(), 0.120, 1e-12) << "the device did not wait";
}

TEST(Injection, RefusesWhatTheBackEndCannotDo) {
  EXPECT_EQ(injection_refusal({InjectedFaultKind::kDelay, 1, 0, 0, 5}), "");
  const InjectedFault bad[] = {
      {InjectedFaultKind::kDelay, 1, 0, 0, 0},         {InjectedFaultKind::kDelay, 1, 0, 0, 64},
      {InjectedFaultKind::kMissedSync, 1, 0, 0, 0},    {InjectedFaultKind::kHandNaN, -1, 0, 0, 0},
      {InjectedFaultKind::kEncoderJump, 1, 0, 7, 1},   {InjectedFaultKind::kHandNaN, 1, -1, 0, 0},
      {InjectedFaultKind::kEncoderJump, 1, 0, 0, 1e10}};
  for (const InjectedFault& fault : bad) {
    EXPECT_NE(injection_refusal(fault), "");
    EXPECT_THROW(SimulatedDaq daq(with(fault)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace trocar::safety_chain_test
