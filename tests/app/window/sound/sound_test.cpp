// The player with a device that plays to nobody, and without any.
#include "app/window/sound/sound.h"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace trocar::sound_test {
namespace {

/// The library reads this when the first device is asked for: a process of its own a case.
void drivers(const char* names) {
  setenv("ALSOFT_DRIVERS", names, 1);
  setenv("ALSOFT_LOGLEVEL", "0", 1);
}

void use(Sound& sound) {
  for (int i = 0; i < kTones; ++i) sound.play(static_cast<Tone>(i));
  for (const double level : {0.0, 0.5, 2.0, 0.0, -1.0}) {
    sound.hold_force(level);
    sound.hold_cautery(level);
  }
}

TEST(Sound, NotWantedIsSilentAndSaysNothing) {
  Sound sound(false);
  use(sound);
  EXPECT_FALSE(sound.audible());
  EXPECT_EQ(sound.refusal(), "");
}

TEST(Sound, WithoutADeviceIsSilentAndSaysWhy) {
  drivers("none-of-these");
  Sound sound(true);
  use(sound);
  EXPECT_FALSE(sound.audible());
  EXPECT_NE(sound.refusal().find("no output device"), std::string::npos);
}

TEST(Sound, WithoutCardOrServerTheLibraryIsNotEvenAsked) {
  if (std::filesystem::exists("/dev/snd")) GTEST_SKIP() << "this machine has a card";
  for (const char* name : {"ALSOFT_DRIVERS", "PULSE_SERVER", "XDG_RUNTIME_DIR"}) unsetenv(name);
  testing::internal::CaptureStderr();
  Sound sound(true);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(sound.audible());
  EXPECT_NE(sound.refusal(), "");
}

// A suite, and so a process, of its own: OpenAL reads once which drivers it may use.
TEST(SoundOnADevice, PlaysAndCanBeMadeAgain) {
  drivers("null");
  for (int i = 0; i < 3; ++i) {
    Sound sound(true);
    EXPECT_TRUE(sound.audible()) << sound.refusal();
    EXPECT_EQ(sound.refusal(), "");
    use(sound);
  }
}

}  // namespace
}  // namespace trocar::sound_test
