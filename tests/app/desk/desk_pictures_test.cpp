// Pictures of stored attempts: those of the replay, one at a time, kept; what is not there is named.
#include "app/desk/desk_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "app/session/grading/recorded_result.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/records/attempt_store.h"

namespace trocar::desk_pictures_test {
namespace {

using test::message_of;

class DeskPicturesTest : public testing::Test {
 protected:
  DeskPicturesTest() : file_(folder_ / "desk.db") {
    Database database(file_);
    uuid_ = store(database, folder_ / "short.trec");
    bare_ = store(database, {});
  }
  static std::string store(Database& database, const std::filesystem::path& recording) {
    AttemptStart start;
    start.trainee = "T01";
    start.exercise_id = "surface-touch";
    start.exercise_version = "1";
    start.exercise_text = "id = \"surface-touch\"\n";
    start.level = "L1";
    start.seed = 5;
    start.board = 1;
    start.hand = "expert";
    start.recording = recording;
    AttemptStore attempts(database);
    const AttemptId id = attempts.begin_attempt(start);
    AttemptResult result;
    result.grade.status = AttemptStatus::kAborted;
    if (!recording.empty()) result = *regrade_file(record_short(recording));
    attempts.finish_attempt(id, result);
    return id.uuid;
  }
  /// Asks until the replay is far enough.
  static std::string patiently(DeskPictures& pictures, const std::string& uuid, double t_s, int width) {
    while (true) {
      try {
        return pictures.png(uuid, t_s, width);
      } catch (const EnvironmentError& error) {
        if (std::string(error.what()).find("in a moment") == std::string::npos) throw;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
  }
  static int width_of(const std::string& png) {
    const auto byte = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(png[i])); };
    return png.size() < 24 ? 0 : byte(16) << 24 | byte(17) << 16 | byte(18) << 8 | byte(19);
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_;
  std::string uuid_, bare_;
};

TEST_F(DeskPicturesTest, ShowTheReplay) {
  DeskPictures pictures(find_assets(), [this] { return Database(file_); });
  const std::string begin = patiently(pictures, uuid_, 0, 480), later = patiently(pictures, uuid_, 9, 480);
  EXPECT_TRUE(begin.starts_with("\x89PNG"));
  EXPECT_EQ(width_of(begin), 480);
  EXPECT_NE(begin, later) << "time goes on";
  EXPECT_EQ(patiently(pictures, uuid_, 9, 480), later);
  EXPECT_EQ(patiently(pictures, uuid_, -5, 480), begin) << "before the beginning is the beginning";
  EXPECT_EQ(patiently(pictures, uuid_, std::numeric_limits<double>::quiet_NaN(), 480), begin);
  EXPECT_EQ(patiently(pictures, uuid_, 1e300, 480), patiently(pictures, uuid_, 80000, 480))
      << "behind the end is the end";
  EXPECT_EQ(width_of(patiently(pictures, uuid_, 1, 1000000)), DeskPictures::kWidest);
  EXPECT_EQ(width_of(patiently(pictures, uuid_, 1, -3)), DeskPictures::kNarrowest);
  EXPECT_NE(message_of<InputError>([&] { patiently(pictures, bare_, 0, 480); }).find("was not recorded"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { patiently(pictures, "latest", 0, 480); }).find("there is none"),
            std::string::npos)
      << "whole UUIDs only";
  EXPECT_NE(message_of<InputError>([&] { patiently(pictures, "0000-none", 0, 480); }), "");
  EXPECT_EQ(patiently(pictures, uuid_, 9, 480), later) << "what failed leaves the others";
}

TEST_F(DeskPicturesTest, TwoAttemptsAreHeldBesideEachOther) {
  DeskPictures pictures(find_assets(), [this] { return Database(file_); });
  std::string other;
  {
    Database database(file_);
    other = store(database, folder_ / "other.trec");
  }
  const std::string left = patiently(pictures, uuid_, 2, 480), right = patiently(pictures, other, 2, 480);
  EXPECT_EQ(left, right) << "the same run under two names";
  std::filesystem::remove(folder_ / "short.trec");
  std::filesystem::remove(folder_ / "other.trec");
  EXPECT_NE(patiently(pictures, uuid_, 9, 480), left);
  EXPECT_NE(patiently(pictures, other, 9, 480), left) << "neither is read again";
}

TEST_F(DeskPicturesTest, MapsDifferByWhatAndWhenceAndAreKept) {
  DeskPictures pictures(find_assets(), [this] { return Database(file_); });
  const auto map = [&](HeatOf of, bool overview) {
    while (true) {
      try {
        return pictures.heat(uuid_, of, overview, 480);
      } catch (const EnvironmentError& error) {
        if (std::string(error.what()).find("in a moment") == std::string::npos) throw;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
  };
  const std::string time = map(HeatOf::kTime, false), force = map(HeatOf::kForce, false),
                    over = map(HeatOf::kTime, true);
  EXPECT_EQ(width_of(time), 480);
  EXPECT_NE(time, force);
  EXPECT_NE(time, over);
  EXPECT_NE(time, patiently(pictures, uuid_, 0, 480));
  std::filesystem::remove(folder_ / "short.trec");
  EXPECT_EQ(map(HeatOf::kForce, false), force);
  EXPECT_NE(message_of<InputError>([&] { pictures.heat(bare_, HeatOf::kTime, false, 480); }), "");
}

}  // namespace
}  // namespace trocar::desk_pictures_test
