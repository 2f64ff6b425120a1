// Dials, hidden bars and notices of the head-up display: in their place, readable, never on top of each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/picture/display/hud_layout.h"
#include "app/picture/display/hud_painter.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_hud_parts_test {
namespace {

PoseDial sample_dial() {
  PoseDial dial;
  dial.offset_C = Vec3(0.004, -0.002, 0.006);
  dial.position_error_m = dial.offset_C.norm();
  dial.position_tolerance_m = 0.003;
  dial.lean_C = Vec3(0.05, 0.02, 0);
  dial.roll_rad = 0.3;
  dial.angle_error_rad = 0.31;
  dial.angle_tolerance_rad = 0.14;
  return dial;
}

/// 0: a pen to match; 1: bars hidden by the feedback mode; 2: all of it with two notices and long words.
Hud hud_of(int content) {
  Hud hud = testing_support::sample_hud();
  if (content != 1) hud.dial = sample_dial();
  if (content == 0) hud.bars.clear();
  for (ForceBar& bar : hud.bars) bar.hidden = content == 1, bar.hidden_note = "shown only outside the limits";
  if (content == 2) {
    hud.notices = {{"Over the band: 12.34 N", HudNotice::Kind::kTooMuch},
                   {"Handle at the port of a very long name: draw back", HudNotice::Kind::kWarning},
                   {"never shown", HudNotice::Kind::kInfo}};
    hud.toast = "Turn the instrument along the pen and about it";
    hud.toast_hint = "The tip is right.";
  }
  return hud;
}

bool overlap(const HudBox& a, const HudBox& b) {
  constexpr double kTouch = 0.5;  // px: boxes are fractional, glyphs are placed on whole pixels
  return a.x < b.right() - kTouch && b.x < a.right() - kTouch && a.y < b.bottom() - kTouch && b.y < a.bottom() - kTouch;
}

using Case = std::tuple<std::pair<int, int>, double, int>;

class HudParts : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    std::tie(size_, scale_, content_) = GetParam();
    layout_ = layout_hud(hud_of(content_), size_.first, size_.second, scale_, fonts_);
  }
  std::pair<int, int> size_;
  double scale_ = 1;
  int content_ = 0;
  FontSet fonts_;
  HudLayout layout_;
};

TEST_P(HudParts, WordsDoNotMeetWordsOrDials) {
  for (std::size_t i = 0; i < layout_.texts.size(); ++i) {
    for (std::size_t j = i + 1; j < layout_.texts.size(); ++j)
      EXPECT_FALSE(overlap(layout_.texts[i].box, layout_.texts[j].box))
          << '"' << layout_.texts[i].text << "\" and \"" << layout_.texts[j].text << '"';
    for (const HudDial& dial : layout_.dials) {
      EXPECT_FALSE(overlap(layout_.texts[i].box, dial.face)) << layout_.texts[i].text;
      EXPECT_FALSE(overlap(layout_.texts[i].box, dial.depth)) << layout_.texts[i].text;
    }
  }
}

TEST_P(HudParts, NothingLeavesThePictureOrItsColumn) {
  for (const HudText& text : layout_.texts) {
    EXPECT_GE(text.box.x, 0) << text.text;
    EXPECT_LE(text.box.right(), size_.first + 0.5) << text.text;
    EXPECT_LE(text.box.bottom(), size_.second + 0.5) << text.text;
  }
  for (const HudDial& dial : layout_.dials)
    for (const HudBox& box : {dial.face, dial.depth}) {
      EXPECT_GE(box.x, layout_.column.x);
      EXPECT_LE(box.right(), layout_.column.right());
      EXPECT_LE(box.bottom(), layout_.column.bottom());
    }
}

TEST_P(HudParts, NoticesStayOverThePicture) {
  const PixelRect scene = hud_scene_window(hud_of(content_), size_.first, size_.second, scale_);
  int chips = 0;
  for (const HudShape& shape : layout_.shapes) {
    if (shape.kind != HudShape::Kind::kToast) continue;
    ++chips;
    EXPECT_GE(shape.box.x, scene.x);
    EXPECT_LE(shape.box.right(), scene.x + scene.width + 0.5);
    for (const HudShape& other : layout_.shapes)
      EXPECT_FALSE(&other != &shape && other.kind == HudShape::Kind::kToast && overlap(shape.box, other.box));
  }
  EXPECT_EQ(chips, content_ == 2 ? 3 : 0) << "two notices and the message";
}

