// The head-up display holds: no clipping, no overlap, readable, at three text scales and with hostile content.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "app/picture/display/hud_layout.h"
#include "app/picture/display/hud_painter.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_hud_test {
namespace {

Hud crowded_hud() {
  Hud hud = testing_support::sample_hud();
  hud.trainee = "Trainee: Maximiliane-Alexandra Freifrau von Hohenlohe-Waldenburg-Schillingsf\u00fcrst";
  hud.title = "E14 Mini cholecystectomy with unexpectedly long exercise title for every language \u00b7 exam";
  hud.limit_s = 5999;
  hud.bars[0].label = "Linkes Instrument, Kraft am Gewebe";
  hud.bars[0].band_low_n = 0.75, hud.bars[0].band_high_n = 12.25, hud.bars[0].limit_n = 14.75,
  hud.bars[0].peak_n = 123.4;
  hud.steps.clear();
  for (int i = 0; i < 11; ++i)
    hud.steps.push_back(
        {"Step with a description that needs more than one line of the column, number " + std::to_string(i),
         i < 4    ? HudStep::State::kDone
         : i == 4 ? HudStep::State::kCurrent
                  : HudStep::State::kOpen});
  hud.rows.clear();
  for (int i = 0; i < 16; ++i)
    hud.rows.push_back({"Kontaktverluste des rechten Instruments", "1234567.89 / 9999999.99", "mm/s"});
  hud.device = {
      {"plant", "simulated plant with a long name", ""}, {"loop", "1000.00", "Hz"}, {"passivity", "active 12.3", "%"}};
  hud.credit += hud.credit + hud.credit + hud.credit;
  hud.toast = "Too much pull on the cystic duct: 5.6 N while the limit of this level of the exercise is 5 N";
  hud.toast_hint = "Relax until the bar is green, then continue with the same step and do not hurry it.";
  return hud;
}

bool overlap(const HudBox& a, const HudBox& b) {
  constexpr double kTouch = 0.5;  // px: boxes are fractional, glyphs are placed on whole pixels
  return a.x < b.right() - kTouch && b.x < a.right() - kTouch && a.y < b.bottom() - kTouch && b.y < a.bottom() - kTouch;
}

using Case = std::tuple<double, std::pair<int, int>, bool>;

class HudLayoutTest : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    std::tie(scale_, size_, crowded_) = GetParam();
    hud_ = crowded_ ? crowded_hud() : testing_support::sample_hud();
    layout_ = layout_hud(hud_, size_.first, size_.second, scale_, fonts_);
  }
  double scale_ = 1;
  std::pair<int, int> size_;
  bool crowded_ = false;
  FontSet fonts_;
  Hud hud_;
  HudLayout layout_;
};

TEST_P(HudLayoutTest, NoTwoTextsOverlap) {
  for (std::size_t i = 0; i < layout_.texts.size(); ++i)
    for (std::size_t j = i + 1; j < layout_.texts.size(); ++j)
      EXPECT_FALSE(overlap(layout_.texts[i].box, layout_.texts[j].box))
          << '"' << layout_.texts[i].text << "\" and \"" << layout_.texts[j].text << '"';
}

TEST_P(HudLayoutTest, NothingLeavesThePicture) {
  for (const HudText& text : layout_.texts) {
    EXPECT_GE(text.box.x, 0) << text.text;
    EXPECT_GE(text.box.y, 0) << text.text;
    EXPECT_LE(text.box.right(), size_.first + 0.5) << text.text;
    EXPECT_LE(text.box.bottom(), size_.second + 0.5) << text.text;
  }
}

TEST_P(HudLayoutTest, TextShrinksByAQuarterAtMostAndNumbersAreNeverCut) {
  ASSERT_FALSE(layout_.texts.empty());
  const double body = 18 * std::min(scale_ * size_.second / 720.0, size_.first / 640.0);
  const double toast = 0.75 * body / scale_;  // over the picture: as at 100 % before it covers too much
  const auto digits = [](const std::string& s) { return s.find_first_of("0123456789") != std::string::npos; };
  for (const HudText& text : layout_.texts) {
    const bool number = digits(text.text);
    EXPECT_GE(text.size, number ? 8 : text.box.right() < layout_.column.x ? toast - 1 : 0.75 * body - 1) << text.text;
    if (number && text.box.x >= layout_.column.x) {
      EXPECT_FALSE(text.text.ends_with("\u2026")) << text.text;
    }
  }
}

