// F2 and F5 during a run: force bars and guidance go and come, and what the level does not give is said and not given.
#include "app/window/run/run_screen.h"

#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/pages/loop_bench.h"

namespace trocar::testing_support::run_keys_test {
namespace {

class RunKeys : public LoopBench {
 protected:
  int pens() {
    int count = 0;
    const auto stage = screen_.stage(*model_, width_, height_);
    if (!stage) return -1;
    for (const SceneObject& object : stage->view.objects) count += object.shape == SceneObject::Shape::kPen ? 1 : 0;
    return count;
  }
  int all_pens() const { return model_->exercise().layout.count; }
  /// px of the limits' marks in the column; warnings stand over the picture.
  int limit_px() {
    frame();
    const Image image = loop_->picture();
    int count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 3 * image.width / 4; x < image.width; ++x) {
        const std::uint8_t* p = image.pixel(x, y);
        count += p[0] == 225 && p[1] == 104 && p[2] == 20 ? 1 : 0;
      }
    return count;
  }
  RunScreen screen_;
};

TEST_F(RunKeys, F5TakesTheWaitingPensAwayAndBringsThemBack) {
  EXPECT_EQ(pens(), -1) << "no attempt, no picture";
  ASSERT_EQ(model_->begin_attempt(), "");
  EXPECT_EQ(pens(), all_pens());
  screen_.handle(key(kKeyF5), *model_);
  EXPECT_LE(pens(), 1) << "only the lit one";
  InputEvent held = key(kKeyF5);
  held.repeat = true;
  screen_.handle(held, *model_);
  screen_.handle(key(kKeyF5, InputEvent::Kind::kKeyUp), *model_);
  EXPECT_LE(pens(), 1) << "a key that is held counts once";
  screen_.handle(key(kKeyF5), *model_);
  EXPECT_EQ(pens(), all_pens());
  EXPECT_EQ(model_->notice, "");
}

TEST_F(RunKeys, GuidanceThatTheLevelLacksIsRefusedInWords) {
  ModelOptions options = bench_.options();
  options.hand = "expert";  // a level that is locked for guests
  options.level = "L2";
  open(options);
  ASSERT_EQ(model_->begin_attempt(), "");
  EXPECT_LE(pens(), 1);
  screen_.handle(key(kKeyF5), *model_);
  EXPECT_EQ(model_->notice, "This level has no guidance.");
  EXPECT_LE(pens(), 1);
}

TEST_F(RunKeys, AKeyOfOnesOwnTakesItsPlace) {
  model_->settings().keys = {{"guidance", "G"}};
  model_->settings_changed();
  ASSERT_EQ(model_->begin_attempt(), "");
  ASSERT_EQ(pens(), all_pens());
  screen_.handle(key(kKeyF5), *model_);
  EXPECT_EQ(pens(), all_pens());
  screen_.handle(key('G'), *model_);
  EXPECT_LE(pens(), 1);
}

TEST_F(RunKeys, F2HidesTheForceBarsAndShowsThemAgain) {
  width_ = 1280;
  height_ = 720;
  model_->exercise_id = "surface-touch";
  ASSERT_EQ(model_->begin_attempt(), "");
  loop_->go(ScreenName::kRun);
  frame();
  const int shown = limit_px();
  EXPECT_GT(shown, 20);
  tap(kKeyF2);
  EXPECT_EQ(limit_px(), 0);
  tap(kKeyF2);
  EXPECT_NEAR(limit_px(), shown, 0.2 * shown);
}

}  // namespace
}  // namespace trocar::testing_support::run_keys_test
