// The hand that knows a trick: when it plays it, and whose hand it is otherwise.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/hands/cheating_hand.h"
#include "scenarios/hands/make_hand.h"

namespace trocar::cheating_hand_test {
namespace {

constexpr double kDt = 1e-3;

/// Goes up without end.
class RisingHand final : public Hand {
 public:
  HandIntent update(const Percept&, double dt_s) override {
    HandIntent intent;
    intent.X_TI.p.z() = height_ += dt_s;
    return intent;
  }

 private:
  double height_ = 0;
};

/// Seconds of the clutch and of rest within a time.
struct Played {
  double clutched_s = 0, still_s = 0;
};
Played play(CheatingHand& hand, const Percept& percept, double for_s) {
  Played out;
  double before = hand.update(percept, kDt).X_TI.p.z();
  for (double t = 0; t < for_s; t += kDt) {
    const HandIntent intent = hand.update(percept, kDt);
    out.clutched_s += intent.clutch ? kDt : 0;
    out.still_s += intent.X_TI.p.z() == before ? kDt : 0;
    before = intent.X_TI.p.z();
  }
  return out;
}

CheatingHand cheat(Cheat::Trick trick, double for_s) {
  return CheatingHand(std::make_unique<RisingHand>(), {trick, "somebody", for_s});
}

Percept at_target(std::int32_t target, Cue cue) {
  Percept percept;
  percept.cue = cue;
  percept.target_index = target;
  percept.target_radius_m = 0.003;
  return percept;
}

TEST(CheatingHand, HoldsTheClutchOnceAtEachPlaceThatItHasReached) {
  CheatingHand hand = cheat(Cheat::Trick::kClutch, 2);
  Percept away = at_target(0, Cue::kPress);
  away.tip_T.x() = 0.020;
  EXPECT_EQ(play(hand, away, 3).clutched_s, 0);
  for (const std::int32_t target : {0, 1}) {
    const Played played = play(hand, at_target(target, Cue::kPress), 10);
    EXPECT_NEAR(played.clutched_s, 2, 0.01) << target;
    EXPECT_NEAR(played.still_s, 2, 0.01) << target << ": what it does otherwise goes on afterwards";
  }
}

TEST(CheatingHand, DrawsOutTheFirstObjectAlone) {
  CheatingHand carrying = cheat(Cheat::Trick::kDwell, 5);
  EXPECT_EQ(play(carrying, at_target(0, Cue::kPick), 2).still_s, 0);
  const Played carried = play(carrying, at_target(0, Cue::kCarry), 10);
  EXPECT_NEAR(carried.still_s, 5, 0.01);
  EXPECT_EQ(carried.clutched_s, 0);
  EXPECT_EQ(play(carrying, at_target(1, Cue::kCarry), 10).still_s, 0);
  CheatingHand pressing = cheat(Cheat::Trick::kDwell, 5);
  EXPECT_EQ(play(pressing, at_target(0, Cue::kPress), 2).still_s, 0);
  EXPECT_NEAR(play(pressing, at_target(1, Cue::kPress), 10).still_s, 5, 0.01) << "the first is done, and pressed on";
}

TEST(CheatingHand, IsRefusedWithoutAHandOfItsFolder) {
  const std::string text = "name = \"c\"\nkind = \"cheat\"\n[cheat]\ntrick = \"dwell\"\nof = \"novice\"\n";
  EXPECT_THROW(parse_hand_script(text, "c.toml"), InputError) << "for_s is missing";
  const HandScript script = parse_hand_script(text + "for_s = 3\n", "c.toml");
  EXPECT_EQ(script.cheat.of, "novice");
  EXPECT_THROW(make_hand(script, 1), InputError) << "a script alone does not say where the other is";
}

}  // namespace
}  // namespace trocar::cheating_hand_test
