// `trocar practice` as a person meets it: a real window on a display of its own, real keys; and what it does without a
// display.
#include <algorithm>

#include "tests/support/x_display.h"
#include "tests/system/system_fixture.h"

namespace trocar::test::window_test {
namespace {

namespace fs = std::filesystem;

using testing_support::comes_true;
using testing_support::XDisplay;

class WindowOnADisplay : public SystemTest {
 protected:
  void SetUp() override {
    if (!XDisplay::missing().empty())
      GTEST_SKIP() << "NO WINDOW IS TESTED HERE: " << XDisplay::missing() << " is not installed";
    display_ = std::make_unique<XDisplay>(folder_.path());
    ASSERT_FALSE(display_->name().empty()) << "Xvfb gave no display";
  }
  void TearDown() override {
    if (program_ && program_->running()) program_->kill_at_once();
  }
  Launch on_display(const std::vector<std::string>& arguments) const {
    return {arguments,
            folder_.path(),
            {{"DISPLAY", display_->name()},
             {"WAYLAND_DISPLAY", ""},
             {"XDG_DATA_HOME", (folder_ / "data").string()},
             {"XDG_CONFIG_HOME", (folder_ / "config").string()},
             {"XDG_CACHE_HOME", (folder_ / "cache").string()},
             {"XDG_PICTURES_DIR", (folder_ / "pictures").string()},
             {"LANG", "C"}}};
  }
  fs::path settings() const { return folder_ / "config/trocar/settings.toml"; }
  /// A station that has shown its tutorial.
  void open_window(const std::vector<std::string>& arguments) {
    folder_.write("config/trocar/settings.toml", "tutorial_seen = true\n");
    open_first(arguments);
  }
  void open_first(const std::vector<std::string>& arguments) {
    program_ = std::make_unique<RunningProgram>(on_display(arguments));
    ASSERT_TRUE(comes_true([&] { return !program_->running() || !display_->window("Trocar").empty(); }));
    ASSERT_TRUE(program_->running()) << program_->wait().err;
    display_->xdotool({"windowfocus", "--sync", display_->window("Trocar")});  // there is no window manager to do it
  }
  int pictures() const {
    const fs::path folder = folder_ / "pictures";
    if (!fs::exists(folder)) return 0;
    return static_cast<int>(std::count_if(fs::directory_iterator(folder), fs::directory_iterator(),
                                          [](const auto& entry) { return entry.path().extension() == ".png"; }));
  }
  /// Presses a key, and waits until a picture taken afterwards shows that frames have gone by.
  void key(const std::string& name) {
    display_->xdotool({"key", name});
    const int before = pictures();
    display_->xdotool({"key", "F12"});
    ASSERT_TRUE(comes_true([&] { return pictures() > before || !program_->running(); })) << "after " << name;
  }

  std::unique_ptr<XDisplay> display_;
  std::unique_ptr<RunningProgram> program_;
};

TEST_F(WindowOnADisplay, OpensTakesRealKeysAndQuitsByItsMenu) {
  open_window({"practice", "--db", ":memory:", "--width", "640", "--height", "360"});
  if (HasFatalFailure()) return;
  key("F1");
  EXPECT_TRUE(program_->running());
  key("F1");
  key("Escape");
  for (int i = 0; i < 5; ++i) key("Tab");
  display_->xdotool({"key", "Return"});
  ASSERT_TRUE(comes_true([&] { return !program_->running(); })) << "the menu's last item is Quit";
  const Outcome outcome = program_->wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GE(pictures(), 8);
}

TEST_F(WindowOnADisplay, ItsFirstStartTeachesAndEscSkipsThat) {
  open_first({"practice", "--db", ":memory:", "--width", "640", "--height", "360"});
  if (HasFatalFailure()) return;
  ASSERT_TRUE(comes_true([&] { return fs::exists(settings()); })) << "the tutorial has begun";
  key("F12");
  key("Escape");
  key("Escape");
  for (int i = 0; i < 5; ++i) key("Tab");
  display_->xdotool({"key", "Return"});
  ASSERT_TRUE(comes_true([&] { return !program_->running(); })) << "the start page's menu ends with Quit";
}

TEST_F(WindowOnADisplay, PointerAndResizingDoNotBreakIt) {
  open_window({"practice", "--db", ":memory:", "--width", "640", "--height", "360"});
  if (HasFatalFailure()) return;
  const std::string id = display_->window("Trocar");
  for (const auto& [width, height] : {std::pair{"200", "100"}, std::pair{"1280", "720"}, std::pair{"400", "700"}}) {
    display_->xdotool({"windowsize", "--sync", id, width, height});
    display_->xdotool({"mousemove", "100", "60"});
    key("F1");
    EXPECT_TRUE(program_->running()) << width << " x " << height;
    key("F1");
  }
}

using Practice = SystemTest;

TEST_F(Practice, WithoutADisplayItEndsWith3AndSaysWhatWorks) {
  const Outcome outcome =
      run_program({{"practice", "--db", ":memory:"},
                   folder_.path(),
                   {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("DISPLAY"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("trocar demo --headless"), std::string::npos) << outcome.err;
}

TEST_F(Practice, WritesPicturesOfItsScreensWithoutADisplay) {
  const Outcome outcome =
      run_program({{"practice", "--screens", "pages", "--db", ":memory:", "--width", "640", "--height", "360"},
                   folder_.path(),
                   {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* page : {"start", "curriculum", "briefing", "settings", "notch", "help", "help-measures", "menu",
                           "run", "device", "pause", "debrief", "progress", "replay"})
    EXPECT_TRUE(fs::exists(folder_ / "pages" / (std::string(page) + ".png"))) << page;
}

TEST_F(Practice, RefusesWhatIsNoneBeforeAWindowOpens) {
  for (const Translator& wrong :
       {Translator{"E99"}, Translator{"--level", "L9"}, Translator{"--trainee", "a b"}, Translator{"--language", "xx"},
        Translator{"--scale", "3"}, Translator{"--input", "joystick"}}) {
    Translator arguments{"practice", "--db", ":memory:"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const Outcome outcome =
        run_program({arguments, folder_.path(), {{"DISPLAY", ""}, {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
    EXPECT_EQ(outcome.exit_code, 2) << wrong.front() << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace trocar::test::window_test
