// A store and a later program: nothing lost, hashes still hold, and whatever interrupts the migration, the old store is
// what is found.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/next_schema.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/station_key.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::database_migration_test {
namespace {

namespace fs = std::filesystem;

const int kNow = shipped_migrations().back().version, kNext = kNow + 1;

fs::path backup_of(const fs::path& database, const std::string& again = "") {
  return database.string() + ".schema" + std::to_string(kNow) + again + ".backup";
}

class OldStore : public TemporaryFolder {
 protected:
  OldStore() : file_(folder_ / "old.db") { make_store(file_, 7); }
  std::int64_t asked(const char* sql) const {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
    const std::int64_t value = sql::query_integer(raw, sql);
    sqlite3_close(raw);
    return value;
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path file_;
};

using OldestStore = TemporaryFolder;

TEST_F(OldStore, EveryAttemptStaysAndTheCutOffOnesAreMarked) {
  Database database = open_by_next_program(file_);
  EXPECT_EQ(database.migration().from, kNow);
  EXPECT_EQ(database.migration().to, kNext);
  EXPECT_TRUE(database.migration().compacted);
  EXPECT_EQ(database.recovered().size(), 2u) << "the third and the sixth";
  EXPECT_EQ(problems_of(database), "");
  const auto attempts = AttemptStore(database).list();
  ASSERT_EQ(attempts.size(), 7u);
  EXPECT_EQ(attempts[0].score, 57.0);
  EXPECT_EQ(attempts[1].status, "aborted");
  EXPECT_EQ(AttemptStore(database).load(std::int64_t{1}).grade.metrics.size(), 3u);
  EXPECT_EQ(sql::query_integer(database.connection(), "SELECT count(*) FROM event_tip"), 10);
  store_attempt(database, sample_start("t-OLD"), sample_result());
  EXPECT_EQ(problems_of(database), "");
  EXPECT_EQ(AttemptStore(database).list({"T-old", "", 0}).size(), 8u) << "the same person, the code's case ignored";
}

TEST_F(OldStore, TheTrailSaysWhatWasThereBefore) {
  const Database database = open_by_next_program(file_);
  const std::string detail =
      sql::query_text(database.connection(), "SELECT detail FROM audit WHERE action = 'schema migrated'");
  EXPECT_EQ(detail.find("7 attempts, head "), 0u) << detail;
  EXPECT_EQ(sql::query_text(database.connection(), "SELECT subject FROM audit WHERE action = 'schema migrated'"),
            "schema " + std::to_string(kNow) + " to " + std::to_string(kNext));
}

/// Nothing signed is older than its key: a record of before signatures, beside a key, was perhaps put there.
TEST_F(OldestStore, IsToldWhereAKeyLayBesideItAlready) {
  const auto remarks_of = [&](const char* name, bool key) {
    const fs::path file = folder_ / name;
    const Migration first[] = {{1, shipped_migrations().front().sql}};
    sqlite3* raw = nullptr;
    sqlite3_open(file.c_str(), &raw);
    migrate(raw, "", first);
    sqlite3_close(raw);
    if (key) write_station_key(file, SigningKey::make());
    const Database database(file);
    return audit_remarks(database.connection());
  };
  EXPECT_EQ(remarks_of("old.db", false), std::vector<std::string>{});
  const auto told = remarks_of("put_in.db", true);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("the station's key lay there already"), std::string::npos) << told[0];
}

TEST_F(OldStore, TheBackupIsTheOldDatabaseWhole) {
  const fs::path backup = open_by_next_program(file_).migration().backup;
  ASSERT_EQ(backup, backup_of(file_));
  EXPECT_EQ(schema_of_file(backup), kNow);
  for (const char* beside : {"-wal", "-shm"})
    EXPECT_FALSE(fs::exists(backup.string() + beside)) << "a backup is one file: " << beside;
  fs::rename(backup, folder_ / "again.db");
  Database again = open_by_next_program(folder_ / "again.db");
  EXPECT_EQ(again.migration().from, kNow);
  EXPECT_EQ(AttemptStore(again).list().size(), 7u);
}

TEST_F(OldStore, AnOlderProgramLeavesTheNewOneAlone) {
  { open_by_next_program(file_); }
  const std::string before = bytes();
  const std::string message = message_of<EnvironmentError>([&] { Database{file_}; });
  EXPECT_NE(message.find("newer trocar (schema " + std::to_string(kNext) + ", this program knows up to " +
                         std::to_string(kNow) + "); it was left as it is"),
            std::string::npos)
      << message;
  EXPECT_EQ(bytes(), before);
}

TEST_F(OldStore, AForgeryFromBeforeIsStillFound) {
  ASSERT_EQ(run_without_triggers(file_, "UPDATE score SET value = 99 WHERE attempt_id = 4"), "");
  EXPECT_NE(problems_of(open_by_next_program(file_)).find("was changed after it was finished"), std::string::npos);
}

TEST_F(OldStore, WithoutRoomToCompactItIsStillMigrated) {
  sqlite3* reader = nullptr;
  sqlite3_open(file_.c_str(), &reader);
  {
    // An old state that somebody reads: VACUUM cannot cut the file off.
    sql::Statement rows(reader, "SELECT uuid FROM attempt");
    ASSERT_TRUE(rows.step());
    const Database database = open_by_next_program(file_, 50);
    EXPECT_EQ(database.schema_version(), kNext);
    EXPECT_EQ(problems_of(database), "");
  }
  sqlite3_close(reader);
}

TEST_F(OldStore, KillMinusNineInTheMiddleLeavesTheOldOneUsable) {
  // A step that writes for seconds after everything else has been done, so that the kill comes before the commit.
  const Migration steps[] = {shipped_migrations().front(),
                             {kNext,
                              "CREATE TABLE slow (x INTEGER); WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 "
                              "FROM n WHERE x < 100000000) INSERT INTO slow SELECT x FROM n;"}};
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
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
  EXPECT_EQ(asked("PRAGMA user_version"), kNow);
  EXPECT_EQ(asked("SELECT count(*) FROM attempt"), 7);
  EXPECT_EQ(asked("SELECT count(*) FROM sqlite_schema WHERE name = 'slow'"), 0);
  const Database database = open_by_next_program(file_);
  EXPECT_EQ(database.migration().from, kNow);
  EXPECT_EQ(database.migration().backup, backup_of(file_, "-2")) << "the first backup is kept as well";
  EXPECT_TRUE(database.check().empty());
}

TEST_F(OldStore, WithoutRoomForTheBackupNothingIsMigrated) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{40000, 40000};  // the shared memory of the log fits, a copy of the database does not
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of<EnvironmentError>([&] { open_by_next_program(file_); });
    _exit(message.find("the backup cannot be written") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(asked("PRAGMA user_version"), kNow);
  EXPECT_FALSE(fs::exists(backup_of(file_))) << "no half backup";
  EXPECT_EQ(open_by_next_program(file_).migration().to, kNext);
}

}  // namespace
}  // namespace trocar::database_migration_test
