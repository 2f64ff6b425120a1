// Friction feed-forward in free air: the passivity account counts it, and the friction that is sure pays it.
#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/control/gravity.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::friction_debt_test {
namespace {

struct Fed {
  double share = 0;   ///< of the moving ticks in which friction was fed forward
  double torque = 0;  ///< its mean magnitude over those of weight alone, joint 1, N m
};

/// Leads the stylus to and fro in the air and counts the ticks whose torque is more than the weight's.
Fed lead_through_air(double debt_j) {
  HapticLoopConfig config;
  config.friction.debt_j = debt_j;
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  test::LoopRig rig(device, config);
  rig.start();
  rig.move(test::working_pose(), 1.0);
  rig.keep = true;
  Pose aside = test::working_pose();
  aside.p.z() += 0.04;
  rig.move(aside, 0.5);
  rig.move(test::working_pose(), 0.5);
  Fed fed;
  double moving = 0;
  for (const TickRecord& r : rig.records) {
    if (std::abs(r.qd[3]) < 0.1) continue;
    const JointVector weight = gravity_torque(rig.config.device, arm_state(r.q.head<kArmJoints>()));
    const double more = std::abs(r.torque[3] - weight[3]);
    moving += 1;
    fed.share += more > 1e-3 ? 1 : 0;  // 0.7 of 7.5 mN m where it is on, rounding where it is off
    fed.torque += more;
  }
  EXPECT_GT(moving, 300);
  fed.share /= moving, fed.torque /= moving;
  return fed;
}

TEST(FrictionDebt, WhatFrictionSurelyTakesPaysTheFeedForward) {
  const Fed standard = lead_through_air(FrictionFeedForward{}.debt_j);
  EXPECT_GT(standard.share, 0.95);
  EXPECT_GT(standard.torque, 3e-3);
  EXPECT_GT(lead_through_air(0).share, 0.9) << "the account seldom owes anything in free air";
}

TEST(FrictionDebt, NoMoreIsFedForwardThanFrictionSurelyTakes) {
  HapticLoopConfig config;
  EXPECT_NEAR(HapticLoop(config).config().friction.share, 0.92 * 0.6, 1e-12) << "nothing was identified";
  config.device.identified_gravity.emplace();
  EXPECT_EQ(HapticLoop(config).config().friction.share, 0.7) << "the budget's own limit";
}

TEST(FrictionDebt, ForgivesLessThanATenthOfAContactsBudget) {
  EXPECT_GT(FrictionFeedForward{}.debt_j, 0);
  EXPECT_LE(FrictionFeedForward{}.debt_j, 0.1 * PassivityParameters{}.loan_j);
}

TEST(SmoothedRates, FollowARateWithinFiveTimeConstantsAndHoldNoiseBack) {
  const FrictionFeedForward p;
  SmoothedRates rates(p, 1e-3);
  JointVector out = JointVector::Zero();
  for (int k = 0; k < 100; ++k) out = rates.update(JointVector::Constant(0.2));
  EXPECT_NEAR(out[0], 0.2, 0.002);
  // One count a window of 16 ms flickers by 0.045 rad/s, up and down: less than the knee is left.
  double low = 1, high = -1;
  for (int k = 0; k < 400; ++k) {
    out = rates.update(JointVector::Constant(0.2 + (k % 2 == 0 ? 0.045 : -0.045)));
    if (k > 200) low = std::min(low, out[0]), high = std::max(high, out[0]);
  }
  EXPECT_LT(high - low, p.knee_rad_s / 3);
}

TEST(SmoothedRates, NeverHelpAJointThatHasTurnedBack) {
  SmoothedRates rates({}, 1e-3);
  for (int k = 0; k < 100; ++k) rates.update(JointVector::Constant(0.5));
  EXPECT_EQ(rates.update(JointVector::Constant(-0.1)).norm(), 0) << "smoothed still forward, joint already back";
  JointVector out = JointVector::Zero();
  for (int k = 0; k < 100; ++k) out = rates.update(JointVector::Constant(-0.1));
  EXPECT_LT(out[0], -0.05);
}

TEST(SmoothedRates, KnowTheirPeriodAndForgetOnReset) {
  SmoothedRates slow({}, 1e-3), fast({}, 0.25e-3);
  JointVector a = JointVector::Zero(), b = a;
  for (int k = 0; k < 10; ++k) a = slow.update(JointVector::Ones());
  for (int k = 0; k < 40; ++k) b = fast.update(JointVector::Ones());
  EXPECT_NEAR(a[3], b[3], 1e-12) << "10 ms either way";
  slow.reset();
  EXPECT_LT(slow.update(JointVector::Ones())[0], 0.06);
}

}  // namespace
}  // namespace trocar::friction_debt_test
