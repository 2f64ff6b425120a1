// Each recording is its attempt's, counts once and still gives what the record says; whoever rewrites the record, even
// with the station's key, is told by the recording.
#include "app/session/keeping/recording_check.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "app/session/keeping/attempt_keeping.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::recording_check_test {
namespace {

namespace fs = std::filesystem;

class RecordingsChecked : public ::testing::Test {
 protected:
  AttemptResult attempted(const std::string& trainee, const std::string& hand) {
    const Scene scene = short_scene(hand);
    const AttemptStart start = attempt_start(scene, trainee);
    const AttemptId id = store_.begin_attempt(start);
    const auto [outcome, recording] = record_or_abort(store_, id, scene, find_assets(), {});
    const AttemptResult result = kept_result(start, id, outcome, recording);
    store_.finish_attempt(id, result);
    return store_.load(id.uuid);
  }
  std::string said() {
    std::string out;
    for (const std::string& line : check_by_recordings(database_)) out += line + "\n";
    return out;
  }
  /// With every trigger out of the way.
  void rewrite(const std::string& change) {
    sqlite3* raw = database_.connection();
    std::vector<std::string> names;
    {
      sql::Statement rows(raw, "SELECT name FROM sqlite_schema WHERE type = 'trigger'");
      while (rows.step()) names.push_back(rows.text(0));
    }
    for (const std::string& name : names) sql::execute(raw, ("DROP TRIGGER " + name).c_str());
    sql::execute(raw, change.c_str());
  }

  test::TemporaryFolder folder_;
  Database database_{folder_ / "t.db"};
  AttemptStore store_{database_};
};

TEST_F(RecordingsChecked, AnotherPutInItsPlaceWhileTheAttemptRunsIsNotGraded) {
  const AttemptResult expert = attempted("T-expert", "expert");
  const Scene scene = short_scene("novice");
  const AttemptId id = store_.begin_attempt(attempt_start(scene, "T-novice"));
  SessionHooks hooks;
  bool exchanged = false;
  hooks.observe = [&](const SessionView& view) {
    if (exchanged || view.t_s < 2) return;
    exchanged = true;
    fs::copy_file(expert.recording_path, id.recording.string() + ".new");
    fs::rename(id.recording.string() + ".new", id.recording);
  };
  EXPECT_THROW(record_or_abort(store_, id, scene, find_assets(), hooks), EnvironmentError);
  const AttemptResult stored = store_.load(id.uuid);
  EXPECT_EQ(stored.grade.status, AttemptStatus::kAborted);
  EXPECT_FALSE(stored.grade.score);
  EXPECT_NE(stored.integrity.find("was put in its place"), std::string::npos) << stored.integrity;
}

TEST_F(RecordingsChecked, AnHonestRecordIsSound) {
  attempted("T-expert", "expert");
  attempted("T-novice", "novice");
  EXPECT_EQ(said(), "");
}

TEST_F(RecordingsChecked, AProgramThatWasKilledBeforeItsRecordingBeganLeavesNoProblem) {
  std::ifstream in(attempted("T-expert", "expert").recording_path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const std::size_t bytes : {0, 0, 5, 12, 20, 30}) {
    const AttemptId id = store_.begin_attempt(attempt_start(short_scene("novice"), "T-novice"));
    std::ofstream(id.recording, std::ios::binary) << whole.substr(0, bytes);
    AttemptResult result;
    result.grade.status = AttemptStatus::kAborted;
    result.cut_off = true;
    result.recording_path = id.recording;
    result.recording_sha256 = digest::of_file(id.recording);
    store_.finish_attempt(id, result);
  }
  EXPECT_EQ(said(), "");
  EXPECT_TRUE(store_.check_recordings().empty()) << store_.check_recordings().front();
}

TEST_F(RecordingsChecked, AnExpertsRecordingInAnothersPlaceShowsEvenWhenTheRecordWasMadeToFit) {
  const AttemptResult expert = attempted("T-expert", "expert"), other = attempted("T-novice", "novice");
  fs::copy_file(expert.recording_path, other.recording_path, fs::copy_options::overwrite_existing);
  rewrite("UPDATE attempt SET recording_sha256 = '" + expert.recording_sha256 + "' WHERE uuid = '" + other.uuid + "'");
  EXPECT_NE(said().find("is of another attempt: attempt \"" + expert.uuid), std::string::npos) << said();
  EXPECT_NE(store_.check_recordings().front().find("one recording counts for two attempts"), std::string::npos);
}

TEST_F(RecordingsChecked, AnotherBoardLevelOrHandThanTheRecordedShows) {
  attempted("T-expert", "expert");
  for (const char* change : {"board = 2", "level = 'exam'", "hand = 'mouse'", "seed = 6"}) {
    rewrite(std::string("UPDATE attempt SET ") + change);
    EXPECT_NE(said().find("is of another attempt: "), std::string::npos) << change << ": " << said();
    rewrite("UPDATE attempt SET board = 1, level = 'L1', hand = 'expert', seed = 5");
    EXPECT_EQ(said(), "");
  }
}

TEST_F(RecordingsChecked, AScoreThatTheRecordingDoesNotGiveShows) {
  const AttemptResult kept = attempted("T-heavy", "heavy-handed");
  ASSERT_FALSE(kept.grade.passed);
  rewrite("UPDATE score SET value = 95, passed = 1");
  EXPECT_NE(said().find("the record says completed, score 95.000000, passed"), std::string::npos) << said();
}

}  // namespace
}  // namespace trocar::recording_check_test
