// Recordings graded again behind the desk's pages: what it found, how far it is, and what a cut-off attempt's gives.
#include "app/desk/desk_recording_check.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/session/keeping/attempt_keeping.h"
#include "app/session/keeping/recording_check.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::desk_recording_check_test {
namespace {

namespace fs = std::filesystem;

class DeskRecordings : public ::testing::Test {
 protected:
  AttemptId begun() { return AttemptStore(database_).begin_attempt(attempt_start(scene_, "T-1")); }
  SessionOutcome recorded(const AttemptId& id, Recording& recording) {
    AttemptStore store(database_);
    auto [outcome, made] = record_or_abort(store, id, scene_, find_assets(), {});
    recording = std::move(made);
    return outcome;
  }
  /// A whole recording, and an attempt that was ended as those are whose program died.
  AttemptResult cut_off() {
    const AttemptId id = begun();
    Recording recording;
    recorded(id, recording);
    AttemptResult died;
    died.grade.status = AttemptStatus::kAborted;
    died.grade.grade = "not graded";
    died.cut_off = true;
    died.recording_sha256 = recording.sha256;
    AttemptStore(database_).finish_attempt(id, died);
    return AttemptStore(database_).load(id.uuid);
  }
  review::RecordingsChecked checked() {
    DeskRecordingCheck check([this] { return Database(file_, OpenMode::kExisting); });
    EXPECT_FALSE(check.state().running);
    check.begin();
    for (int i = 0; i < 600 && check.state().running; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return check.state();
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_ / "t.db";
  Scene scene_ = short_scene();
  Database database_{file_};
};

TEST_F(DeskRecordings, AreFoundSoundOrNot) {
  const AttemptId id = begun();
  Recording recording;
  const SessionOutcome outcome = recorded(id, recording);
  AttemptResult result = kept_result(attempt_start(scene_, "T-1"), id, outcome, recording);
  ASSERT_TRUE(result.grade.score);
  result.grade.score = *result.grade.score + 1;  // as a record says that was rewritten with the station's key
  AttemptStore(database_).finish_attempt(id, result);
  const review::RecordingsChecked found = checked();
  EXPECT_FALSE(found.running);
  EXPECT_EQ(found.done, 1u);
  EXPECT_EQ(found.all, 1u);
  EXPECT_NE(found.finished_utc, "");
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_NE(found.problems.front().find("the record says"), std::string::npos) << found.problems.front();
}

TEST_F(DeskRecordings, ThatWereExchangedAreFound) {
  std::vector<AttemptResult> kept;
  for (int n = 0; n < 2; ++n) {
    const AttemptId id = begun();
    Recording recording;
    const SessionOutcome outcome = recorded(id, recording);
    AttemptStore(database_).finish_attempt(id, kept_result(attempt_start(scene_, "T-1"), id, outcome, recording));
    kept.push_back(AttemptStore(database_).load(id.uuid));
    EXPECT_FALSE(recording_exchanged(kept.back()));
  }
  EXPECT_EQ(checked().problems, std::vector<std::string>{});
  fs::copy_file(kept[0].recording_path, kept[1].recording_path, fs::copy_options::overwrite_existing);
  EXPECT_TRUE(recording_exchanged(kept[1]));
  ASSERT_EQ(checked().problems.size(), 1u);
  EXPECT_NE(checked().problems.front().find(kept[1].uuid), std::string::npos) << checked().problems.front();
}

TEST_F(DeskRecordings, OfACutOffAttemptSayWhatTheyGiveAndWhoseTheyAre) {
  const AttemptResult died = cut_off();
  const std::string said = recorded_outcome(database_, died);
  EXPECT_NE(said.find("is its own and whole; graded from it: completed, score "), std::string::npos) << said;
  const AttemptResult other = cut_off();
  AttemptResult swapped = died;
  swapped.recording_path = other.recording_path;
  swapped.recording_sha256 = other.recording_sha256;
  EXPECT_NE(recorded_outcome(database_, swapped).find("is of another attempt"), std::string::npos);
  EXPECT_EQ(foreign_recording(database_, died), "");
  EXPECT_NE(foreign_recording(database_, swapped).find("is of another attempt"), std::string::npos)
      << "though these are the bytes that it was kept with";
  EXPECT_TRUE(checked().problems.empty()) << "what cut it off is no problem of the record";
  std::ofstream(died.recording_path, std::ios::app) << "x";
  EXPECT_NE(recorded_outcome(database_, died).find("is not in its place"), std::string::npos);
  EXPECT_NE(foreign_recording(database_, died), "");
  EXPECT_EQ(checked().problems.size(), 1u) << "a file that was changed is one";
}

}  // namespace
}  // namespace trocar::desk_recording_check_test
