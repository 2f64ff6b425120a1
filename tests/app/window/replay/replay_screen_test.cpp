// The film of a run in the window: opened in the background, steered by keys and pointer, two runs side by side;
// nothing clips.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/window/replay/replay_screen.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/app/window/pages/loop_bench.h"

namespace trocar::testing_support::replay_screen_test {
namespace {

class ReplayScreens : public HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    model_ = bench_.model();
    model_->replay_file = record_short(bench_.folder / "own.trec", "novice");
    screen_ = std::make_unique<ReplayScreen>();
    target_ = std::make_unique<FrameTarget>(*context_, false);
    layer_ = std::make_unique<UiLayer>(*context_, 1);
  }
  void TearDown() override {
    layer_.reset();
    target_.reset();
  }
  /// One frame without the scope's pictures, which cost most.
  std::optional<ScreenName> draw(const std::vector<InputEvent>& events = {}, double dt_s = 0) {
    screen_->stage(*model_, wide_, high_);
    target_->begin(wide_, high_);
    layer_->set_scale(scale_);
    layer_->begin(wide_, high_, std::max(dt_s, 0.001), events);
    Ui ui(model_->words(), scale_, wide_, high_);
    const auto to = screen_->frame(ui, *model_, dt_s);
    texts_ = ui.text_audit();
    scrolling_ = ui.scrolling();
    layer_->end();
    return to;
  }
  bool says(const std::string& part) const {
    return std::any_of(texts_.begin(), texts_.end(),
                       [&](const DrawnText& t) { return t.text.find(part) != std::string::npos; });
  }
  /// Until `what` or a minute has gone by.
  bool wait_until(const std::function<bool()>& what) {
    for (int i = 0; i < 6000; ++i) {
      draw();
      if (what()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  bool opened() {
    return wait_until([&] { return screen_->clock().to_s() > 3 && says("Pause"); });
  }
  const ReplayClock& clock() const { return screen_->clock(); }

  PracticeBench bench_;
  std::unique_ptr<PracticeModel> model_;
  int wide_ = 1280, high_ = 720;
  double scale_ = 1;
  std::unique_ptr<ReplayScreen> screen_;
  std::unique_ptr<FrameTarget> target_;
  std::unique_ptr<UiLayer> layer_;
  std::vector<DrawnText> texts_;
  std::vector<std::string> scrolling_;
};

TEST_F(ReplayScreens, OpensWithoutWaitingAndBeginsBeforeRun) {
  draw();
  EXPECT_TRUE(says("being opened"));
  ASSERT_TRUE(opened());
  EXPECT_NEAR(clock().from_s(), -1, 0.01);
  EXPECT_NEAR(clock().now_s(), -1, 0.2);
}

TEST_F(ReplayScreens, EveryKeyDoesWhatItSays) {
  ASSERT_TRUE(opened());
  ASSERT_TRUE(wait_until([&] {
    draw({}, 0.3);
    return clock().now_s() > 2;
  }));
  draw(press(kKeySpace));
  EXPECT_FALSE(clock().playing());
  const double here = clock().now_s();
  draw(press(kKeyRight));
  EXPECT_NEAR(clock().now_s(), here + 1, 1e-9);
  draw(press(kKeyLeft));
  EXPECT_NEAR(clock().now_s(), here, 1e-9);
  draw(press('.'));
  EXPECT_GT(clock().now_s(), here);
  EXPECT_LT(clock().now_s(), here + 0.07);
  draw(press(','));
  draw(press(','));
  EXPECT_LT(clock().now_s(), here);
  draw(press(kKeyHome));
  EXPECT_EQ(clock().now_s(), clock().from_s());
  draw(press(']'));
  const double event = clock().now_s();
  EXPECT_GT(event, clock().from_s());
  draw(press(']'));
  EXPECT_GT(clock().now_s(), event);
  draw(press('['));
  EXPECT_EQ(clock().now_s(), event);
  draw(press('-'));
  EXPECT_EQ(clock().speed(), 0.5);
  draw(press('='));
  draw(press('='));
  EXPECT_EQ(clock().speed(), 2);
  draw(press('L'));
  draw(press(kKeyRight));
  draw(press('L'));
  EXPECT_TRUE(clock().loop_b_s());
  draw(press(kKeyEnd));
  EXPECT_EQ(clock().now_s(), clock().to_s());
  EXPECT_EQ(draw(press(kKeyEscape)), ScreenName::kBack);
}

TEST_F(ReplayScreens, ThePointerScrubsTheTimeLine) {
  ASSERT_TRUE(opened());
  draw(press(kKeySpace));
  double y = 0;
  for (const DrawnText& t : texts_)
    if (t.text.ends_with(" N") && t.y > 0.6 * high_) y = std::max(y, t.y - 20);
  ASSERT_GT(y, 0);
  draw({pointer(InputEvent::Kind::kMouseMove, 700, y)});
  draw({pointer(InputEvent::Kind::kButtonDown, 700, y)});
  draw();
  const double middle = clock().now_s();
  EXPECT_GT(middle, 0.3 * clock().to_s());
  EXPECT_LT(middle, 0.7 * clock().to_s());
  draw({pointer(InputEvent::Kind::kMouseMove, 1000, y)});
  draw();
  EXPECT_GT(clock().now_s(), middle + 1) << "held, it follows";
  draw({pointer(InputEvent::Kind::kButtonUp, 1000, y)});
}

TEST_F(ReplayScreens, TheExpertComesBesideAndBothRunOnOneClock) {
  ASSERT_TRUE(opened());
  draw(press('S'));
  EXPECT_TRUE(screen_->beside());
  ASSERT_TRUE(wait_until([&] { return screen_->second_stage(*model_, wide_, high_).has_value(); }));
  draw();
  EXPECT_TRUE(says("Expert"));
  const auto left = screen_->stage(*model_, wide_, high_), right = screen_->second_stage(*model_, wide_, high_);
  ASSERT_TRUE(left && right);
  EXPECT_LT(left->x + left->width, right->x + 1);
  EXPECT_EQ(left->height, right->height);
  EXPECT_NE(left->view.X_TI.p, right->view.X_TI.p);
  draw(press('S'));
  EXPECT_FALSE(screen_->second_stage(*model_, wide_, high_));
}

TEST_F(ReplayScreens, BeginsWhereTheDebriefSays) {
  model_->replay_at_s = 6.0;
  ASSERT_TRUE(opened());
  EXPECT_FALSE(model_->replay_at_s) << "once";
  EXPECT_GT(clock().now_s(), 0.5);
  EXPECT_LT(clock().now_s(), 6);
}

TEST_F(ReplayScreens, WithoutARecordingItSaysSo) {
  model_->replay_file.clear();
  draw();
  EXPECT_TRUE(says("There is no recording"));
  EXPECT_FALSE(screen_->stage(*model_, wide_, high_));
  EXPECT_EQ(draw(press(kKeyEscape)), ScreenName::kBack);
}

TEST_F(ReplayScreens, SettledItIsReadyForAPicture) {
  screen_->settle(*model_, 60);
  draw();
  EXPECT_TRUE(says("Pause")) << "still being opened";
  EXPECT_GT(clock().to_s(), 3);
}

TEST_F(ReplayScreens, WhatIsNoRecordingIsSaid) {
  model_->replay_file = bench_.folder.write("text.trec", "nothing of the kind");
  EXPECT_TRUE(wait_until([&] { return says("text.trec"); }));
}

TEST_F(ReplayScreens, NothingClipsOrScrollsAtAnyScale) {
  for (const double scale : {1.0, 1.5, 2.0}) {
    scale_ = scale;
    ASSERT_TRUE(wait_until([&] { return clock().to_s() > 3 && says("Pause"); }));
    if (scale == 1.0) draw(press('S'));
    ASSERT_TRUE(wait_until([&] { return screen_->second_stage(*model_, wide_, high_).has_value(); }));
    draw();
    EXPECT_TRUE(scrolling_.empty()) << "scale " << scale;
    for (const DrawnText& t : texts_) {
      EXPECT_LE(t.y + t.height, high_ + 1) << t.text << " at scale " << scale;
      EXPECT_LE(t.x + t.width, wide_ + 1) << t.text << " at scale " << scale;
      EXPECT_FALSE(t.shortened && scale == 1.0) << t.text;
    }
  }
}

using ReplayInLoop = LoopBench;

TEST_F(ReplayInLoop, DrawsBothPictures) {
  width_ = 800;
  height_ = 450;
  model_->replay_file = record_short(bench_.folder / "own.trec", "novice");
  model_->replay_beside = model_->replay_file;
  model_->replay_at_s = 8;
  loop_->go(ScreenName::kReplay);
  for (int i = 0; i < 300 && !sees("Pause"); ++i) {
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  tap(kKeySpace);
  for (int i = 0; i < 40; ++i) frame();
  const Image image = loop_->picture();
  const auto bright = [&](int x0, int x1) {
    double sum = 0;
    for (int y = 60; y < 180; ++y)
      for (int x = x0; x < x1; ++x) sum += image.pixel(x, y)[0];
    return sum / (120.0 * (x1 - x0));
  };
  EXPECT_GT(bright(100, 300), 25);
  EXPECT_NEAR(bright(100, 300), bright(501, 701), 6) << "the same run twice";
}

TEST_F(ReplayInLoop, TheExpertPlaysBehindTheStartPageAndIsLabelled) {
  width_ = 1280;
  height_ = 400;
  const auto says = [&](const std::string& beginning) {
    return std::any_of(loop_->texts().begin(), loop_->texts().end(),
                       [&](const DrawnText& t) { return t.text.starts_with(beginning); });
  };
  for (int i = 0; i < 20; ++i) frame();
  EXPECT_FALSE(says("Replay of the expert")) << "the first second is the still scene's";
  for (int i = 0; i < 600 && !says("Replay of the expert"); ++i) {
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(says("Replay of the expert"));
  EXPECT_FALSE(says("Still scene"));
}

}  // namespace
}  // namespace trocar::testing_support::replay_screen_test
