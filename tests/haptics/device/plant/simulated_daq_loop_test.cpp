// The seam end to end: a minimal controller that knows only counts, codes and the nominal device carries the weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/device/simulated_daq.h"
#include "tests/haptics/device/plant/plant_fixtures.h"
#include "tests/support/daq_conformance.h"

namespace trocar::simulated_daq_loop_test {
namespace {

// Weight compensation from counts that were zeroed in the jig; the true device is another one.
class WeightCarrier {
 public:
  explicit WeightCarrier(const DaqSample& in_jig)
      : zero_(in_jig), home_(home_joint_angles(nominal_.link1, nominal_.link2)), model_(nominal_) {}

  DacFrame codes(const DaqSample& s, double share) {
    JointVector q;
    for (int i = 0; i < kArmJoints; ++i) {
      const double turns = test::count_difference(s.counts[i], zero_.counts[i]) / nominal_.counts_per_turn;
      q[i] = home_[i] + turns * 2 * std::numbers::pi * nominal_.channel[i].ratio;
    }
    model_.place(q, 0.02);
    const ChannelVector volts = test::volts_for(nominal_, share * model_.holding_torque());
    DacFrame frame;
    for (int i = 0; i < kChannels; ++i)
      frame.codes[i] = static_cast<std::int32_t>(std::lround(volts[i] / 10.0 * 32767));
    return frame;
  }

 private:
  PlantParameters nominal_ = nominal_parameters();
  DaqSample zero_;
  JointVector home_;
  DevicePlant model_;
};

// Mean force on the hand, N, while it moves slowly about a place above home.
double felt_weight(std::uint64_t seed, double share, double* worst_speed = nullptr) {
  SimulatedDaqConfig config;
  config.seed = seed;
  config.hand.tremor_m = 0;
  SimulatedDaq daq(config);
  WeightCarrier carrier(daq.read());
  const Pose home = daq.sense().X_BS;
  daq.arm(true);
  Vec3 felt = Vec3::Zero();
  const int periods = 4000, settled = 2000;
  for (int k = 0; k < periods; ++k) {
    const double t = k * 1e-3, raise = std::min(1.0, t);
    Pose wanted = home;
    wanted.p += Vec3(0.02 * std::sin(2 * std::numbers::pi * t), -0.05 * raise, 0.08 * raise);
    daq.set_hand_intent(wanted, 0.02);
    daq.write(carrier.codes(daq.read(), share));
    if (k < settled) continue;
    felt += daq.sense().force_on_hand / (periods - settled);
    if (worst_speed) *worst_speed = std::max(*worst_speed, daq.plant().motion().V_BS.linear.norm());
  }
  return felt.norm();
}

TEST(SimulatedDaqLoop, NominalWeightCompensationTakesTheWeightOffTheHand) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double bare = felt_weight(seed, 0.0);
    double speed = 0;
    const double carried = felt_weight(seed, 1.0, &speed);
    EXPECT_GT(bare, 0.5) << "seed " << seed;
    EXPECT_LT(carried, bare / 5) << "seed " << seed;
    EXPECT_LT(speed, 0.4) << "the intent moves at 0.13 m/s";
  }
}

TEST(SimulatedDaqLoop, TwiceTheWeightLiftsInsteadOfFalling) {
  const double carried = felt_weight(1, 1.0), overdone = felt_weight(1, 2.0);
  EXPECT_GT(overdone, 3 * carried);
}

}  // namespace
}  // namespace trocar::simulated_daq_loop_test
