// A Ui in memory for tests: frames drawn by a function, input by a script.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "app/picture/gl/frame_target.h"
#include "app/window/ui/ui.h"
#include "app/window/ui/ui_layer.h"
#include "tests/support/headless_fixture.h"

namespace trocar::testing_support {

inline InputEvent key(std::int32_t code, InputEvent::Kind kind = InputEvent::Kind::kKeyDown) {
  InputEvent event;
  event.kind = kind;
  event.key = code;
  return event;
}

/// Down and up within one frame.
inline std::vector<InputEvent> press(std::int32_t code, bool shift = false) {
  std::vector<InputEvent> events{key(code), key(code, InputEvent::Kind::kKeyUp)};
  for (InputEvent& event : events) event.shift = shift;
  return events;
}

inline InputEvent pointer(InputEvent::Kind kind, double x, double y) {
  InputEvent event;
  event.kind = kind;
  event.x = x;
  event.y = y;
  return event;
}

inline std::vector<InputEvent> typed(const std::string& ascii) {
  std::vector<InputEvent> events;
  for (const char c : ascii) {
    InputEvent event;
    event.kind = InputEvent::Kind::kText;
    event.character = static_cast<unsigned char>(c);
    events.push_back(event);
  }
  return events;
}

class UiBench : public HeadlessFixture {
 protected:
  using Draw = std::function<void(Ui&)>;

  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    target_ = std::make_unique<FrameTarget>(*context_, false);
    layer_ = std::make_unique<UiLayer>(*context_, 1);
  }
  void TearDown() override {
    layer_.reset();
    target_.reset();
  }

  void frame(const Draw& draw, const std::vector<InputEvent>& events = {}) {
    target_->begin(width_, height_);
    layer_->set_scale(scale_);
    layer_->begin(width_, height_, 0.02, events);
    Ui ui(words_, scale_, width_, height_);
    draw(ui);
    texts_ = ui.text_audit();
    scrolling_ = ui.scrolling();
    layer_->end();
  }

  const DrawnText* text(const std::string& said) const {
    for (const DrawnText& t : texts_)
      if (t.text == said) return &t;
    return nullptr;
  }

  Translator words_;
  double scale_ = 1;
  int width_ = 1280, height_ = 720;
  std::unique_ptr<FrameTarget> target_;
  std::unique_ptr<UiLayer> layer_;
  std::vector<DrawnText> texts_;
  std::vector<std::string> scrolling_;
};

}  // namespace trocar::testing_support
