// From the first schema to today's: nothing lost, hashes still hold, and whatever interrupts it the old one is found.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/old_stores.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/cohort.h"
#include "trainees/records/process_identity.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::schema_migration_test {
namespace {

namespace fs = std::filesystem;

class SchemaMigration : public TemporaryFolder {
 protected:
  SchemaMigration() : file_(folder_ / "old.db") { make_schema1(file_); }
  std::int64_t asked(const char* sql) const {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
    const std::int64_t value = sql::query_integer(raw, sql);
    sqlite3_close(raw);
    return value;
  }
  fs::path file_;
};

TEST_F(SchemaMigration, KeepsEveryAttemptAndItsHash) {
  Database database(file_);
  EXPECT_EQ(database.migration().from, 1);
  EXPECT_EQ(database.migration().to, 5);
  for (const std::string& problem : database.check()) ADD_FAILURE() << problem;
  AttemptStore store(database);
  const auto attempts = store.list();
  ASSERT_EQ(attempts.size(), 3u);
  EXPECT_EQ(attempts[0].status, "aborted");
  EXPECT_EQ(attempts[0].trainee, "T-cut");
  EXPECT_FALSE(attempts[0].score);
  EXPECT_EQ(attempts[0].grade, "not graded");
  EXPECT_EQ(attempts[1].score, 0.0);
  const AttemptResult first = store.load(1);
  EXPECT_EQ(first.grade.metrics.size(), 44u);
  EXPECT_EQ(first.grade.subscores.size(), 5u);
  EXPECT_EQ(first.grade.caps.size(), 2u);
  EXPECT_EQ(first.hand, "dip.toml");
  EXPECT_EQ(store.exercise_text(first.rubric_sha256).substr(0, 5), "# E02");
  EXPECT_EQ(cohort(database).size(), 2u);
}

TEST_F(SchemaMigration, TheOldHashesStillShowAChange) {
  { Database database(file_); }
  ASSERT_EQ(run_outside(file_, "DROP TRIGGER score_no_update; UPDATE score SET value = 80 WHERE attempt_id = 2"), "");
  std::string problems;
  for (const std::string& problem : Database(file_).check()) problems += problem + "\n";
  EXPECT_NE(problems.find("was changed after it was finished"), std::string::npos) << problems;
}

TEST_F(SchemaMigration, NewAttemptsFollowTheOldOnes) {
  Database database(file_);
  store_attempt(database, sample_start("t-OLD"), sample_result());
  EXPECT_TRUE(database.check().empty());
  EXPECT_EQ(AttemptStore(database).list({"T-old", "", 0}).size(), 3u) << "the same person, the code's case ignored";
}

/// A database of schema 2 as its program left it: two sittings of one exam board by two seeds, and one cut off.
class FromSchema2 : public SchemaMigration {
 protected:
  FromSchema2() {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
    const std::string index =
        std::string(schema_v2()) +
        "CREATE UNIQUE INDEX exam_once ON attempt(trainee_id, exercise_id, seed) WHERE level = 'exam';";
    const auto first_entry = [](sqlite3* c, int) { append_audit(c, kActionMigrated, "schema 1 to 2", ""); };
    const Migration steps[] = {{1, kSchemaV1}, {2, index.c_str(), first_entry}};
    migrate(raw, "", steps);
    append_anchor(file_, audit_head(raw));
    sqlite3_close(raw);
    for (const char* seed : {"1", "2", "3"}) {
      EXPECT_EQ(
          run_outside(
              file_,
              std::string(
                  "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed,"
                  " board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program,"
                  " started_utc, owner_pid, owner_boot, owner_start, hash_version, status) SELECT 'exam-") +
                  seed + "', trainee_id, exercise_id, exercise_version, ruleset_sha256, 'exam', " + seed +
                  ", 3, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, '0', started_utc,"
                  " 1, '', 1, 2, 'running' FROM attempt WHERE id = 1"),
          "");
    }
  }
};

TEST_F(FromSchema2, TwoSittingsOfOneBoardStayAndAThirdIsRefused) {
  Database database(file_);
  EXPECT_EQ(database.migration().from, 2);
  EXPECT_EQ(database.migration().to, 5);
  EXPECT_EQ(database.recovered().size(), 3u) << "begun by the program before, ended by this one";
  for (const std::string& problem : database.check()) ADD_FAILURE() << problem;
  AttemptStore store(database);
  const AttemptSummary sat = store.list({"", "", 1}).front();
  EXPECT_EQ(sat.board, 3);
  AttemptStart start = sample_start(sat.trainee);
  start.exercise_id = sat.exercise_id;
  start.level = kExamLevel;
  start.seed = 4;
  start.board = sat.board;
  EXPECT_NE(message_of<InputError>([&] { store.begin_attempt(start); }).find("an exam board is met once"),
            std::string::npos);
  start.board = 4;
  store.finish_attempt(store.begin_attempt(start), sample_result());
  for (const std::string& problem : database.check()) ADD_FAILURE() << problem;
}

TEST_F(SchemaMigration, ABackupOfTheOldOneIsMadeFirst) {
  Database database(file_);
  const fs::path backup = database.migration().backup;
  ASSERT_EQ(backup, file_.string() + ".schema1.backup");
  fs::rename(backup, folder_ / "again.db");
  EXPECT_EQ(Database(folder_ / "again.db").migration().from, 1);
  EXPECT_TRUE(Database(folder_ / "again.db").check().empty());
}

TEST_F(SchemaMigration, WaitsForAnAttemptOfALivingProgram) {
  const ProcessIdentity me = this_process();
  ASSERT_EQ(run_outside(file_,
                        "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, rubric_sha256,"
                        " level, seed, board, hand, organ_name, organ_source, organ_sha256, organ_synthetic,"
                        " organ_credit, started_utc, owner_pid, owner_boot, owner_start, status)"
                        " SELECT 'living', trainee_id, exercise_id, exercise_version, rubric_sha256, level, 9,"
                        " board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit,"
                        " started_utc, " +
                            std::to_string(me.pid) + ", '" + me.boot + "', " + std::to_string(me.start) +
                            ", 'running' FROM attempt WHERE id = 1"),
            "");
  const std::string message = message_of<EnvironmentError>([&] { Database{file_}; });
  EXPECT_NE(message.find("is being run by an older trocar"), std::string::npos) << message;
  EXPECT_EQ(asked("PRAGMA user_version"), 1);
  ASSERT_EQ(run_outside(file_,
                        "DROP TRIGGER attempt_keeps_identity; UPDATE attempt SET owner_start = 1"
                        " WHERE uuid = 'living'"),
            "");
  Database database(file_);
  EXPECT_EQ(database.recovered().size(), 1u) << "dead: migrated, then aborted";
  for (const std::string& problem : database.check()) ADD_FAILURE() << problem;
}

TEST_F(SchemaMigration, KillMinusNineInTheMiddleLeavesTheOldOneUsable) {
  // A step that writes for seconds after everything else has been done, so that the kill comes before the commit.
  const std::string slow = std::string(schema_v2()) +
                           "CREATE TABLE slow (x INTEGER); WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 "
                           "FROM n WHERE x < 100000000)"
                           " INSERT INTO slow SELECT x FROM n;";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
    const Migration steps[] = {{1, kSchemaV1}, {2, slow.c_str()}};
    migrate(raw, file_, steps);
    _exit(0);
  }
  // Pages of the unfinished step spill into the log once they no longer fit into memory: that is the middle.
  const fs::path log = file_.string() + "-wal";
  std::error_code missing;
  while (!fs::exists(log) || fs::file_size(log, missing) < 4000000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it ended before it could be killed";
  EXPECT_EQ(asked("PRAGMA user_version"), 1);
  EXPECT_EQ(asked("SELECT count(*) FROM attempt"), 3);
  EXPECT_EQ(asked("SELECT count(*) FROM sqlite_schema WHERE name = 'slow'"), 0);
  Database database(file_);
  EXPECT_EQ(database.migration().from, 1);
  EXPECT_EQ(database.migration().backup, file_.string() + ".schema1-2.backup") << "the first backup is kept as well";
  EXPECT_TRUE(database.check().empty());
}

TEST_F(SchemaMigration, WithoutRoomForTheBackupNothingIsMigrated) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{40000, 40000};  // the shared memory of the log fits, a copy of the database does not
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of<EnvironmentError>([&] { Database{file_}; });
    _exit(message.find("the backup cannot be written") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(asked("PRAGMA user_version"), 1);
  EXPECT_FALSE(fs::exists(file_.string() + ".schema1.backup")) << "no half backup";
  EXPECT_EQ(Database(file_).migration().to, 5);
}

}  // namespace
}  // namespace trocar::schema_migration_test
