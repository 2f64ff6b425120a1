// `trocar replay --video` and its relatives as functions: films of one run and of two, and what is refused before any
// work.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "app/cli/attempts/recording_command.h"
#include "app/picture/films/video_writer.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/support/headless_fixture.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::replay_film_test {
namespace {

using test::message_of;

class ReplayFilms : public testing_support::HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    context_.reset();  // films have a context of their own
    if (IsSkipped()) return;
    if (find_ffmpeg().empty()) GTEST_SKIP() << "NO FILM IS TESTED HERE: ffmpeg is not installed";
    ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    options_.width = 320;
    options_.height = 240;
    options_.fps = 1;
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  int run() {
    out_.str("");
    err_.str("");
    return replay_command(options_, out_, err_);
  }
  test::TemporaryFolder folder_;
  RecordingOptions options_;
  const std::string path_ = std::getenv("PATH");
  std::ostringstream out_, err_;
};

TEST_F(ReplayFilms, AFilmIsVerifiedInTheSameBreath) {
  options_.subject = record_short(folder_ / "a.trec");
  options_.video = folder_ / "a.mkv";
  options_.verify = true;
  EXPECT_EQ(run(), 0) << err_.str();
  EXPECT_CONTAINS(out_.str(), "verified: every tick");
  EXPECT_CONTAINS(err_.str(), "a.mkv");
  EXPECT_GT(std::filesystem::file_size(options_.video), 2000u);
  EXPECT_CONTAINS(message_of<InputError>([&] { run(); }), "never overwritten");
}

TEST_F(ReplayFilms, TheExpertBesideIsMadeOnceAndNumberedPicturesAreTheWayOut) {
  options_.subject = record_short(folder_ / "a.trec", "novice");
  options_.beside = "expert";
  options_.frames = folder_ / "frames";
  options_.fps = 0.1;
  options_.width = 720;
  options_.height = 400;
  EXPECT_EQ(run(), 0) << err_.str();
  EXPECT_TRUE(std::filesystem::exists(options_.frames / "frame_00001.png"));
  EXPECT_FALSE(std::filesystem::is_empty(folder_ / "cache" / "trocar"));
  options_.beside = options_.subject;
  EXPECT_EQ(run(), 0) << "another recording as well";
}

TEST_F(ReplayFilms, WhatMakesNoSenseIsRefusedBeforeAnyWork) {
  options_.subject = record_short(folder_ / "a.trec");
  options_.beside = "expert";
  EXPECT_CONTAINS(message_of<InputError>([&] { run(); }), "--video FILE");
  options_.beside.clear();
  options_.video = folder_ / "a.mp4";
  options_.frames = folder_ / "frames";
  EXPECT_CONTAINS(message_of<InputError>([&] { run(); }), "one of the two");
  options_.frames.clear();
  options_.video = folder_ / "a.gif";
  EXPECT_CONTAINS(message_of<InputError>([&] { run(); }), ".mp4");
  ::setenv("PATH", folder_.path().c_str(), 1);
  options_.video = folder_ / "a.mp4";
  EXPECT_CONTAINS(message_of<EnvironmentError>([&] { run(); }), "--frames DIR");
}

}  // namespace
}  // namespace trocar::replay_film_test
