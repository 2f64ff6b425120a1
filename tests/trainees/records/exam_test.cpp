// An exam board is met once by a trainee.
#include <sys/wait.h>
#include <unistd.h>

#include "tests/trainees/records/store_samples.h"

namespace trocar::exam_test {
namespace {

AttemptStart exam(const std::string& trainee, std::int64_t seed = 7) {
  AttemptStart start = sample_start(trainee);
  start.level = kExamLevel;
  start.seed = seed;
  start.board = 2000000 + static_cast<int>(seed % 1000000);
  return start;
}

TEST(Exam, ASecondSittingIsRefusedBeforeItBegins) {
  Database database(":memory:");
  const AttemptId first = store_attempt(database, exam("A"), sample_result(40));
  const std::string message = message_of<InputError>([&] { AttemptStore(database).begin_attempt(exam("a")); });
  EXPECT_NE(message.find("an exam board is met once"), std::string::npos) << message;
  EXPECT_NE(message.find(first.uuid), std::string::npos) << message;
  EXPECT_EQ(AttemptStore(database).list().size(), 1u);
}

TEST(Exam, TheBoardTellsAndNotTheSeed) {
  Database database(":memory:");
  store_attempt(database, exam("A", 5), sample_result());
  const std::string message = message_of<InputError>([&] { AttemptStore(database).begin_attempt(exam("A", 1000005)); });
  EXPECT_NE(message.find("exam of surface-touch, board 2000005: A sat it on "), std::string::npos) << message;
  AttemptStart organ = exam("A", 5);
  organ.organ_name = "another";
  EXPECT_THROW(AttemptStore(database).begin_attempt(organ), InputError) << "places are drawn by the board on any organ";
  EXPECT_EQ(AttemptStore(database).list().size(), 1u);
}

using ExamFile = TemporaryFolder;

TEST_F(ExamFile, BelowTheProgramATriggerSaysSo) {
  {
    Database database(folder_ / "t.db");
    store_attempt(database, exam("A"), sample_result());
  }
  const std::string again =
      "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed, board, hand,"
      " organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program, started_utc, owner_pid,"
      " owner_boot, owner_start, hash_version, status) SELECT 'x', trainee_id, exercise_id, exercise_version,"
      " ruleset_sha256, level, seed + 1000000, board, hand, '', '', '', 0, '', '', '', 1, '', 1, 3, 'running' FROM "
      "attempt";
  EXPECT_EQ(run_outside(folder_ / "t.db", again), "an exam board is met once");
}

TEST(Exam, AnotherSeedTraineeExerciseOrLevelIsAnotherBoard) {
  Database database(":memory:");
  store_attempt(database, exam("A"), sample_result());
  store_attempt(database, exam("A", 8), sample_result());
  store_attempt(database, exam("B"), sample_result());
  AttemptStart other = exam("A");
  other.exercise_id = "limited-grasp";
  other.exercise_text += "#";
  store_attempt(database, other, sample_result());
  AttemptStart practice = exam("A");
  practice.level = "L3";
  store_attempt(database, practice, sample_result());
  store_attempt(database, practice, sample_result());
  EXPECT_EQ(AttemptStore(database).list().size(), 6u);
}

TEST_F(ExamFile, ARunningOrCutOffSittingCountsAsOne) {
  Database database(folder_ / "t.db");
  AttemptStore(database).begin_attempt(exam("A"));
  EXPECT_THROW(AttemptStore(database).begin_attempt(exam("A")), InputError);
  const pid_t child = fork();
  if (child == 0) {
    Database other(folder_ / "t.db");
    AttemptStore(other).begin_attempt(exam("B"));
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  EXPECT_EQ(Database(folder_ / "t.db").recovered().size(), 1u);
  EXPECT_NE(message_of<InputError>([&] { AttemptStore(database).begin_attempt(exam("B")); }).find("aborted"),
            std::string::npos);
}

TEST_F(ExamFile, OfTwoProgramsAtOnceOneSits) {
  { Database database(folder_ / "t.db"); }
  int sat = 0;
  for (int program = 0; program < 4; ++program) {
    if (fork() == 0) {
      Database database(folder_ / "t.db");
      _exit(message_of<InputError>([&] { AttemptStore(database).begin_attempt(exam("A")); }).empty() ? 1 : 0);
    }
  }
  for (int program = 0; program < 4; ++program) {
    int status = 0;
    wait(&status);
    sat += WEXITSTATUS(status);
  }
  EXPECT_EQ(sat, 1);
}

}  // namespace
}  // namespace trocar::exam_test
