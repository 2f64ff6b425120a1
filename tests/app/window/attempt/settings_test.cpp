#include "app/window/attempt/settings.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "haptics/input_error.h"

namespace trocar::settings_test {
namespace {

namespace fs = std::filesystem;

class SettingsFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& text) {
    fs::create_directories(file_.parent_path());
    std::ofstream(file_) << text;
    return file_;
  }
  static std::string bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  const fs::path folder_ = fs::temp_directory_path() / ("settings-" + std::to_string(::getpid()));
  const fs::path file_ = folder_ / "trocar" / "settings.toml";
};

TEST_F(SettingsFile, WhatIsSavedIsReadAgain) {
  Settings chosen;
  chosen.language = "de";
  chosen.scale = 1.5;
  chosen.left_handed = chosen.like_a_fulcrum = true;
  chosen.sensitivity = 0.75;
  chosen.sound = false;
  chosen.tutorial_seen = true;
  chosen.preset = "soft";
  chosen.scope = "30";
  chosen.input = "gamepad";
  chosen.keys = {{"coagulate", "F"}, {"say \"no\"", "Page up"}};
  save_settings(file_, chosen);
  const Settings read = load_settings(file_);
  EXPECT_EQ(read.note, "");
  EXPECT_EQ(read.language, "de");
  EXPECT_EQ(read.scale, 1.5);
  EXPECT_TRUE(read.left_handed && read.like_a_fulcrum && !read.sound && read.tutorial_seen);
  EXPECT_EQ(read.sensitivity, 0.75);
  EXPECT_EQ(read.preset, "soft");
  EXPECT_EQ(read.scope, "30");
  EXPECT_EQ(read.input, "gamepad");
  EXPECT_EQ(read.keys, chosen.keys);
}

TEST_F(SettingsFile, AMissingFileMeansDefaultsWithoutANote) {
  const Settings read = load_settings(file_);
  EXPECT_EQ(read.note, "");
  EXPECT_EQ(read.scale, 1);
  EXPECT_EQ(read.input, "auto");
  EXPECT_EQ(load_settings({}).note, "");
}

TEST_F(SettingsFile, ADamagedFileIsLeftAloneAndNamedWithItsPlace) {
  const std::string text = "version = 1\nscale = 7\n";
  const Settings read = load_settings(write(text));
  EXPECT_EQ(read.scale, 1);
  EXPECT_NE(read.note.find(file_.string() + ":2:"), std::string::npos) << read.note;
  EXPECT_EQ(read.note_line, 2);
  EXPECT_EQ(bytes(file_), text);
  for (const char* bad : {"scale = ", "presett = \"soft\"\n", "preset = \"best\"\n", "[keys]\npause = 3\n",
                          "sound = 1\n", "scope = \"45\"\n"}) {
    EXPECT_NE(load_settings(write(bad)).note, "") << bad;
  }
}

TEST_F(SettingsFile, ANewerFileIsNotRead) {
  const Settings read = load_settings(write("version = 99\nlanguage = \"fr\"\n"));
  EXPECT_EQ(read.language, "");
  EXPECT_NE(read.note.find("newer"), std::string::npos) << read.note;
}

TEST_F(SettingsFile, SavingOverAnUnreadableOneKeepsItAside) {
  const std::string damaged = "scale = = 2";
  write(damaged);
  Settings chosen;
  chosen.scale = 2;
  save_settings(file_, chosen);
  EXPECT_EQ(load_settings(file_).note, "");
  EXPECT_EQ(load_settings(file_).scale, 2);
  EXPECT_EQ(bytes(unread_settings(file_)), damaged);
}

TEST_F(SettingsFile, WhatCannotBeWrittenIsAnEnvironmentErrorAndLeavesTheOldFile) {
  Settings first;
  first.scale = 1.25;
  save_settings(file_, first);
  EXPECT_THROW(save_settings(file_ / "below-a-file" / "settings.toml", first), EnvironmentError);
  EXPECT_THROW(save_settings({}, first), EnvironmentError);
  EXPECT_EQ(load_settings(file_).scale, 1.25);
}

TEST_F(SettingsFile, ItsPlaceFollowsTheUsualFolders) {
  ::setenv("XDG_CONFIG_HOME", "/somewhere/config", 1);
  EXPECT_EQ(settings_file(), "/somewhere/config/trocar/settings.toml");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);  // to be ignored by its specification
  ::setenv("HOME", "/home/a", 1);
  EXPECT_EQ(settings_file(), "/home/a/.config/trocar/settings.toml");
  ::unsetenv("XDG_CONFIG_HOME");
  ::unsetenv("HOME");
  EXPECT_TRUE(settings_file().empty());
}

}  // namespace
}  // namespace trocar::settings_test
