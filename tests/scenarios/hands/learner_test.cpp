// The hand that learns, and the turn of a wrist.
#include <cmath>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/hands/turn_plan.h"
#include "scenarios/kinds/reach/pose_task.h"

namespace trocar::learner_test {
namespace {

const std::filesystem::path kHands = std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/hands";

HandSkill skill(const std::string& name) { return load_hand_script(kHands / (name + ".toml")).skill; }

TEST(Learner, BeginsAsTheOneAndEndsAsTheOther) {
  const HandSkill from = skill("novice"), to = skill("expert");
  const HandSkill first = learned_skill(from, to, 8, 1), late = learned_skill(from, to, 8, 200);
  EXPECT_DOUBLE_EQ(first.speed_factor, from.speed_factor);
  EXPECT_DOUBLE_EQ(first.force_bias, from.force_bias);
  EXPECT_EQ(first.max_corrections, from.max_corrections);
  EXPECT_NEAR(late.speed_factor, to.speed_factor, 1e-9);
  EXPECT_NEAR(late.aim_angle_rad, to.aim_angle_rad, 1e-9);
}

TEST(Learner, HasAThirdOfTheWayLeftAfterTheTimeConstant) {
  const HandSkill from = skill("novice"), to = skill("expert");
  const HandSkill ninth = learned_skill(from, to, 8, 9);
  EXPECT_NEAR((ninth.aim_lateral_m - to.aim_lateral_m) / (from.aim_lateral_m - to.aim_lateral_m), std::exp(-1.0), 1e-9);
  double before = from.pause_s;
  for (int attempt = 2; attempt < 40; ++attempt) {
    const double pause = learned_skill(from, to, 8, attempt).pause_s;
    EXPECT_LT(pause, before);
    before = pause;
  }
}

TEST(Learner, IsMadeFromTheHandsOfItsFolder) {
  EXPECT_NE(make_hand("learner", 1, kHands, 5), nullptr);
  const HandScript script = load_hand_script(kHands / "learner.toml");
  EXPECT_EQ(script.kind, HandKind::kLearner);
  EXPECT_EQ(script.learning.from, "novice");
  EXPECT_DOUBLE_EQ(script.learning.attempts, 8);
  EXPECT_THROW(make_hand(script, 1), InputError) << "a script alone does not say where the others are";
}

TEST(Learner, NeedsSkilledHandsToLearnFrom) {
  const std::string text = "name = \"l\"\nkind = \"learner\"\n[learning]\nfrom = \"novice\"\nto = \"expert\"\n";
  EXPECT_THROW(parse_hand_script(text, "l.toml"), InputError) << "attempts is missing";
  EXPECT_EQ(parse_hand_script(text + "attempts = 3\n", "l.toml").learning.to, "expert");
  try {
    parse_hand_script(text + "attempts = 0\n", "l.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("l.toml:6:12: 'attempts' = 0 is out of range"), std::string::npos)
        << error.what();
  }
}

TEST(TurnPlan, GoesTheShortestWayAndStops) {
  const Mat3 from = rotation_by(Vec3(0.1, 0.2, 0.3)), to = from * rotation_by(Vec3(0, 0.8, 0));
  const TurnPlan plan(from, to, 2);
  EXPECT_TRUE(plan.at(0).isApprox(from, 1e-12));
  EXPECT_TRUE(plan.at(2).isApprox(to, 1e-12));
  EXPECT_TRUE(plan.at(9).isApprox(to, 1e-12));
  EXPECT_NEAR(rotation_between(from, plan.at(1)), 0.4, 1e-9) << "half way at half time";
  double before = 0;
  for (double t = 0.1; t < 2; t += 0.1) {
    const double angle = rotation_between(from, plan.at(t));
    EXPECT_GE(angle, before);
    before = angle;
  }
}

TEST(TurnPlan, StaysWhereThereIsNothingToTurn) {
  const Mat3 R = rotation_by(Vec3(1, 0, 0));
  EXPECT_TRUE(TurnPlan(R, R, 1).at(0.5).isApprox(R, 1e-12));
}

}  // namespace
}  // namespace trocar::learner_test
