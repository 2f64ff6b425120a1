// Reflex, voluntary reaction and the grip that stiffens: not before their delays, and off by default.
#include "haptics/device/plant/plant_reaction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/device/plant/hand_model.h"
#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::hand_reaction_test {
namespace {

constexpr double kStep = 50e-6;

HandReaction switched_on() {
  HandReaction r;
  r.on = true;
  return r;
}

/// Feels nothing for 0.5 s, then `force` for `seconds`. @return times at which the shares first differ from 0 and first
/// reach 1, counted from the step.
struct Times {
  double reflex = -1, reaction = -1, firm = -1;
};
Times times_after(PlantReaction& hand, const Vec3& force, double seconds) {
  for (int n = 0; n < 10000; ++n) hand.feel(Vec3::Zero(), kStep);
  Times out;
  for (int n = 1; n <= std::lround(seconds / kStep); ++n) {
    hand.feel(force, kStep);
    const double t = n * kStep;
    if (out.reflex < 0 && hand.reflex() > 0) out.reflex = t;
    if (out.reaction < 0 && hand.firmness() > 0) out.reaction = t;
    if (out.firm < 0 && hand.firmness() >= 1) out.firm = t;
  }
  return out;
}

TEST(HandReaction, ComesAfterItsDelaysAndNotBefore) {
  const HandReaction p = switched_on();
  PlantReaction hand(p);
  const Times t = times_after(hand, Vec3(0, 0, 1), 1.0);
  EXPECT_GE(t.reflex, p.reflex_s);
  EXPECT_LT(t.reflex, p.reflex_s + 1e-3);
  EXPECT_GE(t.reaction, p.reaction_s);
  EXPECT_LT(t.reaction, p.reaction_s + 2e-3);
  EXPECT_NEAR(t.firm, p.firm_s, 2e-3);
}

TEST(HandReaction, DrawnDelaysAreKeptToo) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const HandReaction p = draw_hand_reaction(seed);
    EXPECT_GE(p.reflex_s, 0.030);
    EXPECT_LE(p.reflex_s, 0.050);
    EXPECT_GE(p.reaction_s, 0.150);
    EXPECT_LE(p.reaction_s, 0.200);
    EXPECT_GT(p.firm_s, p.reaction_s);
    PlantReaction hand(p);
    const Times t = times_after(hand, Vec3(3, 0, 0), 1.5);
    EXPECT_GE(t.reflex, p.reflex_s) << seed;
    EXPECT_GE(t.reaction, p.reaction_s) << seed;
  }
  EXPECT_EQ(draw_hand_reaction(3).firm_s, draw_hand_reaction(3).firm_s);
  EXPECT_NE(draw_hand_reaction(3).firm_s, draw_hand_reaction(4).firm_s);
}

TEST(HandReaction, OnlySuddenForcesAreATouch) {
  PlantReaction hand(switched_on());
  for (int n = 0; n < 40000; ++n) hand.feel(Vec3(0, 2.0 * n / 40000, 0), kStep);  // 1 N/s
  EXPECT_FALSE(hand.touched()) << "a slow push is the hand's own";
  for (int n = 0; n < 200; ++n) hand.feel(Vec3(0, 2.5, 0), kStep);
  EXPECT_TRUE(hand.touched());
}

TEST(HandReaction, RelaxesAfterQuiet) {
  const HandReaction p = switched_on();
  PlantReaction hand(p);
  times_after(hand, Vec3(0, 0, 1), 1.0);
  EXPECT_EQ(hand.firmness(), 1);
  double last = 1;
  for (int n = 0; n < 20000; ++n) {
    hand.feel(Vec3::Zero(), kStep);
    ASSERT_LE(last - hand.firmness(), 1.01 * kStep / 0.2) << "no leap";
    last = hand.firmness();
  }
  EXPECT_EQ(hand.firmness(), 0);
  EXPECT_FALSE(hand.touched());
}

TEST(HandReaction, OffItFeelsNothing) {
  PlantReaction hand{HandReaction{}};
  const Times t = times_after(hand, Vec3(0, 0, 10), 1.0);
  EXPECT_LT(t.reflex, 0);
  EXPECT_LT(t.reaction, 0);
  EXPECT_FALSE(HandParameters{}.reaction.on);
}

/// A hand that holds a tool which is suddenly displaced by 20 mm at 0.5 s; the impedance that acts afterwards.
HandParameters acting_after(const HandParameters& p, double seconds, bool let_go = false) {
  HandModel hand(p, 1);
  hand.set_intent({}, 0.0, 1e-3);
  for (int n = 0; n < 10000; ++n) hand.update({}, kStep);
  StylusMotion moved;
  moved.X_BS.p = {0.02, 0, 0};
  for (int n = 0; n < std::lround(seconds / kStep); ++n) hand.update(moved, kStep);
  if (let_go) hand.let_go();
  return hand.acting();
}

HandParameters reacting(GripPreset grip) {
  HandParameters p = hand_parameters(grip);
  p.tremor_m = 0;
  p.reaction = switched_on();
  return p;
}

TEST(HandReaction, TheArmStiffensByReflexAndTheGripByWill) {
  const HandParameters p = reacting(GripPreset::kFingertip), firm = hand_parameters(GripPreset::kFirm);
  EXPECT_EQ(acting_after(p, 0.039).arm_stiffness, p.arm_stiffness);
  const HandParameters reflex = acting_after(p, 0.12);
  EXPECT_NEAR(reflex.arm_stiffness, 1.5 * p.arm_stiffness, 1e-9);
  EXPECT_EQ(reflex.grip_stiffness, p.grip_stiffness) << "the fingers wait for the will";
  EXPECT_EQ(acting_after(p, 0.174).grip_stiffness, p.grip_stiffness);
  EXPECT_GT(acting_after(p, 0.300).grip_stiffness, p.grip_stiffness);
  const HandParameters closed = acting_after(p, 0.47);
  EXPECT_NEAR(closed.grip_stiffness, firm.grip_stiffness, 1e-9);
  EXPECT_NEAR(closed.grip_damping, firm.grip_damping, 1e-9);
  EXPECT_NEAR(closed.arm_stiffness, std::max(1.5 * p.arm_stiffness, firm.arm_stiffness), 1e-9);
}

TEST(HandReaction, LettingGoForgetsTheTouch) {
  const HandParameters p = reacting(GripPreset::kLight);
  EXPECT_EQ(acting_after(p, 0.6, true).grip_stiffness, p.grip_stiffness);
}

TEST(HandReaction, AFirmHandDoesNotBecomeSofter) {
  HandParameters p = reacting(GripPreset::kFirm);
  p.grip_stiffness = 2000;
  EXPECT_EQ(acting_after(p, 0.6).grip_stiffness, 2000);
}

TEST(HandReaction, StiffeningMakesNoLeapOfForce) {
  HandModel hand(reacting(GripPreset::kFingertip), 1);
  hand.set_intent({}, 0.0, 1e-3);
  for (int n = 0; n < 10000; ++n) hand.update({}, kStep);
  StylusMotion moved;
  moved.X_BS.p = {0.02, 0, 0};
  double last = hand.update(moved, kStep).stylus_B.force.norm(), most = 0;
  for (int n = 0; n < 20000; ++n) {
    const double now = hand.update(moved, kStep).stylus_B.force.norm();
    most = std::max(most, std::abs(now - last));
    last = now;
  }
  EXPECT_LT(most, 0.01) << "N from one sub-step to the next";
}

}  // namespace
}  // namespace trocar::hand_reaction_test
