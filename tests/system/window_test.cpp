// `trocar practice` as a person meets it: a real window on a display of its own, real keys; and what it does without a display.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test {
namespace {

namespace fs = std::filesystem;

bool on_path(const std::string& program) { return fs::exists(fs::path("/usr/bin") / program); }

/// Asks until it is so; gives up after a minute and a half, which is a failure of the caller's expectation.
bool comes_true(const std::function<bool()>& so) {
  for (int i = 0; i < 900; ++i) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

class WindowOnADisplay : public SystemTest {
 protected:
  void SetUp() override {
    for (const char* needed : {"Xvfb", "xdotool"})
      if (!on_path(needed)) GTEST_SKIP() << "NO WINDOW IS TESTED HERE: " << needed << " is not installed";
    const fs::path server = folder_ / "server";
    fs::create_directories(server);
    Launch launch{{"-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp"}, server, {}};
    launch.program = "/usr/bin/Xvfb";
    server_ = std::make_unique<RunningProgram>(launch);
    ASSERT_TRUE(comes_true([&] { return !display_number(server).empty(); })) << "Xvfb gave no display";
    display_ = ":" + display_number(server);
  }
  void TearDown() override {
    if (program_ && program_->running()) program_->kill_at_once();
    if (server_ && server_->running()) server_->kill_at_once();
  }
  static std::string display_number(const fs::path& server) {
    for (const auto& entry : fs::directory_iterator(server / ".streams"))
      if (entry.path().extension() == ".out") {
        std::string text = file_bytes(entry.path());
        if (!text.ends_with('\n')) return "";
        text.pop_back();
        return text;
      }
    return "";
  }
  Launch on_display(const std::vector<std::string>& arguments) const {
    return {arguments, folder_.path(), {{"DISPLAY", display_}, {"WAYLAND_DISPLAY", ""}, {"XDG_DATA_HOME", (folder_ / "data").string()},
            {"XDG_CONFIG_HOME", (folder_ / "config").string()}, {"XDG_CACHE_HOME", (folder_ / "cache").string()},
            {"XDG_PICTURES_DIR", (folder_ / "pictures").string()}, {"LANG", "C"}}};
  }
  Outcome xdotool(const std::vector<std::string>& arguments) const {
    Launch launch = on_display(arguments);
    launch.program = "/usr/bin/xdotool";
    return run_program(launch);
  }
  void open_window(const std::vector<std::string>& arguments) {
    program_ = std::make_unique<RunningProgram>(on_display(arguments));
    ASSERT_TRUE(comes_true([&] {
      return !program_->running() || xdotool({"search", "--onlyvisible", "--name", "^Trocar$"}).exit_code == 0;
    }));
    ASSERT_TRUE(program_->running()) << program_->wait().err;
    std::string id = xdotool({"search", "--onlyvisible", "--name", "^Trocar$"}).out;
    id = id.substr(0, id.find('\n'));
    xdotool({"windowfocus", "--sync", id});  // there is no window manager to do it
  }
  int pictures() const {
    const fs::path folder = folder_ / "pictures";
    if (!fs::exists(folder)) return 0;
    return static_cast<int>(std::count_if(fs::directory_iterator(folder), fs::directory_iterator(),
                                          [](const auto& entry) { return entry.path().extension() == ".png"; }));
  }
  /// Presses a key, and waits until a picture taken afterwards shows that frames have gone by.
  void key(const std::string& name) {
    xdotool({"key", name});
    const int before = pictures();
    xdotool({"key", "F12"});
    ASSERT_TRUE(comes_true([&] { return pictures() > before || !program_->running(); })) << "after " << name;
  }

  std::unique_ptr<RunningProgram> server_, program_;
  std::string display_;
};

TEST_F(WindowOnADisplay, OpensTakesRealKeysAndQuitsByItsMenu) {
  open_window({"practice", "--db", ":memory:", "--width", "640", "--height", "360"});
  if (HasFatalFailure()) return;
  key("F1");
  EXPECT_TRUE(program_->running());
  key("F1");
  key("Escape");
  for (int i = 0; i < 5; ++i) key("Tab");
  xdotool({"key", "Return"});
  ASSERT_TRUE(comes_true([&] { return !program_->running(); })) << "the menu's last item is Quit";
  const Outcome outcome = program_->wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GE(pictures(), 8);
}

TEST_F(WindowOnADisplay, PointerAndResizingDoNotBreakIt) {
  open_window({"practice", "--db", ":memory:", "--width", "640", "--height", "360"});
  if (HasFatalFailure()) return;
  std::string id = xdotool({"search", "--onlyvisible", "--name", "^Trocar$"}).out;
  id = id.substr(0, id.find('\n'));
  for (const auto& [width, height] : {std::pair{"200", "100"}, std::pair{"1280", "720"}, std::pair{"400", "700"}}) {
    xdotool({"windowsize", "--sync", id, width, height});
    xdotool({"mousemove", "100", "60"});
    key("F1");
    EXPECT_TRUE(program_->running()) << width << " x " << height;
    key("F1");
  }
}

using Practice = SystemTest;

TEST_F(Practice, WithoutADisplayItEndsWith3AndSaysWhatWorks) {
  const Outcome outcome = run_program({{"practice", "--db", ":memory:"}, folder_.path(), {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""},
                                       {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("DISPLAY"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("trocar demo --headless"), std::string::npos) << outcome.err;
}

TEST_F(Practice, WritesPicturesOfItsScreensWithoutADisplay) {
  const Outcome outcome = run_program({{"practice", "--screens", "pages", "--db", ":memory:", "--width", "640", "--height", "360"}, folder_.path(),
                                       {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* page : {"start", "settings", "help", "menu"}) EXPECT_TRUE(fs::exists(folder_ / "pages" / (std::string(page) + ".png"))) << page;
}

TEST_F(Practice, RefusesWhatIsNoneBeforeAWindowOpens) {
  for (const Words& wrong : {Words{"E99"}, Words{"--level", "L9"}, Words{"--trainee", "a b"}, Words{"--language", "xx"}, Words{"--scale", "3"},
                             Words{"--input", "joystick"}}) {
    Words arguments{"practice", "--db", ":memory:"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const Outcome outcome = run_program({arguments, folder_.path(), {{"DISPLAY", ""}, {"XDG_CONFIG_HOME", (folder_ / "config").string()}}});
    EXPECT_EQ(outcome.exit_code, 2) << wrong.front() << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace trocar::test