TEST(HudContent, GaugesAreLeftOutLast) {
  FontSet fonts;
  Hud hud = crowded_hud();
  hud.bars.resize(2, hud.bars[0]);
  hud.rows.push_back({"Hold", "72", "%", true});
  for (const auto& [width, height] : {std::pair(640, 400), {800, 600}, {1280, 720}}) {
    const HudLayout layout = layout_hud(hud, width, height, 2, fonts);
    EXPECT_EQ(layout.bars.size(), 2U) << width;
    EXPECT_TRUE(std::any_of(layout.texts.begin(), layout.texts.end(), [](const HudText& t) {
      return t.text == "72 %";
    })) << width;
  }
}

TEST(HudContent, AToastCoversNoMoreThanAFifthOfThePictureWhileItCanBeSmaller) {
  FontSet fonts;
  Hud hud = testing_support::sample_hud();
  hud.toast = "Move the tip into the start ball";
  hud.toast_hint = "It floats above the organ, at the height of the port.";
  const HudLayout layout = layout_hud(hud, 1280, 720, 2, fonts);
  const PixelRect scene = hud_scene_window(hud, 1280, 720, 2);
  const auto toast = std::find_if(layout.shapes.begin(), layout.shapes.end(),
                                  [](const HudShape& s) { return s.kind == HudShape::Kind::kToast; });
  ASSERT_NE(toast, layout.shapes.end());
  EXPECT_LE(toast->box.height, 0.2 * scene.height);
}

TEST_P(HudLayoutTest, BarsAndSymbolsKeepClearOfTexts) {
  for (const HudText& text : layout_.texts) {
    for (const HudBar& bar : layout_.bars) EXPECT_FALSE(overlap(text.box, bar.track)) << text.text;
    for (const HudShape& shape : layout_.shapes)
      if (shape.kind >= HudShape::Kind::kTick) {
        EXPECT_FALSE(overlap(text.box, shape.box)) << text.text;
      }
  }
}

