// The pinch's own budget on the plant: blocks of 300 to 5000 N/m between fingers from very light to firm, at the seam's
// delay and three periods more. No limit cycle, energy bounded, and the observer against the true motion of the jaw.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "tests/haptics/loop_rig.h"

namespace trocar::pinch_budget_test {
namespace {

using test::LoopRig;

struct Finger {
  double stiffness, damping;
};
constexpr Finger kVeryLight{60, 0.2}, kLight{100, 0.5}, kEasy{200, 1}, kNormal{400, 6}, kFirm{1200, 10};
constexpr double kThickness = 0.012;  // m, block
constexpr int kWatched = 2000;        // periods; the last half is looked at for swinging

struct Squeeze {
  PassivityLaw law = PassivityLaw::kBudgeted;
  double block = 300;  ///< N/m
  Finger finger = kNormal;
  int extra_delay = 0;
  double seconds = 0.15;  ///< from 20 mm to 4 mm
  bool clamp = false;
};

struct Squeezed {
  double swing_m = 0, swing_n = 0;  ///< peak to peak in the last second
  double shown = 0;                 ///< mean stiffness over the block's, last second
  double least_true_j = 0, observer_gap_j = 0, largest_n = 0;
  FaultCode fault = FaultCode::kNone;
};

Squeezed squeeze(const Squeeze& how) {
  SimulatedDaqConfig device;
  device.hand.finger_stiffness = how.finger.stiffness;
  device.hand.finger_damping = how.finger.damping;
  device.extra_delay_periods = how.extra_delay;
  HapticLoopConfig config;
  config.known_delay_periods = how.extra_delay;
  config.passivity.law = config.pinch_passivity.law = how.law;
  config.clamp_stiffness = how.clamp;
  LoopRig rig(device, config);
  rig.start();
  rig.patch->grip = {kThickness, how.block};
  ++rig.patch->stamp;
  Squeezed out;
  double energy = 0, last = rig.daq.plant().motion().jaw, least_m = 1, most_m = 0, least_n = 1e9, most_n = 0;
  const double before = rig.loop.pinch_passivity().absorbed_j();
  std::deque<double> on_the_way(static_cast<std::size_t>(how.extra_delay) + 2, 0.0);
  for (int k = 0; k < kWatched; ++k) {
    const double s = std::min(1.0, k * 1e-3 / how.seconds);
    rig.jaw = 0.02 - 0.016 * s * s * s * (10 - 15 * s + 6 * s * s);
    rig.tick();
    const double jaw = rig.daq.plant().motion().jaw, force = rig.record.contact_torque[kPinchChannel];
    energy -= on_the_way.front() * (jaw - last);  // read k sees the way under what tick k - 2 asked for
    last = jaw;
    on_the_way.push_back(force);
    on_the_way.pop_front();
    out.least_true_j = std::min(out.least_true_j, energy);
    out.observer_gap_j =
        std::max(out.observer_gap_j, std::abs(energy - (rig.loop.pinch_passivity().absorbed_j() - before)));
    out.largest_n = std::max(out.largest_n, force);
    if (k < kWatched / 2) continue;
    least_m = std::min(least_m, jaw), most_m = std::max(most_m, jaw);
    least_n = std::min(least_n, force), most_n = std::max(most_n, force);
    out.shown += force / std::max(1e-6, how.block * (kThickness - jaw)) / (kWatched / 2);
  }
  out.swing_m = most_m - least_m;
  out.swing_n = most_n - least_n;
  out.fault = rig.record.stylus.fault.code;
  return out;
}

TEST(PinchBudget, WithTheLawOffAStiffBlockSwingsBetweenLightFingers) {
  const Squeezed off = squeeze({PassivityLaw::kOff, 1000, kLight});
  EXPECT_GT(off.swing_m, 1e-3);
  EXPECT_LT(off.least_true_j, -20e-3) << "and drives the fingers";
}

TEST(PinchBudget, NoBlockSwingsBetweenAnyFingers) {
  for (const int delay : {0, 3}) {
    for (const double block : {300.0, 1000.0, 5000.0}) {
      for (const Finger& finger : {kVeryLight, kLight, kEasy, kNormal, kFirm}) {
        const Squeezed on = squeeze({PassivityLaw::kBudgeted, block, finger, delay});
        SCOPED_TRACE(testing::Message() << block << " N/m, finger " << finger.stiffness << " N/m, " << 1 + delay
                                        << " ms");
        EXPECT_EQ(on.fault, FaultCode::kNone);
        EXPECT_LT(on.swing_m, 0.05e-3) << "two counts of the slide";
        EXPECT_LT(on.swing_n, 0.1);
        EXPECT_GT(on.least_true_j, delay == 0 ? -6e-3 : -12e-3);
      }
    }
  }
}

TEST(PinchBudget, AHastySqueezeIsNoWorse) {
  for (const double block : {550.0, 1000.0, 5000.0}) {
    for (const Finger& finger : {kVeryLight, kLight, kEasy}) {
      const Squeezed on = squeeze({PassivityLaw::kBudgeted, block, finger, 0, 0.1});
      EXPECT_LT(on.swing_m, 0.05e-3) << block << ' ' << finger.stiffness;
      EXPECT_GT(on.least_true_j, -8e-3);
    }
  }
}

TEST(PinchBudget, TheBlocksOfTheExercisesAreShownInFull) {
  for (const double block : {250.0, 300.0, 400.0, 550.0}) {
    const Squeezed on = squeeze({PassivityLaw::kBudgeted, block, kNormal});
    EXPECT_NEAR(on.shown, 1, 0.05) << block;
  }
}

TEST(PinchBudget, WithTheClampAStiffBlockIsShownAsStiffAsKMax) {
  const Squeezed clamped = squeeze({PassivityLaw::kBudgeted, 2500, kNormal, 0, 0.4, true});
  EXPECT_NEAR(clamped.shown * 2500, 667, 0.1 * 667) << "b / (T/2 + Td) = 1.0 / 1.5 ms";
  const Squeezed soft = squeeze({PassivityLaw::kBudgeted, 550, kNormal, 0, 0.15, true});
  EXPECT_NEAR(soft.shown, 1, 0.05) << "below it nothing changes";
}

TEST(PinchBudget, TheObserverUsesWhatWasAppliedSaturatedAndDelayed) {
  for (const int delay : {0, 3}) {
    const Squeezed firm = squeeze({PassivityLaw::kOff, 5000, kFirm, delay});
    EXPECT_LE(firm.largest_n, 0.080 / 0.008 + 1e-9) << "never more than the small motor gives";
    const Squeezed light = squeeze({PassivityLaw::kBudgeted, 550, kLight, delay});
    EXPECT_LT(light.observer_gap_j, 0.2e-3) << "a count of 25 um at 0.7 N, a dozen times";
  }
  const Squeezed wild = squeeze({PassivityLaw::kOff, 5000, kNormal, 0});
  ASSERT_LT(wild.least_true_j, -0.5) << "swings with saturation in every stroke";
  EXPECT_LT(wild.observer_gap_j, 0.05 * std::abs(wild.least_true_j));
}

TEST(PinchStiffnessLimit, IsTheLeastOfItsThreeTermsButNotBelowTheLocalStiffness) {
  PassivityParameters p = HapticLoopConfig::pinch_defaults();
  const double count = 0.008 * 2 * 3.14159265358979 / 2000, fc = 0.04;
  EXPECT_NEAR(pinch_stiffness_limit(p, fc, count, 1000).k_max, 1.0 / 1.5e-3, 1e-9);
  EXPECT_NEAR(pinch_stiffness_limit(p, fc, count, 1000).share, 2.0 / 3, 1e-9);
  EXPECT_EQ(pinch_stiffness_limit(p, fc, count, 550).share, 1) << "to the bit";
  p.delay_s = 9e-3;
  EXPECT_EQ(pinch_stiffness_limit(p, fc, count, 1000).k_max, p.least_stiffness_n_per_m) << "105 N/m would be passive";
  p.delay_s = 0;
  EXPECT_NEAR(pinch_stiffness_limit(p, fc, count, 1).k_max, 2000, 1e-9) << "2 b / T";
  EXPECT_NEAR(pinch_stiffness_limit(p, 0.01, count, 1).k_max, 0.02 / count, 1e-9) << "2 fc / Delta";
  p.law = PassivityLaw::kOff;
  EXPECT_EQ(pinch_stiffness_limit(p, fc, count, 1e6).share, 1);
}

}  // namespace
}  // namespace trocar::pinch_budget_test
