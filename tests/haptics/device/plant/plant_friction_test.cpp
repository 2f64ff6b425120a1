#include "haptics/device/plant/plant_friction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trocar::plant_friction_test {
namespace {

constexpr double kStep = 50e-6;
const FrictionParameters kJoint{7.5e-3, 1.3, 0.05, 1e-3, 1e-3, 5e-3};

// A mass on the friction alone, driven by a load; returns its speed after some time.
struct Slider {
  explicit Slider(const FrictionParameters& p, double inertia_) : friction(p), inertia(inertia_) {}
  void push(double load, double seconds) {
    for (int n = 0; n < static_cast<int>(std::lround(seconds / kStep)); ++n) {
      const ResistanceLine line = friction.linearise(v, kStep);
      v = (inertia * v + kStep * (load - line.constant)) / (inertia + kStep * line.slope);
      friction.advance(v, kStep);
      x += kStep * v;
    }
  }
  PlantFriction friction;
  double inertia, x = 0, v = 0;
};

TEST(PlantFriction, SlidingAtASteadySpeedCostsCoulombStribeckAndViscous) {
  for (const double v : {0.02, 0.1, 1.0, -1.0}) {
    PlantFriction friction(kJoint);
    ResistanceLine line;
    for (int n = 0; n < 40000; ++n) {
      line = friction.linearise(v, kStep);
      friction.advance(v, kStep);
    }
    const double g = kJoint.coulomb * (1 + 0.3 * std::exp(-std::pow(v / 0.05, 2)));
    const double expected = std::copysign(g, v) + kJoint.viscous * v;
    EXPECT_NEAR(line.constant + line.slope * v, expected, 1e-6 * std::abs(expected)) << "at " << v;
  }
}

TEST(PlantFriction, LoadBelowCoulombHoldsForGood) {
  Slider slider(kJoint, 1e-3);
  for (int n = 1; n <= 90; ++n) slider.push(0.01 * n * kJoint.coulomb, 0.05);  // laid on gently, without overshoot
  slider.push(0.9 * kJoint.coulomb, 2.0);
  const double x = slider.x;
  slider.push(0.9 * kJoint.coulomb, 10.0);
  EXPECT_NEAR(slider.x, x, 1e-9);
  EXPECT_GT(x, 0.9 * kJoint.bristle_length) << "the bristle's own deflection";
  EXPECT_LT(x, 3.0 * kJoint.bristle_length) << "presliding bends further than a spring, but ends";
}

TEST(PlantFriction, LoadAboveBreakawaySlides) {
  Slider slider(kJoint, 1e-3);
  slider.push(1.35 * kJoint.coulomb, 5.0);
  const double terminal = (1.35 - 1.0) * kJoint.coulomb / kJoint.viscous;
  EXPECT_NEAR(slider.v, terminal, 0.02 * terminal);
}

TEST(PlantFriction, ReversedSlowLoadDissipatesInEveryCycle) {
  Slider slider(kJoint, 1e-3);
  double work = 0;
  for (int n = 0; n < 200000; ++n) {
    const double load = 1.6 * kJoint.coulomb * std::sin(2 * 3.141592653589793 * n * kStep);
    const double x = slider.x;
    slider.push(load, kStep);
    work += load * (slider.x - x);
  }
  EXPECT_GT(work, 10 * kJoint.coulomb * 0.01);
}

TEST(PlantFriction, BristleDampingNeverExceedsBreakawayAtTheOnset) {
  // A sudden slip at the Stribeck speed: bristle damping plus bristle stays of the order of breakaway.
  PlantFriction friction(kJoint);
  const ResistanceLine line = friction.linearise(0.05, kStep);
  EXPECT_LT(line.constant + line.slope * 0.05, 1.5 * 1.3 * kJoint.coulomb);
}

TEST(PlantFriction, NoCoulombLeavesViscousLossOnly) {
  FrictionParameters p = kJoint;
  p.coulomb = 0;
  PlantFriction friction(p);
  const ResistanceLine line = friction.linearise(2.0, kStep);
  EXPECT_EQ(line.constant, 0.0);
  EXPECT_EQ(line.slope, p.viscous);
}

TEST(PlantStopLaw, PushesBackOutsideAndNeverPulls) {
  const StopParameters stop{0.0, 1.0, 100.0, 1.0};
  EXPECT_EQ(stop_resistance(stop, 0.5, 3.0).slope, 0.0);
  const ResistanceLine above = stop_resistance(stop, 1.1, 0.0);
  EXPECT_NEAR(above.constant, 10.0, 1e-12);  // resists further opening
  const ResistanceLine below = stop_resistance(stop, -0.1, 0.0);
  EXPECT_NEAR(below.constant, -10.0, 1e-12);
  // Leaving faster than the spring follows: the damper would pull, so the stop lets go.
  EXPECT_EQ(stop_resistance(stop, 1.1, -11.0).constant, 0.0);
  EXPECT_EQ(stop_resistance(stop, 1.1, -11.0).slope, 0.0);
}

}  // namespace
}  // namespace trocar::plant_friction_test
