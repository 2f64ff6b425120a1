#include "app/window/ui/theme.h"

#include <gtest/gtest.h>

#include <set>

namespace trocar::theme_test {
namespace {

// WCAG 2.1: black on white is 21:1; #767676 is the well-known lightest grey that reaches 4.5:1 on white.
TEST(Contrast, IsThatOfTheStandard) {
  EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-9);
  EXPECT_NEAR(contrast({0x76, 0x76, 0x76}, {255, 255, 255}), 4.54, 0.005);
  EXPECT_NEAR(contrast({255, 0, 0}, {255, 255, 255}), 3.998, 0.005);
  EXPECT_EQ(contrast({12, 34, 56}, {12, 34, 56}), 1.0);
}

TEST(Contrast, DoesNotDependOnTheOrder) {
  EXPECT_EQ(contrast({1, 2, 3}, {200, 100, 50}), contrast({200, 100, 50}, {1, 2, 3}));
}

TEST(Theme, EveryTextReadsOnEveryGround) {
  ASSERT_GE(theme_pairs().size(), 40U);
  for (const ThemePair& pair : theme_pairs()) EXPECT_GE(contrast(pair.ink, pair.ground), 4.5) << pair.name;
}

TEST(Theme, EveryInkIsOfTheTable) {
  std::set<std::string> names;
  for (const ThemePair& pair : theme_pairs())
    EXPECT_TRUE(names.insert(pair.name).second) << pair.name << " stands twice";
}

// Shapes are large: WCAG 2.1, 1.4.11 asks for 3:1.
TEST(Theme, ShapesStandOutFromPanelAndBackdrop) {
  for (const Ink ink : {Ink::kText, Ink::kDim, Ink::kHeading, Ink::kGood, Ink::kCaution, Ink::kAlarm, Ink::kAccent})
    for (const Ground ground : {Ground::kPanel, Ground::kBackdrop})
      EXPECT_GE(contrast(shape_colour(ink), ground_colour(ground)), 3.0) << static_cast<int>(ink);
}

TEST(Theme, ShapesAreThePaletteItself) {
  EXPECT_EQ(shape_colour(Ink::kGood), (Rgb{0x00, 0x9E, 0x73}));
  EXPECT_EQ(shape_colour(Ink::kCaution), (Rgb{0xE6, 0x9F, 0x00}));
  EXPECT_EQ(shape_colour(Ink::kAlarm), (Rgb{0xD5, 0x5E, 0x00}));
}

TEST(Theme, OverIsTheMeanAtHalf) {
  EXPECT_EQ(over({200, 100, 0}, 0.5, {100, 200, 50}), (Rgb{150, 150, 25}));
  EXPECT_EQ(over({200, 100, 0}, 1, {1, 1, 1}), (Rgb{200, 100, 0}));
  EXPECT_EQ(over({200, 100, 0}, 0, {1, 1, 1}), (Rgb{1, 1, 1}));
}

TEST(UiUnit, IsOneAt720LinesAndGrowsWithScaleAndWindow) {
  EXPECT_EQ(ui_unit(1, 1280, 720), 1);
  EXPECT_EQ(ui_unit(2, 1280, 720), 2);
  EXPECT_EQ(ui_unit(1, 1920, 1080), 1.5);
  EXPECT_EQ(ui_unit(1.5, 1280, 720), 1.5);
}

TEST(UiUnit, KeepsWithinWhatCanBeReadAndHeld) {
  EXPECT_GE(ui_unit(1, 200, 100), 0.59);
  EXPECT_LE(ui_unit(2, 7680, 4320), 4);
  EXPECT_LT(ui_unit(1, 1280, 2000), 1.01) << "a tall narrow window has no room for larger letters";
}

}  // namespace
}  // namespace trocar::theme_test
