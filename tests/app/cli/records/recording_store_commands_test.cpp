// The commands that read the database, and the JSON of an attempt.
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/records/cohort_command.h"
#include "app/cli/records/db_command.h"
#include "app/cli/records/trainee_command.h"
#include "app/cli/text_table.h"
#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"

namespace trocar::recording_store_commands_test {
namespace {

using Json = nlohmann::json;

class StoreCommands : public TemporaryFolder {
 protected:
  StoreCommands() : file_(folder_ / "t.db") {}

  void fill() {
    Database database(file_);
    store_attempt(database, sample_start("T-one"), sample_result(81.25));
    store_attempt(database, sample_start("T-one"), sample_result(60));
    AttemptResult aborted = sample_result();
    aborted.grade.status = AttemptStatus::kAborted;
    aborted.grade.score.reset();
    store_attempt(database, sample_start("T-two"), aborted);
  }

  DbOptions rubric_named(const std::string& beginning) const {
    DbOptions options;
    options.database = file_;
    options.rubric = beginning;
    return options;
  }

  std::filesystem::path file_;
  std::ostringstream out_, err_;
};

TEST_F(StoreCommands, TraineeAddMakesTheDatabaseAndSaysWhenTheTraineeExists) {
  EXPECT_EQ(trainee_add({file_, "T-new"}, out_, err_), 0);
  EXPECT_EQ(out_.str().substr(0, 7), "T-new  ");
  EXPECT_EQ(err_.str(), "");
  out_.str("");
  EXPECT_EQ(trainee_add({file_, "t-new", 0, true}, out_, err_), 0);
  EXPECT_EQ(Json::parse(out_.str())["code"], "T-new");
  EXPECT_EQ(err_.str(), "trainee T-new exists already\n");
  EXPECT_THROW(trainee_add({file_, "no good"}, out_, err_), InputError);
}

TEST_F(StoreCommands, TraineeListIsATableOrJson) {
  fill();
  EXPECT_EQ(trainee_list({file_, ""}, out_, err_), 0);
  EXPECT_EQ(out_.str().find("trainee  attempts  passes  last (UTC)"), 0u) << out_.str();
  EXPECT_NE(out_.str().find("\nT-one           2       1  "), std::string::npos) << out_.str();
  out_.str("");
  EXPECT_EQ(trainee_list({file_, "", 0, true}, out_, err_), 0);
  const Json json = Json::parse(out_.str());
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["code"], "T-two");
  EXPECT_EQ(json[0]["attempts"], 2);
}

TEST_F(StoreCommands, TraineeShowListsAttemptsNewestFirst) {
  fill();
  EXPECT_EQ(trainee_show({file_, "T-one"}, out_, err_), 0);
  const std::string text = out_.str();
  EXPECT_NE(text.find("2 attempts, 1 passed"), std::string::npos) << text;
  EXPECT_LT(text.find("60.0"), text.find("81.2")) << text;
  EXPECT_NE(text.find("synthetic"), std::string::npos);
  out_.str("");
  EXPECT_EQ(trainee_show({file_, "T-two", 5, true}, out_, err_), 0);
  const Json json = Json::parse(out_.str());
  EXPECT_EQ(json["history"][0]["status"], "aborted");
  EXPECT_TRUE(json["history"][0]["score"].is_null());
  EXPECT_THROW(trainee_show({file_, "T-none"}, out_, err_), InputError);
}

TEST_F(StoreCommands, ADecisionCountsInEveryListAndIsNamedBesideTheScoresOwnVerdict) {
  fill();
  {
    Database database(file_);
    const AttemptSummary failed = AttemptStore(database).find("2");
    AssessmentStore(database).override_verdict(failed.uuid, true, "The stand slipped twice", {"0192-b", "Dr B"});
  }
  EXPECT_EQ(trainee_show({file_, "T-one"}, out_, err_), 0);
  EXPECT_NE(out_.str().find("2 attempts, 2 passed"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("yes, by Dr B"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("reliability"), std::string::npos) << out_.str();
  out_.str("");
  EXPECT_EQ(trainee_show({file_, "T-one", 0, true}, out_, err_), 0);
  const Json json = Json::parse(out_.str());
  EXPECT_EQ(json["passes"], 2);
  const Json& newest = json["history"][0];
  EXPECT_EQ(newest["number"], 2);
  EXPECT_EQ(newest["passed"], true);
  EXPECT_EQ(newest["passed_by_score"], false);
  EXPECT_EQ(newest["decided_by"], "Dr B");
  EXPECT_EQ(newest["score"], 60);
  EXPECT_TRUE(json["history"][1]["decided_by"].is_null());
  EXPECT_EQ(json["curves"][0]["passes"], 2);
  EXPECT_EQ(json["curves"][0]["judgements"][0]["decided"], 1);
  EXPECT_TRUE(json["curves"][0]["judgements"][0]["reliability"].is_null());
  out_.str("");
  EXPECT_EQ(cohort_command({file_, "T-one", true}, out_, err_), 0);
  EXPECT_EQ(Json::parse(out_.str())[0]["passes"], 2);
}

TEST_F(StoreCommands, CohortShowsBestLastAndMeans) {
  fill();
  EXPECT_EQ(cohort_command({file_, ""}, out_, err_), 0);
  EXPECT_NE(out_.str().find("81.2  60.0         2.71         41.5"), std::string::npos) << out_.str();
  out_.str("");
  EXPECT_EQ(cohort_command({file_, "T-two", true}, out_, err_), 0);
  const Json json = Json::parse(out_.str());
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["attempts"], 1);
  EXPECT_TRUE(json[0]["best"].is_null());
}

TEST_F(StoreCommands, AnExerciseFileOfTheSameIdIsSeenAsAnother) {
  Database database(file_);
  store_attempt(database, sample_start("T-one"), sample_result(60));
  AttemptStart easier = sample_start("T-one");
  easier.exercise_text += "# easier\n";
  store_attempt(database, easier, sample_result(100));
  EXPECT_EQ(cohort_command({file_, ""}, out_, err_), 0);
  const std::string shipped = "1.0 " + digest::of_bytes(sample_start().exercise_text).substr(0, 8);
  const std::string own = "1.0 " + digest::of_bytes(easier.exercise_text).substr(0, 8);
  EXPECT_NE(out_.str().find("surface-touch  " + shipped), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("surface-touch  " + own), std::string::npos) << out_.str();
  out_.str("");
  EXPECT_EQ(trainee_show({file_, "T-one", 0}, out_, err_), 0);
  EXPECT_LT(out_.str().find(own), out_.str().find(shipped)) << "newest first: " << out_.str();
  out_.str("");
  EXPECT_EQ(db_rubric(rubric_named(digest::of_bytes(easier.exercise_text).substr(0, 8)), out_, err_), 0);
  EXPECT_EQ(out_.str(), easier.exercise_text);
  EXPECT_THROW(db_rubric(rubric_named("ffff"), out_, err_), InputError);
  EXPECT_THROW(db_rubric(rubric_named("x"), out_, err_), InputError);
}

TEST_F(StoreCommands, DbAnchorRenewsALostAnchor) {
  fill();
  std::filesystem::remove(file_.string() + ".anchor");
  EXPECT_EQ(db_check({file_, ""}, out_, err_), 2);
  out_.str("");
  EXPECT_EQ(db_anchor({file_, ""}, out_, err_), 0);
  EXPECT_EQ(out_.str().substr(0, 15), "anchored at 13:");
  EXPECT_EQ(db_check({file_, ""}, out_, err_), 0) << out_.str();
}

TEST_F(StoreCommands, ReadingCommandsDoNotMakeADatabase) {
  EXPECT_THROW(trainee_list({file_, ""}, out_, err_), EnvironmentError);
  EXPECT_THROW(trainee_show({file_, "x"}, out_, err_), EnvironmentError);
  EXPECT_THROW(cohort_command({file_, ""}, out_, err_), EnvironmentError);
  EXPECT_THROW(db_check({file_, ""}, out_, err_), EnvironmentError);
  EXPECT_THROW(db_backup({file_, ""}, out_, err_), EnvironmentError);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(StoreCommands, DbCheckIsZeroWhenSoundAndTwoWhenNot) {
  fill();
  EXPECT_EQ(db_check({file_, ""}, out_, err_), 0);
  EXPECT_NE(out_.str().find("sound (schema 5, 3 attempts, head 12:"), std::string::npos) << out_.str();
  ASSERT_EQ(run_outside(file_, "DROP TRIGGER score_no_update; UPDATE score SET value = 100 WHERE attempt_id = 1"), "");
  out_.str("");
  EXPECT_EQ(db_check({file_, "", true}, out_, err_), 2);
  const Json json = Json::parse(out_.str());
  EXPECT_EQ(json["sound"], false);
  EXPECT_EQ(json["problems"].size(), 2u) << "the score, and the trigger";
  EXPECT_EQ(json["head"].get<std::string>().substr(0, 3), "12:");
}

TEST_F(StoreCommands, DbCheckFindsAChangedRecording) {
  {
    Database database(file_);
    AttemptStart start = sample_start();
    start.recording = folder_ / "a.trec";
    std::ofstream(*start.recording) << "as it was";
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(*start.recording);
    store_attempt(database, start, result);
    std::ofstream(*start.recording) << "as it is now";
  }
  EXPECT_EQ(db_check({file_, ""}, out_, err_), 2);
  EXPECT_NE(out_.str().find("a.trec"), std::string::npos);
}

TEST_F(StoreCommands, DbBackupNamesItsCopyAndMigrateSaysWhereItStands) {
  fill();
  EXPECT_EQ(db_backup({file_, ""}, out_, err_), 0);
  const std::string path = out_.str().substr(0, out_.str().size() - 1);
  EXPECT_EQ(TraineeStore(*std::make_unique<Database>(path)).list().size(), 2u);
  EXPECT_EQ(db_backup({file_, folder_ / "named"}, out_, err_), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "named"));
  EXPECT_THROW(db_backup({file_, folder_ / "named"}, out_, err_), InputError);
  out_.str("");
  EXPECT_EQ(db_migrate({file_, ""}, out_, err_), 0);
  EXPECT_EQ(out_.str(), "schema 5, up to date\n");
}

TEST_F(StoreCommands, OpeningReportsAttemptsThatWereCutOff) {
  {
    Database database(file_);
    AttemptStore(database).begin_attempt(sample_start("T-lost"));
  }
  ASSERT_EQ(run_outside(file_, "DROP TRIGGER attempt_keeps_identity; UPDATE attempt SET owner_boot = 'before'"), "");
  EXPECT_EQ(trainee_list({file_, ""}, out_, err_), 0);
  EXPECT_NE(err_.str().find("of T-lost was cut off"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("no recording"), std::string::npos);
}

TEST(AttemptJson, HasTheAgreedKeys) {
  AttemptResult result = sample_result();
  result.exercise_id = "surface-touch";
  result.exercise_version = "1.0";
  result.level = "L1";
  result.seed = 42;
  result.trainee = "T-expert";
  result.hand = "expert";
  result.uuid = "u";
  const Json json = Json::parse(attempt_json(result));
  for (const char* key : {"exercise", "trainee", "hand", "status", "score", "passed", "grade", "subscores", "caps",
                          "events", "metrics", "device", "organ", "rubric_sha256", "recording_sha256", "state_hash"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["exercise"],
            Json({{"id", "surface-touch"}, {"version", "1.0"}, {"level", "L1"}, {"seed", 42}, {"board", 0}}));
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["score"], 81.25);
  for (const char* key : {"name", "value", "weight", "raw", "unit", "full_at", "zero_at", "gate"}) {
    EXPECT_TRUE(json["subscores"][0].contains(key)) << key;
  }
  EXPECT_TRUE(json["subscores"][1]["raw"].is_null());
  EXPECT_EQ(json["events"][0]["t_s"], 1.0 / 3);
  EXPECT_EQ(json["events"][1]["severity"], "critical");
  EXPECT_TRUE(json["events"][1]["object"].is_null());
  EXPECT_EQ(json["metrics"]["time_s"], Json({{"value", 41.5}, {"unit", "s"}}));
  for (const char* key : {"backend", "rate_hz", "ticks", "overruns", "saturated_contact_share",
                          "passivity_active_share", "min_energy_j"}) {
    EXPECT_TRUE(json["device"].contains(key)) << key;
  }
  EXPECT_TRUE(json["organ"].contains("source") && json["organ"].contains("sha256"));
  EXPECT_EQ(json["caps"].size(), 1u);
  EXPECT_EQ(json["attempt"]["uuid"], "u");
}

TEST(AttemptJson, PrintsNullForWhatIsNoNumber) {
  AttemptResult result;
  result.grade.metrics = {{"tremor", std::nullopt, "m"}, {"odd", std::nan(""), "N"}};
  result.events = {{0, "X", Severity::kInfo, -1, std::numeric_limits<double>::infinity(), "", Vec3::Zero()}};
  result.device.min_energy_j = std::nan("");
  result.organ_credit = "bad \xFF byte";
  const std::string text = attempt_json(result);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf\"") == std::string::npos && text.find(": inf") == std::string::npos, true);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["score"].is_null());
  EXPECT_TRUE(json["metrics"]["tremor"]["value"].is_null());
  EXPECT_TRUE(json["metrics"]["odd"]["value"].is_null());
  EXPECT_TRUE(json["events"][0]["value"].is_null());
  EXPECT_TRUE(json["device"]["min_energy_j"].is_null());
}

TEST(TextTable, AlignsColumnsWithoutTrailingSpaces) {
  TextTable table({{"name"}, {"n", TextTable::Align::kRight}, {"note"}});
  table.add({"a", "10", "x"});
  table.add({"longer", "5"});
  std::ostringstream out;
  table.print(out);
  EXPECT_EQ(out.str(), "name     n  note\na       10  x\nlonger   5\n");
  EXPECT_EQ(cell(std::nullopt, 1), "-");
  EXPECT_EQ(cell(2.346, 2), "2.35");
  EXPECT_EQ(cell(std::nan(""), 2), "-");
  EXPECT_EQ(cell_time("2026-03-01T09:30:12.345Z"), "2026-03-01 09:30");
  EXPECT_EQ(cell_time(""), "-");
}

}  // namespace
}  // namespace trocar::recording_store_commands_test
