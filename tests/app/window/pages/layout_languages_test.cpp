// Every page that needs no run, and the display of a run, in every language, at every size of text and in windows of
// odd shapes: nothing is cut, nothing lies over anything else. Codes are as long as codes may be.
#include <gtest/gtest.h>

#include "app/picture/display/hud_layout.h"
#include "app/window/device/device_panel.h"
#include "app/window/pages/sound_page.h"
#include "app/window/practice/screen_table.h"
#include "app/window/run/hud_words.h"
#include "app/window/run/overlays.h"
#include "app/window/ui/theme.h"
#include "scenarios/kinds/kind.h"
#include "tests/app/window/pages/layout_check.h"
#include "tests/app/window/pages/practice_bench.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::layout_languages_test {
namespace {

using testing_support::expect_laid_out;

constexpr const char* kLongCode = "Krankenschwester-Muster-2026-014";  // 32 letters

struct Window {
  std::string language;
  int width, height;
  double scale;
};

std::string name_of(const Window& w) {
  return w.language + "_" + std::to_string(w.width) + "x" + std::to_string(w.height) + "_" +
         std::to_string(static_cast<int>(100 * w.scale));
}
void PrintTo(const Window& w, std::ostream* out) { *out << name_of(w); }

std::vector<Window> windows() {
  std::vector<Window> out;
  for (const char* language : {"en", "fr", "de"}) {
    for (const double scale : {1.0, 1.5, 2.0}) out.push_back({language, 1280, 720, scale});
    out.push_back({language, 700, 1300, 1});
    out.push_back({language, 700, 1300, 2});
    out.push_back({language, 640, 360, 1});
  }
  return out;
}

class LanguageLayout : public testing_support::HeadlessFixture, public ::testing::WithParamInterface<Window> {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    ModelOptions options = bench_.options();
    options.language = GetParam().language;
    options.scale = GetParam().scale;
    model_ = bench_.model(options);
    target_ = std::make_unique<FrameTarget>(*context_, false);
    layer_ = std::make_unique<UiLayer>(*context_, GetParam().scale);
  }
  void TearDown() override {
    layer_.reset();
    target_.reset();
  }
  /// Frames without the scope's picture, which costs most.
  void draw(const std::function<void(Ui&)>& what) {
    const auto [language, width, height, scale] = GetParam();
    for (int i = 0; i < 3; ++i) {
      target_->begin(width, height);
      layer_->set_scale(scale);
      layer_->begin(width, height, 0.02, {});
      Ui ui(model_->words(), scale, width, height);
      what(ui);
      texts_ = ui.text_audit();
      scrolling_ = ui.scrolling();
      layer_->end();
    }
  }
  void look_at(const std::string& where) {
    expect_laid_out(texts_, GetParam().width, GetParam().height, name_of(GetParam()) + " " + where);
  }
  void page(ScreenName name) {
    const std::unique_ptr<Screen> screen = make_screen(name);
    draw([&](Ui& ui) { screen->frame(ui, *model_, 0.02); });
    look_at(screen_name(name));
    for (const std::string& panel : scrolling_)
      EXPECT_EQ(panel.find("foot"), std::string::npos) << panel << ": buttons are hidden";
  }

  testing_support::PracticeBench bench_;
  std::unique_ptr<PracticeModel> model_;
  std::unique_ptr<FrameTarget> target_;
  std::unique_ptr<UiLayer> layer_;
  std::vector<DrawnText> texts_;
  std::vector<std::string> scrolling_;
};

TEST_P(LanguageLayout, PagesAreClear) {
  page(ScreenName::kStart);
  ASSERT_EQ(model_->sign_in(kLongCode), "");
  for (const ScreenName name :
       {ScreenName::kStart, ScreenName::kCurriculum, ScreenName::kSettings, ScreenName::kProgress})
    page(name);
  for (const Exercise& exercise : model_->exercises()) {
    model_->exercise_id = exercise.id;
    page(ScreenName::kBriefing);
  }
}

