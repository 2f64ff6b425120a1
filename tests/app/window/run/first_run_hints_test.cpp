#include "app/window/run/first_run_hints.h"

#include <gtest/gtest.h>

namespace trocar::first_run_hints_test {
namespace {

using Kind = InputEvent::Kind;

InputEvent event(Kind kind) {
  InputEvent out;
  out.kind = kind;
  return out;
}

std::vector<bool> done(const FirstRunHints& hints, InputKind kind = InputKind::kMouse) {
  std::vector<bool> out;
  for (const FirstRunHints::Hint& mark : hints.marks(Translator(), KeyMap(), kind)) out.push_back(mark.done);
  return out;
}

TEST(FirstRunHints, SaysNothingUnlessItIsWanted) {
  FirstRunHints hints;
  EXPECT_FALSE(hints.speaks());
  hints.begin(false);
  EXPECT_FALSE(hints.speaks());
  hints.begin(true);
  EXPECT_TRUE(hints.speaks());
}

TEST(FirstRunHints, TicksWhatTheMouseHasDoneAndThenFallsSilent) {
  FirstRunHints hints;
  hints.begin(true);
  InputEvent at = event(Kind::kMouseMove);
  for (int i = 0; i < 5; ++i, at.x += 10) hints.saw(at, KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{false, false, false, false})) << "a twitch is no movement";
  for (int i = 0; i < 20; ++i, at.x += 10) hints.saw(at, KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{true, false, false, false}));
  hints.saw(event(Kind::kWheel), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{true, true, false, false}));
  hints.pass(100);
  EXPECT_TRUE(hints.speaks()) << "it waits for the last";
  hints.saw(event(Kind::kButtonDown), KeyMap());
  EXPECT_FALSE(done(hints)[2]) << "it may become a click";
  hints.pass(0.5);
  hints.saw(event(Kind::kButtonUp), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{true, true, true, false}));
  hints.saw(event(Kind::kButtonDown), KeyMap());
  hints.pass(0.1);
  hints.saw(event(Kind::kButtonUp), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{true, true, true, true}));
  EXPECT_TRUE(hints.speaks()) << "the ticks are seen for a moment";
  hints.pass(2.5);
  EXPECT_FALSE(hints.speaks());
}

TEST(FirstRunHints, InTissueTheyAreOfJawsInstrumentsAndPedal) {
  FirstRunHints hints;
  hints.begin(true, FirstRunHints::Tries::kWorks);
  const auto marks = hints.marks(Translator(), KeyMap(), InputKind::kMouse);
  ASSERT_EQ(marks.size(), 5U);
  EXPECT_EQ(marks[2].text, "G, held: close the jaws");
  EXPECT_EQ(hints.marks(Translator(), KeyMap(), InputKind::kPad)[3].text, "Right stick pressed: next instrument");
  for (const std::int32_t key : std::initializer_list<std::int32_t>{'G', 'T', 'F', kKeyPageUp}) {
    InputEvent down = event(Kind::kKeyDown);
    down.key = key;
    hints.saw(down, KeyMap());
  }
  EXPECT_EQ(done(hints), (std::vector<bool>{false, true, true, true, true}));
  hints.pass(9);
  EXPECT_TRUE(hints.speaks());
  InputEvent right = event(Kind::kKeyDown);
  right.key = kKeyRight;
  hints.saw(right, KeyMap());
  hints.pass(3);
  EXPECT_FALSE(hints.speaks());
}

TEST(FirstRunHints, WhereTheShaftIsTurnedTheyAreOfLeanAndRoll) {
  FirstRunHints hints;
  hints.begin(true, FirstRunHints::Tries::kTurns);
  EXPECT_EQ(hints.marks(Translator(), KeyMap(), InputKind::kMouse)[2].text, "Right button, held: lean the shaft");
  hints.saw(event(Kind::kWheel), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{false, true, false, false}));
  InputEvent right = event(Kind::kButtonDown);
  right.button = MouseButton::kRight;
  hints.saw(right, KeyMap());
  hints.saw(event(Kind::kWheel), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{false, true, false, true}));
  hints.saw(event(Kind::kMouseMove), KeyMap());
  EXPECT_EQ(done(hints), (std::vector<bool>{false, true, true, true}));
  hints.begin(true, FirstRunHints::Tries::kRolls);
  EXPECT_EQ(hints.marks(Translator(), KeyMap(), InputKind::kKeyboard).back().text, "Q, E: roll the shaft");
  EXPECT_EQ(done(hints), (std::vector<bool>{false, false, false})) << "through a port nothing leans";
}

TEST(FirstRunHints, KeysDoAsWellAndTheRightButtonDoesNot) {
  FirstRunHints hints;
  hints.begin(true);
  InputEvent press = event(Kind::kButtonDown);
  press.button = MouseButton::kRight;
  hints.saw(press, KeyMap());
  EXPECT_FALSE(done(hints)[2]);
  for (const std::int32_t key : {std::int32_t{kKeyLeft}, std::int32_t{kKeyPageUp}, KeyMap().key_of(Action::kAct)}) {
    InputEvent down = event(Kind::kKeyDown);
    down.key = key;
    hints.saw(down, KeyMap());
  }
  hints.pass(0.5);
  EXPECT_EQ(done(hints), (std::vector<bool>{true, true, true, false}));
}

TEST(FirstRunHints, ItsWordsFitTheInput) {
  FirstRunHints hints;
  hints.begin(true);
  EXPECT_NE(hints.marks(Translator(), KeyMap(), InputKind::kKeyboard)[1].text.find("Page up"), std::string::npos);
  EXPECT_NE(hints.marks(Translator(), KeyMap(), InputKind::kPad)[0].text.find("stick"), std::string::npos);
  InputEvent pad = event(Kind::kPad);
  pad.axis[0] = 1;
  pad.axis[5] = 1;
  pad.buttons = kPadRightBumper;
  hints.saw(pad, KeyMap());
  hints.pass(0.5);
  EXPECT_EQ(done(hints, InputKind::kPad), (std::vector<bool>{true, true, true, false}));
}

}  // namespace
}  // namespace trocar::first_run_hints_test
