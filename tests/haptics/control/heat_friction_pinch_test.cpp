// Small models of the loop: heat of a motor, friction feed-forward, the block between the jaws.
#include <gtest/gtest.h>

#include "haptics/contact/friction.h"
#include "haptics/control/motor_heat.h"
#include "haptics/control/pinch_channel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::heat_friction_pinch_test {
namespace {

/// Time until the winding reaches a temperature, s; `limit_s` when it does not.
double time_to(double celsius, double current_a, double limit_s) {
  MotorHeat heat;
  double t = 0;
  constexpr double dt = 1e-3;
  while (t < limit_s && heat.winding_c() < celsius) {
    heat.update(current_a, dt);
    t += dt;
  }
  return t;
}

TEST(MotorHeat, FullCurrentReachesTheLimitInAboutElevenSeconds) {
  EXPECT_NEAR(time_to(125, 4.31, 60), 11, 0.8);  // haptics notes 3.1: "about 11 s", two digits
}

TEST(MotorHeat, StallCurrentReachesTheLimitInAboutOneAndAHalfSeconds) { EXPECT_NEAR(time_to(125, 10.3, 60), 1.5, 0.2); }

TEST(MotorHeat, RatedCurrentNeverReachesTheLimit) {
  MotorHeat heat;
  for (int k = 0; k < 3600 * 100; ++k) heat.update(1.2, 0.01);
  EXPECT_NEAR(heat.winding_c(), 98, 2) << "reference: 98 C after one hour";
  EXPECT_FALSE(heat.cut());
  EXPECT_GE(time_to(125, 1.2, 600), 600) << "nor within ten minutes at the step of the loop";
}

TEST(MotorHeat, RestingMotorStaysAtAmbientAndAHotOneCoolsDown) {
  MotorHeat heat;
  heat.update(0, 1);
  EXPECT_EQ(heat.winding_c(), 25);
  for (int k = 0; k < 5000; ++k) heat.update(4.31, 1e-3);
  const double hot = heat.winding_c();
  for (int k = 0; k < 200000; ++k) heat.update(0, 0.01);
  EXPECT_LT(heat.winding_c(), hot);
  EXPECT_NEAR(heat.winding_c(), 25, 1.5);  // three case time constants
}

TEST(MotorHeat, ALongRestIsTheSameInFewerSteps) {
  for (const double seconds : {0.0, 0.5, 7.3, 300.0, 1e9}) {
    MotorHeat stepped({}, {110, 60}), rested({}, {110, 60});
    for (int k = 0; k < static_cast<int>(std::min(seconds, 2e4) * 100); ++k) stepped.update(0, 0.01);
    rested.rest(seconds);
    EXPECT_NEAR(rested.winding_c(), stepped.winding_c(), 0.7) << seconds;
    EXPECT_NEAR(rested.temperatures().case_c, stepped.temperatures().case_c, 0.1) << seconds;
  }
  MotorHeat clock_set_back({}, {110, 60});
  clock_set_back.rest(-100);
  EXPECT_EQ(clock_set_back.winding_c(), 110);
}

TEST(MotorHeat, SignOfTheCurrentDoesNotMatter) {
  MotorHeat a, b;
  for (int k = 0; k < 1000; ++k) {
    a.update(3, 1e-3);
    b.update(-3, 1e-3);
  }
  EXPECT_EQ(a.winding_c(), b.winding_c());
}

TEST(MotorHeat, TorqueFadesBeforeItIsCut) {
  MotorHeat heat;
  double last = 1;
  bool faded = false;
  while (!heat.cut()) {
    EXPECT_LE(heat.share(), last);
    last = heat.share();
    faded |= last > 0.2 && last < 0.8;
    heat.update(4.31, 1e-3);
  }
  EXPECT_TRUE(faded);
  EXPECT_EQ(heat.share(), 0);
  EXPECT_GE(heat.winding_c(), 120);
}

TEST(MotorHeat, EnergyBalanceAtTheBeginning) {
  // Adiabatic start: dT/dt = I^2 R / C_w with C_w = tau_w / R_wc.
  MotorHeat heat;
  heat.update(4, 1e-3);
  EXPECT_NEAR(heat.winding_c() - 25, 16 * 2.32 * 1e-3 * 3.1 / 12.4, 1e-12);
}

TEST(HeatFrictionPinch, NothingAtRestOrInsideTheDeadBand) {
  EXPECT_EQ(friction_torque({}, {}, JointVector::Zero()).norm(), 0);
  EXPECT_EQ(friction_torque({}, {}, JointVector::Constant(0.0199)).norm(), 0);
}

TEST(HeatFrictionPinch, HelpsTheMotionByAtMostSeventyHundredths) {
  test::Random random(1);
  const DeviceModel model;
  const FrictionFeedForward p;
  EXPECT_LE(p.share, 0.7);
  for (int k = 0; k < 2000; ++k) {
    JointVector qd;
    for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(5);
    const JointVector torque = friction_torque(model, p, qd);
    for (int i = 0; i < kArmJoints; ++i) {
      EXPECT_GE(torque[i] * qd[i], 0);
      EXPECT_LE(std::abs(torque[i]), 0.7 * (model.coulomb[i] + model.viscous[i] * std::abs(qd[i])));
    }
  }
}

TEST(HeatFrictionPinch, FastMotionGetsTheShareOfCoulombAndViscous) {
  const DeviceModel model;
  const FrictionFeedForward p;
  const JointVector torque = friction_torque(model, p, JointVector::Constant(3));
  EXPECT_NEAR(torque[0], p.share * (model.coulomb[0] + 3 * model.viscous[0]), 1e-9);  // tanh(10) = 1 - 4e-9
}

TEST(GripBlock, PushesOnlyWhileSqueezed) {
  const GripBlock block{0.010, 500};
  EXPECT_EQ(grip_block(block, 0.012).force_n, 0);
  EXPECT_EQ(grip_block(block, 0.010).force_n, 0);
  EXPECT_NEAR(grip_block(block, 0.006).force_n, 2, 1e-12);
  EXPECT_NEAR(grip_block(block, 0.006).stored_j, 0.5 * 500 * 0.004 * 0.004, 1e-15);
  EXPECT_EQ(grip_block({0.010, 0}, 0.0).force_n, 0) << "no block";
}

TEST(GripBlock, ForceIsMinusTheSlopeOfTheStoredEnergy) {
  const GripBlock block{0.012, 800};
  constexpr double h = 1e-6;  // quadratic: the central difference is exact but for rounding, 1e-18 / h
  for (double opening = 0.001; opening < 0.0119; opening += 0.0005) {
    const double slope = (grip_block(block, opening + h).stored_j - grip_block(block, opening - h).stored_j) / (2 * h);
    EXPECT_NEAR(grip_block(block, opening).force_n, -slope, 1e-9);
  }
}

}  // namespace
}  // namespace trocar::heat_friction_pinch_test
