// From a scene to a stored result: what is kept of a start, a stop, a disk that takes nothing, a database that does not
// answer.
#include "app/session/keeping/attempt_keeping.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <limits>

#include "app/window/attempt/disk_room.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ_manifest.h"
#include "trainees/files/free_room.h"

namespace trocar::attempt_keeping_test {
namespace {

using test::message_of;

class AttemptKeeping : public ::testing::Test {
 protected:
  AttemptStart start() const { return attempt_start(scene_, "T-9"); }
  /// Another program that is writing, for as long as it lives.
  struct Writer {
    explicit Writer(const std::filesystem::path& file) {
      EXPECT_EQ(sqlite3_open(file.c_str(), &connection), SQLITE_OK);
      EXPECT_EQ(sqlite3_exec(connection, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    }
    ~Writer() { sqlite3_close(connection); }
    sqlite3* connection = nullptr;
  };

  test::TemporaryFolder folder_;
  Scene scene_ = short_scene();
  Database database_{folder_ / "trocar.db", OpenMode::kCreate, 20};
  AttemptStore store_{database_};
};

TEST_F(AttemptKeeping, AStartSaysWhatTheSceneIsMadeOf) {
  const AttemptStart start = this->start();
  EXPECT_EQ(start.trainee, "T-9");
  EXPECT_EQ(start.exercise_id, "surface-touch");
  EXPECT_EQ(start.exercise_text, scene_.setup.exercise.text);
  EXPECT_EQ(start.level, "L1");
  EXPECT_EQ(start.seed, 5);
  EXPECT_EQ(start.board, 1);
  EXPECT_EQ(start.hand, "expert");
  EXPECT_EQ(start.organ_name, "liver");
  EXPECT_EQ(start.organ_sha256, scene_.organ.sha256);
  EXPECT_TRUE(start.organ_synthetic);
  EXPECT_FALSE(start.recording) << "beside the database";
  const AttemptId id = store_.begin_attempt(start);
  EXPECT_EQ(id.rubric_sha256, digest::of_bytes(scene_.setup.exercise.text));
}

TEST_F(AttemptKeeping, WhatHelpedAHandWithoutADeviceIsKept) {
  EXPECT_EQ(start().assists, "") << "on a device it was no help";
  scene_.loop.daq.motors = false;
  EXPECT_EQ(start().assists, "height plumb");
  const AttemptId id = store_.begin_attempt(start());
  AttemptResult ended;
  ended.grade.grade = "not graded";
  store_.finish_attempt(id, ended);
  EXPECT_EQ(store_.load(id.uuid).assists, "height plumb");
  scene_.level.pointer.glide = false;
  EXPECT_EQ(start().assists, "plumb");
  scene_.level.guides = false;
  EXPECT_EQ(start().assists, "");
}

TEST_F(AttemptKeeping, AStartSaysWhichSignInAndWhichCalibration) {
  EXPECT_EQ(start().session, "");
  EXPECT_EQ(start().station, "") << "without a sign-in no station";
  EXPECT_EQ(start().calibration, "") << "nominal";
  scene_.setup.device.calibration = DeviceFile{"{\"gains\": []}", "/home/somebody/cal.json"};
  const AttemptStart signed_in = attempt_start(scene_, "T-9", "0192-session");
  EXPECT_EQ(signed_in.session, "0192-session");
  char name[256] = "";
  ASSERT_EQ(gethostname(name, sizeof name - 1), 0);
  EXPECT_EQ(signed_in.station, name);
  EXPECT_EQ(signed_in.calibration, "{\"gains\": []}");
  EXPECT_EQ(signed_in.calibration_device.find("somebody"), std::string::npos) << "no path of a person's";
  for (int i = 0; i < 2; ++i) store_.begin_attempt(signed_in);
  sqlite3_stmt* rows = nullptr;
  ASSERT_EQ(
      sqlite3_prepare_v2(database_.connection(), "SELECT count(*), max(station) FROM session", -1, &rows, nullptr),
      SQLITE_OK);
  ASSERT_EQ(sqlite3_step(rows), SQLITE_ROW);
  EXPECT_EQ(sqlite3_column_int(rows, 0), 1);
  EXPECT_STREQ(reinterpret_cast<const char*>(sqlite3_column_text(rows, 1)), name);
  sqlite3_finalize(rows);
}

TEST_F(AttemptKeeping, WhatIsKeptIsTheStartsAndTheRecordingsAndReadsBackAsIt) {
  const AttemptStart start = this->start();
  const AttemptId id = store_.begin_attempt(start);
  const auto [outcome, recording] = record_or_abort(store_, id, scene_, find_assets(), {});
  const AttemptResult result = kept_result(start, id, outcome, recording);
  EXPECT_EQ(result.uuid, id.uuid);
  EXPECT_EQ(result.started_utc, id.started_utc);
  EXPECT_EQ(result.trainee, "T-9");
  EXPECT_EQ(result.organ_sha256, start.organ_sha256);
  EXPECT_EQ(result.rubric_sha256, id.rubric_sha256);
  EXPECT_EQ(result.state_hash, outcome.state_hash_hex);
  EXPECT_EQ(result.recording_sha256, digest::of_readable_file(id.recording));
  EXPECT_EQ(result.safety_log_path, "") << "nothing stopped it";
  store_or_say(store_, id, result);
  const AttemptResult back = store_.load(id.uuid);
  EXPECT_EQ(back.grade.score, result.grade.score);
  EXPECT_EQ(back.events.size(), result.events.size());
  EXPECT_EQ(back.state_hash, result.state_hash);
}

TEST_F(AttemptKeeping, AStopIsKeptBesideTheRecordingAndNowhereWithoutOne) {
  AttemptId id = store_.begin_attempt(start());
  auto [outcome, recording] = record_or_abort(store_, id, scene_, find_assets(), {});
  outcome.safety_csv = "tick,state\n7,fault\n";
  const AttemptResult result = kept_result(start(), id, outcome, recording);
  ASSERT_NE(result.safety_log_path, "");
  EXPECT_EQ(std::filesystem::path(result.safety_log_path).parent_path(), id.recording.parent_path());
  EXPECT_NE(result.safety_log_path, id.recording.string());
  EXPECT_EQ(read_bytes(result.safety_log_path), outcome.safety_csv);
  std::filesystem::remove(result.safety_log_path);
  id.recording.clear();
  EXPECT_EQ(kept_result(start(), id, outcome, recording).safety_log_path, "");
}

TEST_F(AttemptKeeping, ARecordingThatCannotBeWrittenEndsTheAttemptWithTheReason) {
  const AttemptId id = store_.begin_attempt(start());
  std::filesystem::remove_all(id.recording.parent_path());
  folder_.write(id.recording.parent_path().filename().string(), "a file where the folder should be");
  const std::string why = message_of<EnvironmentError>([&] { record_or_abort(store_, id, scene_, find_assets(), {}); });
  const AttemptResult kept = store_.load(id.uuid);
  EXPECT_EQ(kept.grade.status, AttemptStatus::kAborted);
  EXPECT_EQ(kept.grade.grade, "not graded");
  EXPECT_FALSE(kept.grade.score);
  EXPECT_EQ(kept.integrity, why);
  EXPECT_EQ(kept.recording_sha256, "");
}

TEST_F(AttemptKeeping, AResultThatTheDatabaseRefusesIsSaidWithScoreAndFile) {
  const AttemptId id = store_.begin_attempt(start());
  AttemptResult result;
  result.grade.status = AttemptStatus::kCompleted;
  result.grade.grade = "pass";
  result.grade.score = 81.25;
  AttemptId unrecorded = id;
  unrecorded.recording.clear();
  {
    const Writer busy(folder_ / "trocar.db");
    const std::string said = message_of<EnvironmentError>([&] { store_or_say(store_, id, result); });
    EXPECT_CONTAINS(said, "the attempt was not stored (completed, score 81.25");
    EXPECT_CONTAINS(said, id.recording.string() + " holds the result, on which a person can decide at the desk");
    const std::string plain = message_of<EnvironmentError>([&] { store_or_say(store_, unrecorded, result); });
    EXPECT_EQ(plain.find("holds the result"), std::string::npos) << "there is no file to promise: " << plain;
    EXPECT_TRUE(said.starts_with(plain)) << said;
    result.grade.score.reset();
    result.grade.status = AttemptStatus::kVoid;
    const std::string ungraded = message_of<EnvironmentError>([&] { store_or_say(store_, id, result); });
    EXPECT_CONTAINS(ungraded, "the attempt was not stored (void); its recording");
  }
  EXPECT_EQ(store_.find(id.uuid).status, "running") << "nothing half";
}

TEST_F(AttemptKeeping, ASecondResultIsRefusedAsItIs) {
  const AttemptId id = store_.begin_attempt(start());
  AttemptResult result;
  result.grade.grade = "not graded";
  store_or_say(store_, id, result);
  const std::string said = message_of<InputError>([&] { store_or_say(store_, id, result); });
  EXPECT_EQ(said.find("holds the result"), std::string::npos) << said;
}

// ---- room on the disk

TEST(DiskRoomMore, LongerAndFasterNeedMoreAndNothingNeedsTheReserve) {
  const std::uintmax_t reserve = room_needed(0, 1000);
  EXPECT_EQ(reserve, room_needed(600, 0));
  EXPECT_EQ(room_needed(1200, 1000) - reserve, 2 * (room_needed(600, 1000) - reserve));
  EXPECT_LT(room_needed(599, 1000), room_needed(600, 1000));
}

TEST(DiskRoomMore, AFolderBelowAFileIsOnTheFilesDiskAndNoAnswerIsNoRefusal) {
  const test::TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_NEAR(static_cast<double>(room_free(folder / "file" / "below")), static_cast<double>(room_free(folder.path())),
              1e9);
  EXPECT_NO_THROW(require_room("/data", room_needed(7200, 1000), std::numeric_limits<std::uintmax_t>::max()));
  EXPECT_CONTAINS(message_of<EnvironmentError>([] { require_room("/data", 1, 0); }), "0 MiB are free");
}

}  // namespace
}  // namespace trocar::attempt_keeping_test