TEST_P(LanguageLayout, WhatLiesOverPagesIsClear) {
  SoundPage sounds;
  for (HelpPage help : {HelpPage::kKeys, HelpPage::kMetrics, HelpPage::kSounds}) {
    draw([&](Ui& ui) { help_overlay(ui, *model_, help, sounds); });
    look_at("help");
  }
  for (const bool runs : {false, true}) {
    draw([&](Ui& ui) { menu_overlay(ui, *model_, runs); });
    look_at("menu");
    EXPECT_TRUE(scrolling_.empty()) << "the menu has no room";
  }
  DevicePanel device;
  device.open = true;
  draw([&](Ui& ui) { device.frame(ui, *model_, TickRecord{}, HapticLoopConfig{}, 1, device_panel_area(ui, false)); });
  look_at("device panel");
}

TEST_P(LanguageLayout, NotchStandsBesideItsWords) {
  const Window& w = GetParam();
  const std::unique_ptr<Screen> screen = make_screen(ScreenName::kNotch);
  draw([&](Ui& ui) { screen->frame(ui, *model_, 0.02); });
  look_at("notch");
  const auto stage = screen->stage(*model_, w.width, w.height);
  ASSERT_TRUE(stage);
  const double stage_right = stage->x + stage->width, stage_bottom = stage->y + stage->height;
  if (w.width < w.height) return;  // a tall window: below, or behind
  for (const DrawnText& t : texts_)
    EXPECT_TRUE(t.x >= stage_right || t.x + t.width <= stage->x || t.y >= stage_bottom || t.y + t.height <= stage->y)
        << t.text;
}

/// A notice stands near the upper edge, as tall as its words, whatever they are.
TEST_P(LanguageLayout, NoticesLeaveTheButtonsFree) {
  for (const std::string& said :
       {model_->words()("An exam has no pause: the clock runs on."),
        model_->words()("Results cannot be kept: {0}", {std::string(180, 'x') + " " + std::string(40, 'y')})}) {
    double age_s = 0;
    std::string shown = said;
    draw([&](Ui& ui) { notice_overlay(ui, *model_, 0.01, age_s, shown); });
    ASSERT_EQ(texts_.size(), 1U);
    EXPECT_TRUE(texts_[0].in_front);
    EXPECT_LT(texts_[0].y, 0.3 * GetParam().height);
    EXPECT_TRUE(scrolling_.empty()) << "the notice is cut";
  }
}

/// The display of a run: title with its level, the band, what says that there is no patient.
TEST_P(LanguageLayout, DisplayOfARunIsUncut) {
  const auto [language, width, height, scale] = GetParam();
  FontSet fonts;
  for (const Exercise& exercise : model_->exercises()) {
    Hud hud;
    hud.trainee = std::string("Trainee: ") + kLongCode;
    hud.title = exercise.number + " " + exercise.title + " · exam · direct";
    ForceBar bar;
    bar.label = "Tip force";
    bar.value_n = 0.6;
    bar.band_low_n = 0.4;
    bar.band_high_n = 0.8;
    bar.limit_n = 1.5;
    bar.full_scale_n = 2;
    hud.bars = {bar};
    hud.credit = kind_of(exercise).on_organ ? "Organ: liver (synthetic) · synthetic CT phantom made by Trocar"
                                            : "No organ, no patient data · board exercise in a box trainer";
    hud.limit_s = 120;
    const HudLayout layout = layout_hud(in_words(hud, model_->words()), width, height, scale, fonts);
    bool level = false;
    for (const HudText& text : layout.texts) {
      EXPECT_FALSE(text.text.ends_with("\u2026")) << name_of(GetParam()) << ": " << text.text;
      level = level || text.text.find(model_->words()("exam")) != std::string::npos;
    }
    EXPECT_TRUE(level) << name_of(GetParam()) << ": the level is not said";
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, LanguageLayout, ::testing::ValuesIn(windows()),
                         [](const auto& one) { return name_of(one.param); });

TEST(TinyWindow, IsOneThatHasNoRoomForAPage) {
  EXPECT_TRUE(too_small(200, 100));
  EXPECT_TRUE(too_small(1280, 200));
  EXPECT_FALSE(too_small(640, 360));
  EXPECT_FALSE(too_small(700, 1300));
  for (const double scale : {1.0, 1.5, 2.0}) {
    const double unit = ui_unit(scale, 640, 360);
    EXPECT_GE(640 / unit, kLeastWidth - 1) << "a page has always the room that it was laid out for";
    EXPECT_GE(360 / unit, kLeastHeight - 1);
  }
}

}  // namespace
}  // namespace trocar::layout_languages_test
