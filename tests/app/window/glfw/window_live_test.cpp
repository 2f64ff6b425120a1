// The window on a display of its own: what real keys and a real pointer become, sizes, what is drawn.
#include <algorithm>
#include <cstdlib>

#include "app/picture/gl/frame_target.h"
#include "app/window/glfw/window.h"
#include "app/window/input/key_map.h"
#include "tests/support/x_display.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::window_live_test {
namespace {

using Kind = InputEvent::Kind;
using testing_support::comes_true;
using testing_support::XDisplay;

class WindowLive : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!XDisplay::missing().empty())
      GTEST_SKIP() << "NO WINDOW IS TESTED HERE: " << XDisplay::missing() << " is not installed";
    display_ = std::make_unique<XDisplay>(folder_.path());
    ASSERT_FALSE(display_->name().empty()) << "Xvfb gave no display";
    setenv("DISPLAY", display_->name().c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    window_ = std::make_unique<Window>(WindowOptions{"Trocar test", 640, 360, false, true});
    frame();
    ASSERT_TRUE(comes_true([this] { return !display_->window("Trocar test").empty(); }));
    display_->xdotool({"windowfocus", "--sync", display_->window("Trocar test")});
    frame();
  }
  void TearDown() override {
    window_.reset();
    display_.reset();
  }
  void frame() {
    for (const InputEvent& event : window_->poll()) events_.push_back(event);
    window_->present();
  }
  bool got(const std::function<bool(const InputEvent&)>& wanted) {
    return comes_true([&] {
      frame();
      return std::any_of(events_.begin(), events_.end(), wanted);
    });
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<XDisplay> display_;
  std::unique_ptr<Window> window_;
  std::vector<InputEvent> events_;
};

TEST_F(WindowLive, HasACoreContextThroughEgl) {
  EXPECT_EQ(window_->info().platform, "window");
  EXPECT_NE(window_->info().renderer, "unknown");
  EXPECT_GE(window_->info().version[0], '3');
  EXPECT_EQ(window_->width(), 640);
  EXPECT_EQ(window_->height(), 360);
  EXPECT_FALSE(window_->close_asked());
  EXPECT_TRUE(window_->native());
}

TEST_F(WindowLive, KeysComeDownAndUpAndAsText) {
  display_->xdotool({"key", "a"});
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kKeyDown && e.key == 'A' && !e.repeat; }));
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kKeyUp && e.key == 'A'; }));
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kText && e.character == 'a'; }));
}

TEST_F(WindowLive, ModifiersAreTold) {
  display_->xdotool({"key", "shift+F5"});
  EXPECT_TRUE(
      got([](const InputEvent& e) { return e.kind == Kind::kKeyDown && e.key == kKeyF5 && e.shift && !e.control; }));
  display_->xdotool({"key", "ctrl+Left"});
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kKeyDown && e.key == kKeyLeft && e.control; }));
}

TEST_F(WindowLive, ThePointerIsInPixelsYDown) {
  display_->xdotool({"mousemove", "--window", display_->window("Trocar test"), "123", "45"});
  EXPECT_TRUE(got([](const InputEvent& e) {
    return e.kind == Kind::kMouseMove && std::abs(e.x - 123) < 1 && std::abs(e.y - 45) < 1;
  }));
}

TEST_F(WindowLive, ButtonsAndWheel) {
  display_->xdotool({"mousemove", "--window", display_->window("Trocar test"), "100", "100"});
  for (const auto& [number, button] : {std::pair{"1", MouseButton::kLeft}, std::pair{"2", MouseButton::kMiddle},
                                       std::pair{"3", MouseButton::kRight}}) {
    display_->xdotool({"click", number});
    EXPECT_TRUE(got([button = button](const InputEvent& e) {
      return e.kind == Kind::kButtonDown && e.button == button;
    })) << number;
    EXPECT_TRUE(got([button = button](const InputEvent& e) { return e.kind == Kind::kButtonUp && e.button == button; }))
        << number;
  }
  display_->xdotool({"click", "4"});
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kWheel && e.wheel > 0; })) << "away from the person";
  display_->xdotool({"click", "5"});
  EXPECT_TRUE(got([](const InputEvent& e) { return e.kind == Kind::kWheel && e.wheel < 0; }));
}

TEST_F(WindowLive, FollowsItsSize) {
  display_->xdotool({"windowsize", "--sync", display_->window("Trocar test"), "800", "500"});
  EXPECT_TRUE(comes_true([this] {
    frame();
    return window_->width() == 800 && window_->height() == 500;
  }));
}

TEST_F(WindowLive, DrawsThroughAFrameTarget) {
  FrameTarget target(*window_, true);
  target.begin(window_->width(), window_->height());
  const Image image = target.read();
  EXPECT_EQ(image.width, 640);
  EXPECT_EQ(*std::max_element(image.rgb.begin(), image.rgb.end()), 0) << "cleared to black";
  frame();
}

TEST_F(WindowLive, TakesTitleAndScreenAndComesBack) {
  window_->set_title("Trocar other");
  EXPECT_TRUE(comes_true([this] {
    frame();
    return !display_->window("Trocar other").empty();
  }));
  window_->set_fullscreen(true);
  for (int i = 0; i < 5; ++i) frame();
  window_->set_fullscreen(true);
  window_->set_fullscreen(false);
  for (int i = 0; i < 5; ++i) frame();
  EXPECT_FALSE(window_->close_asked());
}

TEST_F(WindowLive, MakesItselfCurrentAgain) {
  EXPECT_NO_THROW(window_->make_current());
  EXPECT_NO_THROW(window_->make_current());
}

}  // namespace
}  // namespace trocar::window_live_test
