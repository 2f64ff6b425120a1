#include "app/window/input/key_map.h"

#include <set>

#include <gtest/gtest.h>

#include "haptics/input_error.h"

namespace trocar::key_map_test {
namespace {

std::string refusal(const std::map<std::string, std::string>& changes) {
  KeyMap keys;
  try {
    keys.apply(changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(KeyMap, EveryActionHasANameWordsAndAKeyOfItsOwn) {
  const KeyMap keys;
  std::set<std::string> names, words;
  std::set<std::int32_t> taken;
  for (const ActionName& one : action_names()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_TRUE(words.insert(one.words).second) << one.words;
    EXPECT_TRUE(taken.insert(keys.key_of(one.action)).second) << one.name;
    EXPECT_EQ(keys.action_of(keys.key_of(one.action)), one.action);
  }
  EXPECT_EQ(action_names().size(), static_cast<std::size_t>(Action::kMenu) + 1);
  EXPECT_FALSE(keys.action_of(kKeyTab));  // one hand: nothing to change to
  EXPECT_FALSE(keys.action_of('1'));
}

TEST(KeyMap, DefaultsAreThoseOfTheGuide) {
  const KeyMap keys;
  const std::map<Action, std::string> guide{
      {Action::kInsert, "Page up"}, {Action::kRollLeft, "Q"},   {Action::kRollRight, "E"},    {Action::kPitchUp, "Z"},
      {Action::kPitchDown, "C"},    {Action::kAct, "Space"},    {Action::kLetOff, "X"},       {Action::kScope, "V"},
      {Action::kGrip, "G"},         {Action::kPedal, "F"},      {Action::kExchange, "T"},     {Action::kPostLeft, "A"},
      {Action::kLevel, "H"},        {Action::kPause, "P"},      {Action::kRestart, "R"},      {Action::kMark, "M"},
      {Action::kHelp, "F1"},        {Action::kForceBars, "F2"}, {Action::kDevicePanel, "F3"}, {Action::kGuidance, "F5"},
      {Action::kPicture, "F12"},    {Action::kMenu, "Esc"}};
  for (const auto& [action, name] : guide) EXPECT_EQ(key_name(keys.key_of(action)), name);
  EXPECT_TRUE(keys.changes().empty());
}

TEST(KeyMap, AKeyThatIsTakenIsSwapped) {
  KeyMap keys;
  keys.assign(Action::kPause, 'R');
  EXPECT_EQ(keys.key_of(Action::kPause), 'R');
  EXPECT_EQ(keys.key_of(Action::kRestart), 'P');
  keys.assign(Action::kPause, 'Y');
  EXPECT_FALSE(keys.action_of('R'));
  EXPECT_EQ(keys.changes(), (std::map<std::string, std::string>{{"pause", "Y"}, {"restart", "P"}}));
}

TEST(KeyMap, ChangesComeBackAsTheyWere) {
  KeyMap keys, again;
  keys.assign(Action::kLeft, 'J');
  keys.assign(Action::kRight, 'L');
  keys.assign(Action::kAct, kKeyEnter);
  keys.assign(Action::kScope, kKeyPageUp);
  again.apply(keys.changes());
  for (const ActionName& one : action_names()) EXPECT_EQ(again.key_of(one.action), keys.key_of(one.action)) << one.name;
  again.apply({});
  EXPECT_TRUE(again.changes().empty());
}

TEST(KeyMap, AFileFromBeforeAnActionMayHaveGivenItsKeyAway) {
  KeyMap keys;
  keys.apply({{"guidance", "G"}, {"mark", "F"}, {"pause", "M"}, {"picture", "Y"}});
  EXPECT_EQ(keys.key_of(Action::kGuidance), 'G');
  EXPECT_EQ(keys.key_of(Action::kGrip), kKeyF5) << "what guidance has left";
  EXPECT_EQ(keys.key_of(Action::kPedal), 'P') << "mark has F, pause has mark's";
  EXPECT_EQ(keys.key_of(Action::kExchange), 'T');
  EXPECT_NE(refusal({{"guidance", "G"}, {"grip", "G"}}).find("both have G"), std::string::npos);
}

TEST(KeyMap, SomeKeysStay) {
  KeyMap keys;
  EXPECT_THROW(keys.assign(Action::kMenu, 'K'), InputError);
  EXPECT_THROW(keys.assign(Action::kHelp, 'K'), InputError);
  EXPECT_THROW(keys.assign(Action::kPause, kKeyEscape), InputError);
  EXPECT_THROW(keys.assign(Action::kPause, kKeyF1), InputError);
  EXPECT_THROW(keys.assign(Action::kPause, kKeyShift), InputError);
  EXPECT_THROW(keys.assign(Action::kPause, kKeyControl), InputError);
  EXPECT_THROW(keys.assign(Action::kPause, kKeyUnknown), InputError);
  EXPECT_TRUE(keys.changes().empty());
}

TEST(KeyMap, WrongChangesAreNamed) {
  EXPECT_EQ(refusal({{"fly", "K"}}), "keys: 'fly' is no action");
  EXPECT_EQ(refusal({{"pause", "Turbo"}}), "keys: pause: 'Turbo' is no key");
  EXPECT_EQ(refusal({{"pause", "R"}}), "keys: restart and pause both have R");
  EXPECT_NE(refusal({{"pause", "Esc"}}).find("Esc is kept for 'Menu'"), std::string::npos);
  EXPECT_NE(refusal({{"help", "K"}}).find("keeps the key F1"), std::string::npos);
  KeyMap keys;
  EXPECT_THROW(keys.apply({{"mark", "Y"}, {"pause", "R"}}), InputError);
  EXPECT_EQ(keys.key_of(Action::kMark), 'M');  // nothing of it was taken up
}

TEST(KeyNames, GoBothWays) {
  for (std::int32_t key = 0; key <= kKeyAlt; ++key) {
    const std::string name = key_name(key);
    if (name.empty()) continue;
    EXPECT_EQ(key_from_name(name), key) << name;
  }
  EXPECT_EQ(key_from_name("page UP"), kKeyPageUp);
  EXPECT_EQ(key_from_name("q"), 'Q');
  EXPECT_EQ(key_from_name(""), kKeyUnknown);
  EXPECT_EQ(key_from_name("F13"), kKeyUnknown);
  EXPECT_EQ(key_name(kKeyUnknown), "");
  EXPECT_EQ(key_name(200), "");
}

TEST(InputKinds, HaveTheNamesThatAttemptsKeep) {
  EXPECT_STREQ(input_name(InputKind::kMouse), "mouse");
  EXPECT_STREQ(input_name(InputKind::kKeyboard), "keyboard");
  EXPECT_STREQ(input_name(InputKind::kPad), "gamepad");
  EXPECT_STREQ(input_name(InputKind::kSpaceMouse), "spacemouse");
  EXPECT_STREQ(input_name(InputKind::kDevice), "device");
}

}  // namespace
}  // namespace trocar::key_map_test
