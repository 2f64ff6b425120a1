// The head-up display's pieces as ImGui draws them: where they were laid out, in the colours that say what they mean.
#include "app/window/ui/hud_draw_list.h"

#include <numbers>

#include "app/window/ui/theme.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::hud_draw_list_test {
namespace {

constexpr Rgb kTrack{38, 43, 50}, kGood{40, 200, 150}, kWhite{240, 242, 245}, kYellow{240, 200, 20},
    kAccent{240, 228, 66}, kOverLimit{225, 104, 20};

class HudDrawn : public testing_support::UiBench {
 protected:
  void paint(const Draw& draw) {
    frame(draw);
    image_ = target_->read();
  }
  void paint(const HudLayout& layout) {
    paint([&](Ui& ui) { draw_hud(ui, layout); });
  }
  Rgb at(int x, int y) const {
    const std::uint8_t* p = image_.pixel(x, y);
    return {p[0], p[1], p[2]};
  }
  bool lit(int x, int y) const { return at(x, y).r + at(x, y).g + at(x, y).b > 60; }
  int count_lit(int x, int y, int width, int height) const {
    int count = 0;
    for (int i = x; i < x + width; ++i)
      for (int j = y; j < y + height; ++j) count += lit(i, j) ? 1 : 0;
    return count;
  }
  static HudBar bar(double value) {
    HudBar out;
    out.track = {100, 100, 200, 20};
    out.value = value;
    return out;
  }
  Image image_;
};

TEST_F(HudDrawn, BarIsFilledAsFarAsItsValueInTheColourOfItsLevel) {
  using Level = HudBar::Level;
  for (const auto& [level, colour] :
       {std::pair{Level::kBelow, Rgb{60, 140, 215}}, std::pair{Level::kInBand, kGood},
        std::pair{Level::kAbove, okabe_ito::kOrange}, std::pair{Level::kOverLimit, kOverLimit}}) {
    HudLayout layout;
    layout.bars = {bar(0.5)};
    layout.bars[0].level = level;
    paint(layout);
    EXPECT_EQ(at(120, 110), colour) << static_cast<int>(level);
    EXPECT_EQ(at(195, 110), colour) << static_cast<int>(level);
    EXPECT_EQ(at(206, 110), kTrack) << "no further";
    EXPECT_EQ(at(150, 102), kTrack) << "the fill leaves the track's edge free";
  }
}

TEST_F(HudDrawn, BandAndLimitAreMarkedOnTheTrack) {
  HudLayout layout;
  layout.bars = {bar(0)};
  layout.bars[0].band_low = 0.25;
  layout.bars[0].band_high = 0.5;
  layout.bars[0].limit = 0.8;
  layout.bars[0].peak = 0.7;
  paint(layout);
  EXPECT_EQ(at(240, 115), kWhite) << "the peak";
  EXPECT_EQ(at(150, 110), kGood);
  EXPECT_EQ(at(200, 110), kGood);
  EXPECT_EQ(at(260, 110), kOverLimit);
  EXPECT_EQ(at(125, 110), kTrack);
  EXPECT_EQ(at(230, 110), kTrack);
  EXPECT_GT(at(175, 110).g, 70) << "the band is green";
  int red = 0;
  for (int x = 264; x < 298; ++x) red += at(x, 110).r > 60 ? 1 : 0;
  EXPECT_EQ(red, 34) << "all beyond the limit";
}

TEST_F(HudDrawn, DotOfTheDialStandsWhereTheErrorIs) {
  HudDial dial;
  dial.face = {400, 200, 100, 100};
  dial.depth = {520, 200, 12, 100};
  dial.x = 0.8;
  dial.y = 0.4;
  dial.away = 0.5;
  HudLayout layout;
  layout.dials = {dial};
  paint(layout);
  EXPECT_EQ(at(486, 232), kYellow) << "right and up";
  EXPECT_EQ(at(526, 226), kYellow) << "away is up";
  EXPECT_NE(at(526, 274), kYellow);
  layout.dials[0].x = layout.dials[0].y = layout.dials[0].away = 0;
  layout.dials[0].inside = true;
  paint(layout);
  EXPECT_EQ(at(450, 250), kGood);
  EXPECT_EQ(at(526, 250), kGood);
}

TEST_F(HudDrawn, SymbolsDifferInShape) {
  const auto box = [](HudShape::Kind kind, double x) { return HudShape{kind, {x, 400, 40, 40}}; };
  HudLayout layout;
  using Kind = HudShape::Kind;
  layout.shapes = {box(Kind::kTick, 100), box(Kind::kOpen, 200), box(Kind::kUp, 300), box(Kind::kDown, 400)};
  paint(layout);
  EXPECT_EQ(at(110, 408), okabe_ito::kGreen);
  EXPECT_FALSE(lit(220, 420)) << "a ring";
  EXPECT_TRUE(lit(202, 420) || lit(203, 420));
  EXPECT_FALSE(lit(307, 408));
  EXPECT_EQ(at(307, 421), okabe_ito::kOrange) << "the head of the arrow upwards is broad at its middle";
  EXPECT_EQ(at(320, 437), okabe_ito::kOrange);
  EXPECT_EQ(at(407, 419), okabe_ito::kSky);
  EXPECT_FALSE(lit(407, 434)) << "and downwards it ends in a point";
}

TEST_F(HudDrawn, TextIsNoWiderThanItWasLaidOut) {
  HudText text;
  text.text = "Reach 0.4 to 0.8 N and hold.";
  text.size = 18;
  text.box = {100, 500, 0, 24};
  text.baseline = 518;
  HudLayout layout;
  layout.texts = {text};
  paint(layout);
  ASSERT_GT(count_lit(190, 490, 200, 40), 50) << "as wide as it is where no width is given";
  layout.texts[0].box.width = 80;
  paint(layout);
  EXPECT_EQ(count_lit(183, 490, 200, 40), 0);
  EXPECT_GT(count_lit(150, 490, 30, 40), 10) << "smaller, not cut";
}

TEST_F(HudDrawn, RimArrowPointsOutwardsWithItsTipOnTheRim) {
  for (const auto& [quarters, dx, dy] : {std::tuple{0, 1, 0}, std::tuple{1, 0, -1}, std::tuple{2, -1, 0}}) {
    const double turned = quarters * std::numbers::pi / 2, angle = turned;
    paint([turned](Ui&) { draw_rim_arrow(300, 300, 100, turned, 26, Ink::kAccent); });
    const auto along = [&, x = dx, y = dy](int r, int aside) {
      return at(300 + r * x - aside * y, 300 + r * y + aside * x);
    };
    EXPECT_EQ(along(80, 0), kAccent) << angle;
    EXPECT_EQ(along(78, 11), kAccent) << angle << ": broad at its foot";
    EXPECT_NE(along(95, 11), kAccent) << angle << ": narrow at its tip";
    EXPECT_EQ(along(66, 0), (Rgb{0, 0, 0})) << angle;
    EXPECT_EQ(along(108, 0), (Rgb{0, 0, 0})) << angle;
  }
}

}  // namespace
}  // namespace trocar::hud_draw_list_test