TEST_P(HudParts, ThePoseErrorIsAlwaysInWords) {
  if (content_ == 1) return;
  const auto said = [&](const std::string& words) {
    return std::any_of(layout_.texts.begin(), layout_.texts.end(),
                       [&](const HudText& t) { return t.text.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(said("7.5 of 3 mm"));
  EXPECT_TRUE(said("18 of 8.02\u00b0"));
}

INSTANTIATE_TEST_SUITE_P(SizesScalesContents, HudParts,
                         ::testing::Combine(::testing::Values(std::pair(1280, 720), std::pair(640, 360),
                                                              std::pair(1920, 1080)),
                                            ::testing::Values(1.0, 1.5), ::testing::Values(0, 1, 2)));

TEST(HudDials, ShareGrowsWithTheErrorAndNeverLeavesTheDial) {
  EXPECT_EQ(dial_share(0), 0);
  EXPECT_DOUBLE_EQ(dial_share(1), 0.4);
  EXPECT_DOUBLE_EQ(dial_share(-0.5), -0.2);
  double last = 0;
  for (double error = 0.1; error < 200; error *= 1.3) {
    EXPECT_GT(dial_share(error), last);
    last = dial_share(error);
    EXPECT_LE(last, 1);
  }
  EXPECT_EQ(std::abs(dial_share(std::nan(""))), 1);
}

TEST(HudDials, TheDotLiesWhereTheTipIsOff) {
  FontSet fonts;
  const HudLayout layout = layout_hud(hud_of(0), 1280, 720, 1, fonts);
  ASSERT_EQ(layout.dials.size(), 2U);
  const HudDial& tip = layout.dials[0];
  EXPECT_GT(tip.x, 0) << "to the right";
  EXPECT_LT(tip.y, 0) << "and below";
  EXPECT_NEAR(tip.y / tip.x, -0.5, 1e-9) << "in the true direction";
  EXPECT_GT(std::hypot(tip.x, tip.y), tip.tolerance) << "outside the ring";
  EXPECT_GT(tip.away, tip.tolerance) << "and too far away";
  EXPECT_FALSE(tip.inside);
  EXPECT_FALSE(tip.turns);
  EXPECT_TRUE(layout.dials[1].turns);
  EXPECT_EQ(layout.dials[1].roll_rad, 0.3);
}

TEST(HudDials, AMatchIsToldByColourAndByWords) {
  FontSet fonts;
  Hud hud = hud_of(0);
  hud.dial->position_error_m = 0.002;
  const HudLayout layout = layout_hud(hud, 1280, 720, 1, fonts);
  EXPECT_TRUE(layout.dials[0].inside);
  EXPECT_FALSE(layout.dials[1].inside);
  const auto ink = [&](const std::string& words) {
    for (const HudText& text : layout.texts)
      if (text.text.find(words) != std::string::npos) return text.ink;
    return HudInk::kAlarm;
  };
  EXPECT_EQ(ink("2.0 of 3 mm"), HudInk::kGood);
  EXPECT_EQ(ink("18 of"), HudInk::kText);
}

TEST(HudDials, PaintedDotAndNeedleFollowTheError) {
  FontSet fonts;
  const auto painted = [&](double x) {
    Hud hud = hud_of(0);
    hud.dial->offset_C = Vec3(x, 0, 0);
    Image image(1280, 720);
    paint_hud(image, layout_hud(hud, 1280, 720, 1, fonts), fonts);
    return image;
  };
  const HudDial dial = layout_hud(hud_of(0), 1280, 720, 1, fonts).dials[0];
  const auto at = [&](double share) {
    const double r = 0.5 * dial.face.width;
    return Eigen::Vector2d(dial.face.x + r * (1 + 0.9 * share), dial.face.y + r);
  };
  const double share = dial_share(0.0045 / 0.003);
  const Image right = painted(0.0045), left = painted(-0.0045);
  EXPECT_GT(testing_support::mean_at(right, at(share), 1)[0], 180) << "yellow dot";
  EXPECT_LT(testing_support::mean_at(right, at(-share), 1)[0], 120);
  EXPECT_GT(testing_support::mean_at(left, at(-share), 1)[0], 180);
}

TEST(HiddenBars, KeepTheirPlaceAndShowNoValue) {
  FontSet fonts;
  Hud shown = hud_of(1), hidden = hud_of(1);
  for (ForceBar& bar : shown.bars) bar.hidden = false;
  const HudLayout with = layout_hud(shown, 1280, 720, 1, fonts), without = layout_hud(hidden, 1280, 720, 1, fonts);
  EXPECT_EQ(with.bars.size(), 2U);
  EXPECT_EQ(without.bars.size(), 0U);
  const auto y_of = [](const HudLayout& layout, const std::string& words) {
    for (const HudText& text : layout.texts)
      if (text.text.find(words) != std::string::npos) return text.box.y;
    return -1.0;
  };
  EXPECT_EQ(y_of(with, "Steps"), y_of(without, "Steps")) << "nothing jumps when a bar appears";
  EXPECT_LT(y_of(without, "1.42"), 0) << "the value is not to be read anywhere";
  EXPECT_LT(y_of(without, "2.3"), 0) << "nor the peak";
  EXPECT_GT(y_of(without, "shown only outside"), 0);
}

TEST(ForceBars, SayNothingOfAPeakThatWasNotKept) {
  FontSet fonts;
  Hud hud = testing_support::sample_hud();
  hud.bars.resize(1);
  const auto peaks = [&] {
    const HudLayout layout = layout_hud(hud, 1280, 720, 1, fonts);
    return std::count_if(layout.texts.begin(), layout.texts.end(),
                         [](const HudText& text) { return text.text.find("peak") != std::string::npos; });
  };
  EXPECT_EQ(peaks(), 1);
  hud.bars[0].peak_n = 0;
  EXPECT_EQ(peaks(), 0);
}

TEST(Notices, TellTheirKindByShape) {
  FontSet fonts;
  const auto symbol = [&](HudNotice::Kind kind) {
    Hud hud = testing_support::sample_hud();
    hud.steps.clear();
    hud.bars.clear();
    hud.notices = {{"x", kind}};
    return layout_hud(hud, 1280, 720, 1, fonts).shapes.back().kind;
  };
  EXPECT_EQ(symbol(HudNotice::Kind::kTooMuch), HudShape::Kind::kUp);
  EXPECT_EQ(symbol(HudNotice::Kind::kTooLittle), HudShape::Kind::kDown);
  EXPECT_EQ(symbol(HudNotice::Kind::kWarning), HudShape::Kind::kWarning);
  EXPECT_EQ(symbol(HudNotice::Kind::kInfo), HudShape::Kind::kInfo);
}

}  // namespace
}  // namespace trocar::graphics_hud_parts_test
