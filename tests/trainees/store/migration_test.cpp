// Migrations: in order, all or nothing, with a backup first.
#include "trainees/store/migrations.h"

#include <sqlite3.h>

#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::migration_test {
namespace {

namespace fs = std::filesystem;

constexpr Migration kFirst[] = {{1, "CREATE TABLE thing (id INTEGER PRIMARY KEY, name TEXT) STRICT"}};
constexpr Migration kThree[] = {{1, "CREATE TABLE thing (id INTEGER PRIMARY KEY, name TEXT) STRICT"},
                                {2, "ALTER TABLE thing ADD COLUMN size INTEGER NOT NULL DEFAULT 5"},
                                {3, "UPDATE thing SET size = size + 1"}};
constexpr Migration kBroken[] = {{1, "SELECT 1"}, {2, "CREATE TABLE extra (x INTEGER); UPDATE nothing SET x = 1"}};

class MigrationTest : public TemporaryFolder {
 protected:
  MigrationTest() : file_(folder_ / "m.db") { sqlite3_open(file_.c_str(), &connection_); }
  ~MigrationTest() override { sqlite3_close(connection_); }

  fs::path file_;
  sqlite3* connection_ = nullptr;
};

TEST_F(MigrationTest, TakesAnOlderDatabaseThroughEveryStepAfterABackup) {
  migrate(connection_, file_, kFirst);
  sql::execute(connection_, "INSERT INTO thing (name) VALUES ('kept')");
  const MigrationReport report = migrate(connection_, file_, kThree);
  EXPECT_EQ(report.from, 1);
  EXPECT_EQ(report.to, 3);
  EXPECT_EQ(sql::query_integer(connection_, "SELECT size FROM thing WHERE name = 'kept'"), 6);
  EXPECT_EQ(sql::query_integer(connection_, "PRAGMA user_version"), 3);
  ASSERT_EQ(report.backup, file_.string() + ".schema1.backup");
  sqlite3* backup = nullptr;
  sqlite3_open(report.backup.c_str(), &backup);
  EXPECT_EQ(sql::query_integer(backup, "PRAGMA user_version"), 1);
  EXPECT_EQ(sql::query_text(backup, "SELECT name FROM thing"), "kept");
  sqlite3_close(backup);
}

TEST_F(MigrationTest, DoesNothingWhenUpToDate) {
  migrate(connection_, file_, kThree);
  const MigrationReport report = migrate(connection_, file_, kThree);
  EXPECT_EQ(report.from, report.to);
  EXPECT_TRUE(report.backup.empty());
}

TEST_F(MigrationTest, AFailingStepLeavesTheDatabaseAsItWas) {
  migrate(connection_, file_, kFirst);
  EXPECT_THROW(migrate(connection_, file_, kBroken), InputError);
  EXPECT_EQ(sql::query_integer(connection_, "PRAGMA user_version"), 1);
  EXPECT_EQ(sql::query_integer(connection_, "SELECT count(*) FROM sqlite_schema WHERE name = 'extra'"), 0);
}

TEST_F(MigrationTest, ASecondBackupGetsItsOwnName) {
  migrate(connection_, file_, kFirst);
  EXPECT_THROW(migrate(connection_, file_, kBroken), InputError);
  EXPECT_EQ(migrate(connection_, file_, kThree).backup, file_.string() + ".schema1-2.backup");
}

TEST_F(MigrationTest, MarksTheFileAsOurs) {
  migrate(connection_, file_, kFirst);
  EXPECT_EQ(sql::query_integer(connection_, "PRAGMA application_id"), kApplicationId);
}

TEST(Migrations, AreNumberedWithoutGaps) {
  int expected = 1;
  for (const Migration& migration : shipped_migrations()) EXPECT_EQ(migration.version, expected++);
}

}  // namespace
}  // namespace trocar::migration_test
