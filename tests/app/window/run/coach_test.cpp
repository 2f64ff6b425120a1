#include "app/window/run/coach.h"

#include <gtest/gtest.h>

namespace trocar::coach_test {
namespace {

using Kind = InputEvent::Kind;

InputEvent event(Kind kind) {
  InputEvent out;
  out.kind = kind;
  return out;
}

std::vector<bool> done(const Coach& coach, InputKind kind = InputKind::kMouse) {
  std::vector<bool> out;
  for (const Coach::CoachMark& mark : coach.marks(Translator(), KeyMap(), kind)) out.push_back(mark.done);
  return out;
}

TEST(Coach, SaysNothingUnlessItIsWanted) {
  Coach coach;
  EXPECT_FALSE(coach.speaks());
  coach.begin(false);
  EXPECT_FALSE(coach.speaks());
  coach.begin(true);
  EXPECT_TRUE(coach.speaks());
}

TEST(Coach, TicksWhatTheMouseHasDoneAndThenFallsSilent) {
  Coach coach;
  coach.begin(true);
  InputEvent at = event(Kind::kMouseMove);
  for (int i = 0; i < 5; ++i, at.x += 10) coach.saw(at, KeyMap());
  EXPECT_EQ(done(coach), (std::vector<bool>{false, false, false})) << "a twitch is no movement";
  for (int i = 0; i < 20; ++i, at.x += 10) coach.saw(at, KeyMap());
  EXPECT_EQ(done(coach), (std::vector<bool>{true, false, false}));
  coach.saw(event(Kind::kWheel), KeyMap());
  EXPECT_EQ(done(coach), (std::vector<bool>{true, true, false}));
  coach.pass(100);
  EXPECT_TRUE(coach.speaks()) << "it waits for the last";
  coach.saw(event(Kind::kButtonDown), KeyMap());
  EXPECT_EQ(done(coach), (std::vector<bool>{true, true, true}));
  EXPECT_TRUE(coach.speaks()) << "the ticks are seen for a moment";
  coach.pass(2.5);
  EXPECT_FALSE(coach.speaks());
}

TEST(Coach, KeysDoAsWellAndTheRightButtonDoesNot) {
  Coach coach;
  coach.begin(true);
  InputEvent press = event(Kind::kButtonDown);
  press.button = MouseButton::kRight;
  coach.saw(press, KeyMap());
  EXPECT_FALSE(done(coach)[2]);
  for (const std::int32_t key : {std::int32_t{kKeyLeft}, std::int32_t{kKeyPageUp}, KeyMap().key_of(Action::kClose)}) {
    InputEvent down = event(Kind::kKeyDown);
    down.key = key;
    coach.saw(down, KeyMap());
  }
  EXPECT_EQ(done(coach), (std::vector<bool>{true, true, true}));
}

TEST(Coach, ItsWordsFitTheInput) {
  Coach coach;
  coach.begin(true);
  EXPECT_NE(coach.marks(Translator(), KeyMap(), InputKind::kKeyboard)[1].text.find("Page up"), std::string::npos);
  EXPECT_NE(coach.marks(Translator(), KeyMap(), InputKind::kPad)[0].text.find("stick"), std::string::npos);
  InputEvent pad = event(Kind::kPad);
  pad.axis[0] = 1;
  pad.axis[5] = 1;
  pad.buttons = kPadRightBumper;
  coach.saw(pad, KeyMap());
  EXPECT_EQ(done(coach, InputKind::kPad), (std::vector<bool>{true, true, true}));
}

}  // namespace
}  // namespace trocar::coach_test
