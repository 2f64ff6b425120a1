#include "app/window/input/space_mouse.h"

#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace trocar::space_mouse_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(SpaceMouseReport, TranslationInThePersonsAxes) {
  SpaceMouseState state;
  // 350 to the right, -175 (away from the person), 70 down
  EXPECT_TRUE(apply_space_mouse_report(Bytes{1, 0x5e, 0x01, 0x51, 0xff, 0x46, 0x00}, state));
  EXPECT_DOUBLE_EQ(state.axis[0], 1);
  EXPECT_DOUBLE_EQ(state.axis[1], -0.2);
  EXPECT_DOUBLE_EQ(state.axis[2], -0.5);
  EXPECT_EQ(state.axis[3], 0);
}

TEST(SpaceMouseReport, RotationInAReportOfItsOwnOrBehindTheTranslation) {
  SpaceMouseState old, fresh;
  EXPECT_TRUE(apply_space_mouse_report(Bytes{2, 0x23, 0x00, 0x00, 0x00, 0xdd, 0xff}, old));
  EXPECT_DOUBLE_EQ(old.axis[3], 0.1);
  EXPECT_DOUBLE_EQ(old.axis[4], 0.1);
  EXPECT_DOUBLE_EQ(old.axis[5], 0);
  EXPECT_TRUE(apply_space_mouse_report(Bytes{1, 0, 0, 0, 0, 0, 0, 0x23, 0x00, 0x00, 0x00, 0xdd, 0xff}, fresh));
  EXPECT_EQ(old, fresh);
}

TEST(SpaceMouseReport, ButtonsAndLimits) {
  SpaceMouseState state;
  EXPECT_TRUE(apply_space_mouse_report(Bytes{3, 0x02, 0x01}, state));
  EXPECT_EQ(state.buttons, 0x102u);
  EXPECT_TRUE(apply_space_mouse_report(Bytes{3, 0x00}, state));
  EXPECT_EQ(state.buttons, 0u);
  EXPECT_TRUE(apply_space_mouse_report(Bytes{1, 0xff, 0x7f, 0x00, 0x80, 0, 0}, state));
  EXPECT_EQ(state.axis[0], 1);
  EXPECT_EQ(state.axis[2], -1);
}

TEST(SpaceMouseReport, WhatIsNotUnderstoodChangesNothing) {
  SpaceMouseState state;
  state.axis[0] = 0.5;
  const SpaceMouseState before = state;
  for (const Bytes& bytes : {Bytes{}, Bytes{1}, Bytes{1, 1, 1, 1, 1, 1}, Bytes{2, 1}, Bytes{9, 1, 2, 3, 4, 5, 6}})
    EXPECT_FALSE(apply_space_mouse_report(bytes, state));
  EXPECT_EQ(state, before);
}

TEST(SpaceMouseDevices, AreToldFromMiceAndKeyboards) {
  EXPECT_TRUE(is_space_mouse(0x256f, 0xc635, 1, 8));
  EXPECT_TRUE(is_space_mouse(0x046d, 0xc626, 1, 8));
  EXPECT_TRUE(is_space_mouse(0x046d, 0xc626, 0, 0));   // a library that does not tell what it is
  EXPECT_FALSE(is_space_mouse(0x046d, 0xc52b, 0, 0));  // Logitech's receiver for mice
  EXPECT_FALSE(is_space_mouse(0x256f, 0xc652, 1, 6));  // keyboard part of a wireless receiver
  EXPECT_FALSE(is_space_mouse(0x1234, 0xc626, 1, 8));
}

/// Plugged in and pulled out by the test.
class FakeSource final : public SpaceMouseSource {
 public:
  explicit FakeSource(std::atomic<bool>& plugged) : plugged_(plugged) {}
  bool open() override { return plugged_; }
  int read(std::span<std::uint8_t> report, int) override {
    if (!plugged_) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Bytes bytes{1, 0x5e, 0x01, 0, 0, 0, 0};
    std::memcpy(report.data(), bytes.data(), bytes.size());
    return static_cast<int>(bytes.size());
  }
  void close() override {}

 private:
  std::atomic<bool>& plugged_;
};

/// Waits until it is so; a test that never gets there ends by ctest's limit.
void until(const std::function<bool()>& so) {
  while (!so()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST(SpaceMouse, ComesAndGoes) {
  std::atomic<bool> plugged = false;
  SpaceMouse space_mouse(std::make_unique<FakeSource>(plugged), 5);
  EXPECT_FALSE(space_mouse.newest());
  EXPECT_FALSE(space_mouse.present());
  plugged = true;
  until([&] { return space_mouse.newest().has_value(); });
  EXPECT_TRUE(space_mouse.present());
  const auto event = space_mouse.newest();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, InputEvent::Kind::kSpaceMouse);
  EXPECT_EQ(event->axis[0], 1);
  plugged = false;
  until([&] { return !space_mouse.present(); });
  const auto rest = space_mouse.newest();
  ASSERT_TRUE(rest);  // it comes to rest, said once
  EXPECT_EQ(rest->axis[0], 0);
  EXPECT_FALSE(space_mouse.newest());
  plugged = true;
  until([&] { return space_mouse.present(); });
}

TEST(SpaceMouse, WithoutDeviceOrLibraryIsSilent) {
  SpaceMouse space_mouse;
  EXPECT_NO_THROW(space_mouse.newest());
}

}  // namespace
}  // namespace trocar::space_mouse_test
