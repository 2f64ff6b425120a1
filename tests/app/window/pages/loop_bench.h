// The whole loop in memory for tests: a model, a context, keys as a person presses them.
#pragma once

#include "app/window/practice/practice_loop.h"
#include "tests/app/window/pages/practice_bench.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::testing_support {

class LoopBench : public HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (!IsSkipped()) open(bench_.options());
  }
  void TearDown() override {
    loop_.reset();
    model_.reset();
  }
  void open(const ModelOptions& options) {
    loop_.reset();
    model_ = bench_.model(options);
    loop_ = std::make_unique<PracticeLoop>(*model_, *context_, false);
  }
  bool frame(const std::vector<InputEvent>& events = {}) { return loop_->frame(width_, height_, 0.05, events); }
  bool tap(std::int32_t code) {
    const bool on = frame(press(code));
    return frame() && on;
  }
  /// Tabs until the text stands in the item with the focus' ring? The order is known to the test instead.
  void tab(int times) {
    for (int i = 0; i < times; ++i) tap(kKeyTab);
  }
  bool sees(const std::string& text) const {
    for (const DrawnText& t : loop_->texts())
      if (t.text == text) return true;
    return false;
  }

  PracticeBench bench_;
  int width_ = 640, height_ = 360;  // small: a software rasteriser draws every frame
  std::unique_ptr<PracticeModel> model_;
  std::unique_ptr<PracticeLoop> loop_;
};

}  // namespace trocar::testing_support
