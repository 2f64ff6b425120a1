#include "app/window/glfw/window_events.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "app/window/glfw/window.h"
#include "app/window/input/key_map.h"
#include "haptics/input_error.h"

namespace trocar::window_events_test {
namespace {

TEST(KeyOfGlfw, LettersAndDigitsAreTheirAsciiCode) {
  EXPECT_EQ(key_of_glfw(GLFW_KEY_A), 'A');
  EXPECT_EQ(key_of_glfw(GLFW_KEY_Z), 'Z');
  EXPECT_EQ(key_of_glfw(GLFW_KEY_0), '0');
  EXPECT_EQ(key_of_glfw(GLFW_KEY_SPACE), kKeySpace);
}

TEST(KeyOfGlfw, NamedKeysHaveNames) {
  EXPECT_EQ(key_name(key_of_glfw(GLFW_KEY_F1)), "F1");
  EXPECT_EQ(key_name(key_of_glfw(GLFW_KEY_F12)), "F12");
  EXPECT_EQ(key_name(key_of_glfw(GLFW_KEY_PAGE_UP)), key_name(kKeyPageUp));
  EXPECT_EQ(key_of_glfw(GLFW_KEY_KP_ENTER), kKeyEnter);
  EXPECT_EQ(key_of_glfw(GLFW_KEY_RIGHT_SHIFT), kKeyShift);
  EXPECT_EQ(key_of_glfw(GLFW_KEY_PAUSE), kKeyUnknown);
}

TEST(KeyOfGlfw, EveryDefaultKeyCanBePressed) {
  std::set<std::int32_t> reachable;
  for (int key = 0; key <= GLFW_KEY_LAST; ++key) reachable.insert(key_of_glfw(key));
  const KeyMap map;
  for (const ActionName& action : action_names())
    EXPECT_TRUE(reachable.contains(map.key_of(action.action))) << action.name;
}

TEST(WindowTest, WithoutADisplayItSaysWhatIsMissingAndWhatWorks) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  try {
    const Window window({});
    FAIL() << "a window without a display";
  } catch (const EnvironmentError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("DISPLAY"), std::string::npos) << what;
    EXPECT_NE(what.find("trocar demo --headless"), std::string::npos) << what;
  }
}

TEST(WindowTest, ADisplayThatDoesNotAnswerIsNamed) {
  setenv("DISPLAY", ":6543", 1);
  unsetenv("WAYLAND_DISPLAY");
  try {
    const Window window({});
    FAIL() << "a window on a display that is none";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find(":6543"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trocar::window_events_test
