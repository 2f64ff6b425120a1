// Each injected failure is visible at the seam, only there, and only for as long as it was asked for.
#include <gtest/gtest.h>

#include <vector>

#include "haptics/device/simulated_daq.h"
#include "tests/support/daq_conformance.h"

namespace trocar::simulated_daq_faults_test {
namespace {

using test::count_difference;

SimulatedDaqConfig with(const InjectedFault& fault) {
  SimulatedDaqConfig config;
  config.faults.push_back(fault);
  return config;
}

std::vector<DaqSample> run(SimulatedDaq& daq, int periods, std::int32_t code = 0) {
  std::vector<DaqSample> samples{DaqSample{}};  // index = number of the SYNC
  Pose wanted = daq.sense().X_BS;
  daq.arm(true);
  for (int k = 1; k <= periods; ++k) {
    wanted.p.z() += 0.1e-3;
    wanted.p.x() += 0.05e-3;
    wanted.R = wanted.R * Mat3(Eigen::AngleAxisd(1e-3, Vec3(1, 0, 1).normalized()));
    daq.set_hand_intent(wanted, 0.02 - 1e-5 * k);
    samples.push_back(daq.read());
    DacFrame frame;
    frame.codes.fill(code);
    daq.write(frame);
  }
  return samples;
}

TEST(SimulatedDaqFaults, EncoderJumpShiftsOneCounterOnceForGood) {
  SimulatedDaq faulty(with({InjectedFaultKind::kEncoderJump, 0.150, 0, 2, 500})), sound({});
  const auto a = run(faulty, 300), b = run(sound, 300);
  for (std::size_t k = 1; k < a.size(); ++k) {
    for (int i = 0; i < kChannels; ++i) {
      EXPECT_EQ(count_difference(a[k].counts[i], b[k].counts[i]), i == 2 && k >= 150 ? 500 : 0) << "SYNC " << k;
    }
  }
}

TEST(SimulatedDaqFaults, EncoderStuckRepeatsItsNumberThenCatchesUp) {
  SimulatedDaq faulty(with({InjectedFaultKind::kEncoderStuck, 0.200, 0.050, 3, 0})), sound({});
  const auto a = run(faulty, 300), b = run(sound, 300);
  for (std::size_t k = 200; k < 250; ++k) EXPECT_EQ(a[k].counts[3], b[199].counts[3]) << "SYNC " << k;
  EXPECT_NE(b[249].counts[3], b[199].counts[3]) << "the joint itself moved on";
  EXPECT_EQ(a[250].counts[3], b[250].counts[3]);
  EXPECT_EQ(a[220].counts[2], b[220].counts[2]);
}

TEST(SimulatedDaqFaults, InvalidChannelClearsItsBitOnly) {
  SimulatedDaq faulty(with({InjectedFaultKind::kChannelInvalid, 0.100, 0.003, 6, 0}));
  const auto a = run(faulty, 200);
  for (std::size_t k = 1; k < a.size(); ++k) EXPECT_EQ(a[k].valid, k >= 100 && k < 103 ? 0x3F : 0x7F) << "SYNC " << k;
}

TEST(SimulatedDaqFaults, MissedSyncsAreReportedInElapsedPeriods) {
  SimulatedDaq faulty(with({InjectedFaultKind::kMissedSync, 0.080, 0, 0, 3}));
  const auto a = run(faulty, 200);
  for (std::size_t k = 1; k < a.size(); ++k) EXPECT_EQ(a[k].elapsed_periods, k == 80 ? 4u : 1u) << "read " << k;
  EXPECT_NEAR(faulty.time_s(), 0.203, 1e-12) << "the device did not wait";
}

TEST(SimulatedDaqFaults, AMissedPeriodPassesInTheWorldAsOneThatWasInjected) {
  const auto drive = [](SimulatedDaq& daq, int missed_before_80) {
    std::vector<DaqSample> samples;
    Pose wanted = daq.sense().X_BS;
    daq.arm(true);
    for (int k = 1; k <= 140; ++k) {
      wanted.p.z() += 0.1e-3;
      daq.set_hand_intent(wanted, 0.02);
      for (int n = 0; k == 80 && n < missed_before_80; ++n) daq.miss_sync();
      samples.push_back(daq.read());
      daq.write(DacFrame{});
    }
    return samples;
  };
  SimulatedDaq live(with({InjectedFaultKind::kChannelInvalid, 100, 0, 0, 0}));  // a fault that never comes
  SimulatedDaq injected(with({InjectedFaultKind::kMissedSync, 0.080, 0, 0, 3}));
  const auto a = drive(live, 3), b = drive(injected, 0);
  ASSERT_EQ(b[79].elapsed_periods, 4u);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].elapsed_periods, b[k].elapsed_periods) << "read " << k + 1;
    EXPECT_EQ(a[k].counts, b[k].counts) << "read " << k + 1;
  }
  EXPECT_EQ(live.time_s(), injected.time_s());
}

TEST(SimulatedDaqFaults, HandNaNRaisesItsBitAndExertsNothing) {
  SimulatedDaq faulty(with({InjectedFaultKind::kHandNaN, 0.100, 0.020, 0, 0}));
  const auto a = run(faulty, 110);
  EXPECT_FALSE(a[99].digital_in & kHandFault);
  for (std::size_t k = 100; k < a.size(); ++k) {
    EXPECT_TRUE(a[k].digital_in & kHandFault) << "SYNC " << k;
    EXPECT_FALSE(a[k].digital_in & kDeadman) << "SYNC " << k;
  }
  EXPECT_EQ(faulty.sense().force_on_hand, Vec3(Vec3::Zero()));
  EXPECT_TRUE(faulty.plant().outputs().allFinite());
  const auto later = run(faulty, 20);
  EXPECT_FALSE(later.back().digital_in & kHandFault);
  EXPECT_TRUE(later.back().digital_in & kDeadman);
}

TEST(SimulatedDaqFaults, HandThatLetsGoOpensTheDeadman) {
  SimulatedDaq faulty(with({InjectedFaultKind::kHandLetsGo, 0.100, 0.010, 0, 0}));
  const auto a = run(faulty, 150);
  for (std::size_t k = 1; k < a.size(); ++k) {
    EXPECT_EQ((a[k].digital_in & kDeadman) != 0, k < 100 || k >= 110) << "SYNC " << k;
    EXPECT_FALSE(a[k].digital_in & kHandFault);
  }
}

TEST(SimulatedDaqFaults, StuckDacKeepsItsCode) {
  SimulatedDaq faulty(with({InjectedFaultKind::kDacStuck, 0.050, 0, 0, 0}));
  run(faulty, 60, 0);
  const double before = faulty.plant().motor_loads()[0];
  run(faulty, 20, 5000);
  EXPECT_NEAR(faulty.plant().motor_loads()[0], before, 1e-9);
  EXPECT_GT(faulty.plant().motor_loads()[1], 0.03) << "its neighbour follows";
}

}  // namespace
}  // namespace trocar::simulated_daq_faults_test
