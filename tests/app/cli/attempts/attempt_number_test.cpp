// `trocar run` and its database: which attempt of a learner it is, and that an exam board is met once.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/attempts/run_command.h"
#include "haptics/input_error.h"
#include "tests/app/cli/command_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/records/attempt_store.h"

namespace trocar::attempt_number_test {
namespace {

using Json = nlohmann::json;
using test::message_of;

class AttemptNumber : public ::testing::Test {
 protected:
  RunOptions options(const std::string& hand, int attempt = 0) const {
    RunOptions run;
    run.exercise = exercise_.string();
    run.hand = hand;
    run.attempt = attempt;
    run.trainee = "T-1";
    run.seed = 7;
    run.database = folder_ / "t.db";
    run.json = true;
    return run;
  }
  Json run(const RunOptions& run) const {
    std::ostringstream out, err;
    EXPECT_EQ(run_command(run, out, err), 1) << "three seconds are too short to pass: " << err.str();
    return Json::parse(out.str());
  }
  /// State hash of the run: the same motion gives the same.
  std::string hash(const RunOptions& options) const { return run(options).at("state_hash"); }
  std::vector<AttemptSummary> stored() const {
    Database database(folder_ / "t.db");
    return AttemptStore(database).list();
  }
  std::size_t recordings() const {
    std::size_t n = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      n += entry.path().extension() == ".trec" ? 1 : 0;
    }
    return n;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path exercise_ = folder_.write("small.toml", testing_support::small_exercise());
};

TEST_F(AttemptNumber, ALearnerGoesOnWhereTheTraineeStands) {
  const std::string first = hash(options("learner")), second = hash(options("learner"));
  EXPECT_NE(first, second) << "it has learned";
  RunOptions elsewhere = options("learner", 1);
  elsewhere.database = ":memory:";
  EXPECT_EQ(hash(elsewhere), first);
  elsewhere.attempt = 2;
  EXPECT_EQ(hash(elsewhere), second) << "what is counted is what --attempt says";
  EXPECT_EQ(hash(options("learner", 1)), first) << "the number given wins over the one counted";
}

TEST_F(AttemptNumber, EveryTraineeBeginsAtTheFirst) {
  const std::string first = hash(options("learner"));
  RunOptions other = options("learner");
  other.trainee = "T-2";
  EXPECT_EQ(hash(other), first);
  EXPECT_NE(hash(other), first) << "and goes on alone";
}

TEST_F(AttemptNumber, OtherHandsDoNotLearn) {
  const std::string once = hash(options("novice"));
  EXPECT_EQ(hash(options("novice")), once);
  EXPECT_EQ(hash(options("novice", 30)), once);
  EXPECT_EQ(stored().size(), 3u);
  EXPECT_EQ(recordings(), 3u);
}

TEST_F(AttemptNumber, TheSetupTakesTheNumberAsGivenFromOneOn) {
  const AssetRoots assets = find_assets();
  EXPECT_EQ(attempt_setup(options("learner", 12), assets).attempt, 12);
  EXPECT_EQ(attempt_setup(options("learner", 0), assets).attempt, 1) << "until the database has been asked";
}

TEST_F(AttemptNumber, WhatIsStoredIsWhatWasPrinted) {
  const Json json = run(options("learner"));
  const std::vector<AttemptSummary> all = stored();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].uuid, json.at("attempt").at("uuid"));
  EXPECT_EQ(all[0].hand, "learner");
  EXPECT_EQ(all[0].exercise_id, "small-touch");
  EXPECT_EQ(all[0].exercise_version, "4");
  EXPECT_EQ(all[0].seed, 7);
  EXPECT_EQ(all[0].board, 1007);
  EXPECT_EQ(all[0].status, json.at("status"));
  EXPECT_EQ(all[0].rubric_sha256, json.at("rubric_sha256"));
}

using Exam = AttemptNumber;

TEST_F(Exam, ASecondSittingIsRefusedAndLeavesNothing) {
  RunOptions exam = options("novice");
  exam.level = "exam";
  const Json first = run(exam);
  std::ostringstream out, err;
  const std::string message = message_of<InputError>([&] { run_command(exam, out, err); });
  EXPECT_CONTAINS(message, "exam of small-touch, board 2000007: T-1 sat it on ");
  EXPECT_CONTAINS(message, first.at("attempt").at("uuid").get<std::string>());
  EXPECT_CONTAINS(message, "take another --seed");
  EXPECT_EQ(out.str(), "");
  EXPECT_EQ(stored().size(), 1u);
  EXPECT_EQ(recordings(), 1u);
}

TEST_F(Exam, AnotherHandOfTheSameTraineeIsASecondSittingAnotherSeedOrTraineeIsNot) {
  RunOptions exam = options("novice");
  exam.level = "exam";
  run(exam);
  RunOptions hand = exam, seed = exam, trainee = exam, practice = exam;
  hand.hand = "expert";
  std::ostringstream out, err;
  EXPECT_THROW(run_command(hand, out, err), InputError);
  seed.seed = 8;
  trainee.trainee = "T-2";
  practice.level = "L1";
  EXPECT_EQ(run(seed).at("exercise").at("level"), "exam");
  EXPECT_EQ(run(trainee).at("exercise").at("board"), 2000007) << "the same board for another";
  EXPECT_EQ(run(practice).at("exercise").at("board"), 1007) << "practice never meets an exam's";
  EXPECT_EQ(stored().size(), 4u);
}

TEST_F(Exam, ASeedThatDrawsTheSameBoardIsASecondSittingAndPracticeBoardsAreNone) {
  RunOptions exam = options("novice");
  exam.level = "exam";
  run(exam);
  std::ostringstream out, err;
  exam.seed += 1000000;
  EXPECT_CONTAINS(message_of<InputError>([&] { run_command(exam, out, err); }), "an exam board is met once");
  exam.board = 3;
  EXPECT_CONTAINS(message_of<InputError>([&] { run_command(exam, out, err); }),
                  "--board 3: is for practice; an exam's board is unseen, and drawn by --seed");
  exam.board = 20;
  EXPECT_CONTAINS(message_of<InputError>([&] { run_command(exam, out, err); }), "practice boards are 0 to 19");
  EXPECT_EQ(stored().size(), 1u);
}

}  // namespace
}  // namespace trocar::attempt_number_test
