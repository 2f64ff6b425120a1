// From schema 3 on: every attempt and its hash stay, the new tables are there and guarded, an older program leaves the
// file alone.
#include <sqlite3.h>

#include <fstream>
#include <iterator>

#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/old_stores.h"
#include "trainees/records/opinions.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::schema4_migration_test {
namespace {

namespace fs = std::filesystem;

class FromSchema3 : public TemporaryFolder {
 protected:
  FromSchema3() : file_(folder_ / "old.db") { make_old_store(file_, 3, 7); }
  fs::path file_;
};

TEST_F(FromSchema3, EveryAttemptStaysAndTheCutOffOnesAreMarked) {
  Database database(file_);
  EXPECT_EQ(database.migration().from, 3);
  EXPECT_EQ(database.migration().to, 5);
  EXPECT_EQ(database.recovered().size(), 2u) << "the third and the sixth";
  EXPECT_EQ(problems_of(database), "");
  const auto attempts = AttemptStore(database).list();
  ASSERT_EQ(attempts.size(), 7u);
  EXPECT_EQ(attempts[0].score, 57.0);
  EXPECT_EQ(attempts[1].status, "aborted");
  EXPECT_EQ(AttemptStore(database).load(std::int64_t{1}).grade.metrics.size(), 3u);
}

TEST_F(FromSchema3, TheBackupIsTheOldDatabaseWhole) {
  const fs::path backup = Database(file_).migration().backup;
  ASSERT_EQ(backup, file_.string() + ".schema3.backup");
  EXPECT_EQ(schema_of_file(backup), 3);
  fs::rename(backup, folder_ / "again.db");
  Database again(folder_ / "again.db");
  EXPECT_EQ(again.migration().from, 3);
  EXPECT_EQ(AttemptStore(again).list().size(), 7u);
}

TEST_F(FromSchema3, AProgramOfSchema3LeavesTheNewOneAlone) {
  { Database database(file_); }
  std::ifstream before_in(file_, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(before_in)), {});
  sqlite3* raw = nullptr;
  sqlite3_open(file_.c_str(), &raw);
  const Migration steps[] = {{1, kSchemaV1}, {2, schema_v2()}, {3, kSchemaV3}};
  const std::string message = message_of<EnvironmentError>([&] { migrate(raw, file_, steps); });
  sqlite3_close(raw);
  EXPECT_NE(message.find("newer trocar (schema 5, this program knows up to 3); it was left as it is"),
            std::string::npos)
      << message;
  std::ifstream after_in(file_, std::ios::binary);
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(after_in)), {}), before);
}

TEST_F(FromSchema3, WhatPeopleSayOfOldAttemptsIsKeptAsOfNewOnes) {
  Database database(file_);
  OpinionStore opinions(database);
  const Author author{"", "Ida Adler"};
  opinions.sign("attempt-1", "approval", "", author);
  opinions.add_note("T-old", "attempt-2", "Slower.", author);
  store_attempt(database, sample_start("T-old"), sample_result());
  EXPECT_EQ(problems_of(database), "");
  EXPECT_THROW(sql::execute(database.connection(), "DELETE FROM signature"), InputError);
  EXPECT_THROW(sql::execute(database.connection(), "DELETE FROM event"), InputError) << "the old guards still stand";
}

TEST_F(FromSchema3, AForgeryFromBeforeIsStillFound) {
  ASSERT_EQ(run_without_triggers(file_, "UPDATE score SET value = 99 WHERE attempt_id = 4"), "");
  EXPECT_NE(problems_of(Database(file_)).find("attempt attempt-4 was changed after it was finished"),
            std::string::npos);
}

TEST_F(FromSchema3, ARowThatStoodThereWithoutAProgramIsTold) {
  ASSERT_EQ(run_outside(file_,
                        "INSERT INTO signature (attempt_id, row_hash, signer, meaning, note, utc)"
                        " SELECT 1, row_hash, 'x', 'approval', '', '' FROM attempt WHERE id = 1"),
            "");
  EXPECT_NE(problems_of(Database(file_)).find("a row of signature has no identifier"), std::string::npos)
      << "no program wrote any before";
}

TEST_F(FromSchema3, FromSchema1ItIsOneStepForTheUser) {
  make_schema1(folder_ / "first.db");
  Database database(folder_ / "first.db");
  EXPECT_EQ(database.migration().from, 1);
  EXPECT_EQ(database.migration().to, 5);
  EXPECT_EQ(problems_of(database), "");
  EXPECT_EQ(TraineeStore(database).list().size(), 2u);
}

}  // namespace
}  // namespace trocar::schema4_migration_test
