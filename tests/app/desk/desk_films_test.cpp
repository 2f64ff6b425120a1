// Films of attempts: made once, in the background, for their owner; ended with the desk; gone with the recording.
#include "app/desk/desk_films.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "app/picture/films/video_writer.h"
#include "app/session/grading/recorded_result.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/records/attempt_store.h"

namespace trocar::desk_films_test {
namespace {

namespace fs = std::filesystem;
using review::FilmState;
using test::message_of;
using Stage = FilmState::Stage;

class DeskFilmsTest : public testing::Test {
 protected:
  DeskFilmsTest() : file_(folder_ / "desk.db") {
    Database database(file_);
    uuid_ = store(database, folder_ / "one.trec");
    fs::copy_file(folder_ / "one.trec", folder_ / "two.trec");
    other_ = store(database, folder_ / "two.trec");
    bare_ = store(database, {});
  }
  static std::string store(Database& database, const fs::path& recording, bool torn = false) {
    AttemptStart start;
    start.trainee = "T01";
    start.exercise_id = "surface-touch";
    start.exercise_version = "1";
    start.exercise_text = "id = \"surface-touch\"\n";
    start.level = "L1";
    start.hand = "expert";
    start.recording = recording;
    AttemptStore attempts(database);
    const AttemptId id = attempts.begin_attempt(start);
    AttemptResult result;
    result.grade.status = AttemptStatus::kAborted;
    if (torn) {
      std::ofstream(recording) << "torn";
      result.recording_sha256 = digest::of_bytes("torn");
    }
    if (!torn && !recording.empty())
      result = *regrade_file(fs::exists(recording) ? recording : record_short(recording));
    attempts.finish_attempt(id, result);
    return id.uuid;
  }
  std::unique_ptr<DeskFilms> films() {
    return std::make_unique<DeskFilms>(find_assets(), file_, [this] { return Database(file_); });
  }
  static FilmState ended(DeskFilms& films, const std::string& uuid) {
    while (films.state(uuid).stage == Stage::kMaking) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return films.state(uuid);
  }
  static mode_t mode_of(const fs::path& path) {
    struct stat found = {};
    return ::lstat(path.c_str(), &found) == 0 ? found.st_mode & 07777U : 0U;
  }
  fs::path kept() const { return folder_ / "desk.films"; }
  test::TemporaryFolder folder_;
  fs::path file_;
  std::string uuid_, other_, bare_;
};

TEST_F(DeskFilmsTest, IsMadeOnceHoweverOftenItIsAskedFor) {
  const auto desk = films();
  EXPECT_EQ(desk->state(uuid_).stage, Stage::kNone);
  desk->make(uuid_);
  desk->make(uuid_);
  EXPECT_EQ(desk->state(uuid_).stage, Stage::kMaking);
  EXPECT_NE(message_of<InputError>([&] { desk->make(other_); }).find("one is made at a time"), std::string::npos);
  const FilmState film = ended(*desk, uuid_);
  ASSERT_EQ(film.stage, Stage::kReady) << film.words;
  EXPECT_EQ(film.bytes, fs::file_size(kept() / (uuid_ + ".mp4")));
  EXPECT_EQ(mode_of(kept()), 0700U);
  EXPECT_EQ(mode_of(kept() / (uuid_ + ".mp4")), 0600U);
  EXPECT_EQ(desk->part(uuid_, 4, 4), "ftyp") << "an MP4";
  EXPECT_EQ(desk->part(uuid_, film.bytes - 3, 100).size(), 3u);
  EXPECT_NE(message_of<InputError>([&] { desk->part(uuid_, film.bytes, 1); }), "");
  const auto made = fs::last_write_time(kept() / (uuid_ + ".mp4"));
  desk->make(uuid_);
  EXPECT_EQ(desk->state(uuid_).stage, Stage::kReady);
  EXPECT_EQ(fs::last_write_time(kept() / (uuid_ + ".mp4")), made) << "it is there";
}

TEST_F(DeskFilmsTest, TheEndOfTheDeskEndsItAndNothingStays) {
  {
    const auto desk = films();
    desk->make(uuid_);
  }
  EXPECT_TRUE(fs::is_empty(kept()));
}

TEST_F(DeskFilmsTest, WhatCannotBeFilmedIsNamed) {
  const auto desk = films();
  EXPECT_NE(message_of<InputError>([&] { desk->make(bare_); }).find("no recording"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { desk->make("0000-none"); }), "");
  EXPECT_NE(message_of<InputError>([&] { desk->make("latest"); }).find("there is none"), std::string::npos)
      << "whole UUIDs only";
  EXPECT_NE(message_of<InputError>([&] { desk->part(uuid_, 0, 1); }), "");
  std::string torn;
  {
    Database database(file_);
    torn = store(database, folder_ / "three.trec", true);
  }
  desk->make(torn);
  const FilmState failed = ended(*desk, torn);
  EXPECT_EQ(failed.stage, Stage::kFailed);
  EXPECT_NE(failed.words.find("three.trec"), std::string::npos) << failed.words;
  std::ofstream(folder_ / "two.trec", std::ios::trunc) << "another's";
  EXPECT_NE(message_of<InputError>([&] { desk->make(other_); }).find("another file lies"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(kept()));
}

TEST_F(DeskFilmsTest, GoesWithItsRecordingAndWhatIsNoFilmGoesToo) {
  films();
  const auto lay = [&](const std::string& name) { std::ofstream(kept() / name) << "film"; };
  lay(uuid_ + ".mp4");
  lay(other_ + ".mp4");
  lay("0000-none.mp4");
  lay(uuid_ + ".mp4.part");
  fs::last_write_time(kept() / (uuid_ + ".mp4.part"), fs::file_time_type::clock::now() - std::chrono::hours(2));
  fs::remove(folder_ / "two.trec");
  const fs::path diary = folder_ / "diary";
  std::ofstream(diary) << "private";
  fs::create_symlink(diary, kept() / "01890000-0000-7000-8000-000000000000.mp4");
  const auto desk = films();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kept())) names.push_back(entry.path().filename().string());
  EXPECT_EQ(names, std::vector<std::string>{uuid_ + ".mp4"});
  EXPECT_TRUE(fs::exists(diary));
  EXPECT_EQ(desk->state(uuid_).bytes, 4u);
}

TEST_F(DeskFilmsTest, ALinkOrAFolderOpenToOthersInItsPlaceIsRefused) {
  fs::create_directory(folder_ / "elsewhere");
  ::chmod((folder_ / "elsewhere").c_str(), 0700);
  fs::create_directory_symlink(folder_ / "elsewhere", kept());
  EXPECT_NE(message_of<EnvironmentError>([&] { films(); }), "");
  fs::remove(kept());
  fs::create_directory(kept());
  ::chmod(kept().c_str(), 0755);
  EXPECT_NE(message_of<EnvironmentError>([&] { films(); }).find("open to others"), std::string::npos);
}

TEST_F(DeskFilmsTest, WithoutFfmpegASentenceSaysSo) {
  EXPECT_EQ(DeskFilms::refusal(), "") << "this machine has both";
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_NE(DeskFilms::refusal().find("ffmpeg"), std::string::npos);
  ::setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace trocar::desk_films_test