TEST_P(HudLayoutTest, BoxesHoldWhatTheFontDraws) {
  for (const HudText& text : layout_.texts) {
    EXPECT_NEAR(text.box.width, fonts_.width(text.text, text.size, text.bold), 1e-9) << text.text;
    for (const char32_t code : decode_utf8(text.text)) {
      const Glyph& glyph = fonts_.glyph(code, text.size, text.bold);
      EXPECT_LE(glyph.top, text.baseline - text.box.y + 1.5) << text.text;
      EXPECT_LE(glyph.height - glyph.top, text.box.bottom() - text.baseline + 1.5) << text.text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ScalesSizesContents, HudLayoutTest,
                         ::testing::Combine(::testing::Values(1.0, 1.5, 2.0),
                                            ::testing::Values(std::pair(1280, 720), std::pair(1920, 1080),
                                                              std::pair(1024, 768)),
                                            ::testing::Bool()));

bool contains(const HudLayout& layout, const std::string& words) {
  return std::any_of(layout.texts.begin(), layout.texts.end(),
                     [&](const HudText& t) { return t.text.find(words) != std::string::npos; });
}

TEST(HudContent, TwelveRowsStandInFullAtOrdinaryScale) {
  FontSet fonts;
  Hud hud = testing_support::sample_hud();
  hud.rows.clear();
  for (int i = 0; i < 12; ++i)
    hud.rows.push_back({"Measure " + std::string(1, static_cast<char>('A' + i)), std::to_string(i), "mm"});
  const HudLayout layout = layout_hud(hud, 1280, 720, 1, fonts);
  for (const HudRow& row : hud.rows) EXPECT_TRUE(contains(layout, row.name)) << row.name;
  for (const HudStep& step : hud.steps) EXPECT_TRUE(contains(layout, step.text.substr(0, 12))) << step.text;
  EXPECT_FALSE(contains(layout, "more after the run"));
}

TEST(HudContent, CutListsSayHowMuchIsMissingAndKeepTheCurrentStep) {
  FontSet fonts;
  const HudLayout layout = layout_hud(crowded_hud(), 1280, 720, 1, fonts);
  EXPECT_TRUE(contains(layout, "more after the run"));
  EXPECT_TRUE(contains(layout, "4/11"));
  const auto current = std::count_if(layout.shapes.begin(), layout.shapes.end(),
                                     [](const HudShape& s) { return s.kind == HudShape::Kind::kCurrent; });
  EXPECT_EQ(current, 1);
}

TEST(HudContent, NameOfARowGetsSixtyPercent) {
  FontSet fonts;
  Hud hud = testing_support::sample_hud();
  hud.rows = {{"WWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWW", "9999999.99", "mm"}};
  const HudLayout layout = layout_hud(hud, 1280, 720, 1, fonts);
  const auto name = std::find_if(layout.texts.begin(), layout.texts.end(),
                                 [](const HudText& t) { return t.text.starts_with("WWW"); });
  ASSERT_NE(name, layout.texts.end());
  EXPECT_GT(name->box.width, 0.5 * layout.column.width);
  EXPECT_TRUE(name->text.ends_with("\u2026"));
}

TEST(HudContent, ForceLevelsFollowBandAndLimit) {
  ForceBar bar{"", 0, 0, 1, 2, 5, 6};
  using L = HudBar::Level;
  for (const auto& [force, level] : {std::pair(0.0, L::kBelow),
                                     {0.99, L::kBelow},
                                     {1.0, L::kInBand},
                                     {2.0, L::kInBand},
                                     {2.01, L::kAbove},
                                     {5.0, L::kOverLimit}}) {
    bar.value_n = force;
    EXPECT_EQ(force_level(bar), level) << force;
  }
  bar.band_low_n = bar.band_high_n = bar.limit_n = 0;
  EXPECT_EQ(force_level(bar), L::kBelow);
}

TEST(HudContent, EveryLevelHasItsOwnSymbol) {
  FontSet fonts;
  Hud hud = testing_support::sample_hud();
  hud.steps.clear();
  hud.bars.resize(1);
  const auto symbol = [&](double force) {
    hud.bars[0].value_n = force;
    for (const HudShape& shape : layout_hud(hud, 1280, 720, 1, fonts).shapes)
      if (shape.kind >= HudShape::Kind::kTick) return shape.kind;
    return HudShape::Kind::kPanel;
  };
  EXPECT_EQ(symbol(0.5), HudShape::Kind::kPanel);
  EXPECT_EQ(symbol(1.5), HudShape::Kind::kTick);
  EXPECT_EQ(symbol(3.0), HudShape::Kind::kUp);
  EXPECT_EQ(symbol(5.5), HudShape::Kind::kWarning);
}

TEST(HudContent, SceneWindowTakesWhatTheDisplayLeaves) {
  const PixelRect all = hud_scene_window(Hud{}, 1280, 720, 1);
  EXPECT_EQ(all.width, 1280);
  EXPECT_EQ(all.height, 720);
  const PixelRect part = hud_scene_window(testing_support::sample_hud(), 1280, 720, 1);
  EXPECT_LT(part.width, 1000);
  EXPECT_GT(part.width, 900);
  EXPECT_GT(part.y, 0);
  EXPECT_LT(part.y + part.height, 720);
}

TEST(HudPainting, LeavesTheScopeWindowAlone) {
  FontSet fonts;
  const Hud hud = testing_support::sample_hud();
  Image image(1280, 720);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{77});
  paint_hud(image, layout_hud(hud, 1280, 720, 1, fonts), fonts);
  const PixelRect window = hud_scene_window(hud, 1280, 720, 1);
  for (int y = window.y; y < window.y + window.height; y += 3)
    for (int x = 0; x < window.width; x += 3) ASSERT_EQ(image.pixel(x, y)[0], 77) << x << " " << y;
  int bright = 0;
  for (int y = 0; y < 720; ++y)
    for (int x = window.width; x < 1280; ++x) bright += image.pixel(x, y)[1] > 170;
  EXPECT_GT(bright, 3000);  // text, bars and symbols of the column
}

TEST(FontText, DecodesWellFormedAndMarksMalformedBytes) {
  EXPECT_EQ(decode_utf8("a\u00fc\u20ac\U0001F600"), U"a\u00fc\u20ac\U0001F600");
  EXPECT_EQ(decode_utf8("x\xFFy"), U"x\uFFFDy");
  EXPECT_EQ(decode_utf8("\xC3"), U"\uFFFD");
  EXPECT_EQ(decode_utf8("\xE2\x82"), U"\uFFFD\uFFFD");
}

TEST(FontText, FitsWithEllipsisAndWrapsAtSpaces) {
  FontSet fonts;
  const std::string text = "The quick brown fox jumps over the lazy dog";
  EXPECT_EQ(fonts.fitted(text, 18, false, 10000), text);
  const std::string cut = fonts.fitted(text, 18, false, 120);
  EXPECT_TRUE(cut.ends_with("\u2026"));
  EXPECT_LE(fonts.width(cut, 18), 120);
  EXPECT_TRUE(fonts.fitted(text, 18, false, 2).empty());
  const auto lines = fonts.wrapped(text, 18, false, 150, 10);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(fonts.width(line, 18), 150);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(fonts.wrapped(text, 18, false, 150, 2).size(), 2U);
}

}  // namespace
}  // namespace trocar::graphics_hud_test
