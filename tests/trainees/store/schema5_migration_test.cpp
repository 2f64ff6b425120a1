// From schema 4 to 5: the same record in less room. Rows, hashes, guards and exports are what they were.
#include <sqlite3.h>

#include <nlohmann/json.hpp>

#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/old_stores.h"
#include "trainees/records/erasure.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::schema5_migration_test {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::string>;

/// Every value of the query with its type and bits.
Rows rows_of(const fs::path& file, const std::string& query) {
  sqlite3* raw = nullptr;
  sqlite3_open(file.c_str(), &raw);
  Rows all;
  {
    sql::Statement rows(raw, query);
    while (rows.step()) {
      std::string row;
      for (int column = 0; column < rows.columns(); ++column) row += rows.canonical(column);
      all.push_back(row);
    }
  }
  sqlite3_close(raw);
  return all;
}

class FromSchema4 : public TemporaryFolder {
 protected:
  FromSchema4() : file_(folder_ / "old.db") { make_old_store(file_, 4, 7); }
  fs::path file_;
};

TEST_F(FromSchema4, EveryRowReadsBackUnderItsOldNameToTheBit) {
  const std::string queries[] = {
      "SELECT * FROM event ORDER BY attempt_id, position",           "SELECT * FROM metric ORDER BY score_id, position",
      "SELECT * FROM subscore ORDER BY score_id, position",          "SELECT * FROM score ORDER BY id",
      "SELECT * FROM attempt WHERE status <> 'running' ORDER BY id", "SELECT * FROM score_cap ORDER BY score_id"};
  std::vector<Rows> before;
  for (const std::string& query : queries) before.push_back(rows_of(file_, query));
  EXPECT_EQ(before[0].size(), 10u);
  EXPECT_EQ(before[1].size(), 15u);
  const std::size_t entries = rows_of(file_, "SELECT * FROM audit").size();
  const Rows trail = rows_of(file_, "SELECT * FROM audit ORDER BY position");
  {
    Database database(file_);
    EXPECT_EQ(database.migration().from, 4);
    EXPECT_EQ(database.migration().to, 5);
    EXPECT_TRUE(database.migration().compacted);
    EXPECT_EQ(problems_of(database), "");
  }
  const std::string finished_before = " AND id IN (1, 2, 4, 5, 7) ORDER BY id";
  for (std::size_t i = 0; i < 4; ++i) {
    Rows after = rows_of(file_, queries[i]);
    if (i == 3)
      std::erase_if(after, [&](const std::string& row) {
        return std::find(before[3].begin(), before[3].end(), row) == before[3].end();
      });
    EXPECT_EQ(after, before[i]) << queries[i];
  }
  EXPECT_EQ(rows_of(file_, "SELECT * FROM attempt WHERE status <> 'running'" + finished_before), before[4]);
  Rows after = rows_of(file_, "SELECT * FROM audit ORDER BY position");
  after.resize(entries);
  EXPECT_EQ(after, trail);
}

TEST_F(FromSchema4, WhatAPersonIsGivenOfThemselvesIsTheSame) {
  const auto told = [](Database& database) {
    nlohmann::json record = nlohmann::json::parse(everything_about(database, "T-old"));
    return record["attempts"].dump();
  };
  fs::copy_file(file_, folder_ / "copy.db");
  fs::copy_file(file_.string() + ".anchor", folder_ / "copy.db.anchor");
  Database first(file_), second(folder_ / "copy.db");
  EXPECT_EQ(rows_of(file_, "SELECT row_hash FROM attempt WHERE id IN (1, 2, 4)"),
            rows_of(first.migration().backup, "SELECT row_hash FROM attempt WHERE id IN (1, 2, 4)"));
  EXPECT_NE(told(first).find("TARGET_HELD"), std::string::npos);
  EXPECT_NE(told(second).find("force_max_n"), std::string::npos);
}

TEST_F(FromSchema4, TheBackupIsTheOldDatabaseWhole) {
  const fs::path backup = Database(file_).migration().backup;
  ASSERT_EQ(backup, file_.string() + ".schema4.backup");
  EXPECT_EQ(schema_of_file(backup), 4);
  for (const char* beside : {"-wal", "-shm"})
    EXPECT_FALSE(fs::exists(backup.string() + beside)) << "a backup is one file: " << beside;
  fs::rename(backup, folder_ / "again.db");
  Database again(folder_ / "again.db");
  EXPECT_EQ(again.migration().from, 4);
  EXPECT_EQ(AttemptStore(again).list().size(), 7u);
}

TEST_F(FromSchema4, AProgramOfSchema4LeavesTheNewOneAlone) {
  { Database database(file_); }
  sqlite3* raw = nullptr;
  sqlite3_open(file_.c_str(), &raw);
  const Migration steps[] = {{1, kSchemaV1}, {2, schema_v2()}, {3, kSchemaV3}, {4, schema_v4()}};
  const std::string message = message_of<EnvironmentError>([&] { migrate(raw, file_, steps); });
  sqlite3_close(raw);
  EXPECT_NE(message.find("newer trocar (schema 5, this program knows up to 4); it was left as it is"),
            std::string::npos)
      << message;
}

TEST_F(FromSchema4, ForgeriesFromBeforeAreStillFound) {
  ASSERT_EQ(run_without_triggers(file_, "UPDATE event SET type = 'TARGET_HIT' WHERE attempt_id = 4 AND position = 0"),
            "");
  EXPECT_NE(problems_of(Database(file_)).find("attempt attempt-4 was changed after it was finished"),
            std::string::npos);
}

TEST_F(FromSchema4, AChangedWordOfADictionaryChangesEveryAttemptThatHasIt) {
  { Database database(file_); }
  ASSERT_EQ(run_without_triggers(file_, "UPDATE metric_kind SET unit = 'ms' WHERE name = 'time_s'"), "");
  const std::string problems = problems_of(Database(file_));
  for (const char* attempt : {"attempt-1 was", "attempt-2 was", "attempt-7 was"})
    EXPECT_NE(problems.find(attempt), std::string::npos) << problems;
}

TEST_F(FromSchema4, TheCounterOfAttemptsStaysAheadOfWhatWasRemoved) {
  ASSERT_EQ(run_outside(file_, "UPDATE sqlite_sequence SET seq = 40 WHERE name = 'attempt'"), "");
  EXPECT_NE(problems_of(Database(file_)).find("the newest attempts were deleted"), std::string::npos);
}

TEST_F(FromSchema4, ARowThatCannotBeNumberedLeavesTheOldOneAsItWas) {
  ASSERT_EQ(run_without_triggers(file_, "UPDATE event SET position = 1 << 20 WHERE attempt_id = 1 AND position = 1"),
            "");
  EXPECT_THROW(Database{file_}, InputError);
  EXPECT_EQ(schema_of_file(file_), 4);
  EXPECT_EQ(rows_of(file_, "SELECT count(*) FROM event").front(), "i10;");
}

TEST_F(FromSchema4, WithoutRoomToCompactItIsStillMigrated) {
  sqlite3* reader = nullptr;
  sqlite3_open(file_.c_str(), &reader);
  {
    sql::Statement rows(
        reader, "SELECT uuid FROM attempt");  // an old state that somebody reads: VACUUM cannot cut the file off
    ASSERT_TRUE(rows.step());
    Database database(file_, OpenMode::kCreate, 50);
    EXPECT_EQ(database.schema_version(), 5);
    EXPECT_EQ(problems_of(database), "");
  }
  sqlite3_close(reader);
}

/// Rows that come in by name, as a central database's do.
class ByName : public FromSchema4 {
 protected:
  ByName() : database_(file_) { id_ = AttemptStore(database_).begin_attempt(sample_start("T-old")); }
  std::string attempt() const { return std::to_string(id_.row); }
  std::string refused(const std::string& sql) {
    return message_of<InputError>([&] { sql::execute(database_.connection(), sql.c_str()); });
  }
  std::string insert_event(const std::string& values) {
    return refused("INSERT INTO event VALUES (" + attempt() + ", " + values + ")");
  }
  Database database_;
  AttemptId id_;
};

TEST_F(ByName, ANewWordIsAddedOnce) {
  EXPECT_EQ(insert_event("0, 1.5, 'DROPPED', 'minor', 3, NULL, 'm', 0, 0, 0"), "");
  EXPECT_EQ(insert_event("1, 2.5, 'DROPPED', 'minor', 3, 0.5, 'm', 0, 0, 0"), "");
  EXPECT_EQ(insert_event("2, 3.5, 'CRUSH', 'critical', 3, 9, 'N', 0, 0, 0"), "");
  sqlite3* connection = database_.connection();
  EXPECT_EQ(sql::query_integer(connection, "SELECT count(*) FROM event_kind WHERE type = 'DROPPED'"), 1);
  EXPECT_EQ(sql::query_integer(connection, "SELECT id & 3 FROM event_kind WHERE type = 'CRUSH'"), 3)
      << "critical, and over its limit";
  EXPECT_EQ(
      sql::query_text(connection, "SELECT t_s FROM event WHERE attempt_id = " + attempt() + " AND type = 'CRUSH'"),
      "3.5");
}

TEST_F(ByName, APlaceOutsideAnAttemptsIsRefused) {
  for (const char* position : {"-1", "1048576", "NULL"})
    EXPECT_NE(insert_event(std::string(position) + ", 1.5, 'DROPPED', 'minor', 3, 0, 'm', 0, 0, 0"), "") << position;
  EXPECT_EQ(insert_event("1048575, 1.5, 'DROPPED', 'minor', 3, 0, 'm', 0, 0, 0"), "");
  EXPECT_NE(insert_event("1048575, 1.5, 'DROPPED', 'minor', 3, 0, 'm', 0, 0, 0"), "") << "taken";
}

TEST_F(ByName, AMetricStandsOnceWhateverItsUnit) {
  sql::execute(
      database_.connection(),
      ("INSERT INTO score SELECT 900, id, 0, ruleset_sha256, 50, 0, '' FROM attempt WHERE id = " + attempt()).c_str());
  EXPECT_EQ(refused("INSERT INTO metric VALUES (900, 0, 'luck', 1, 'N')"), "");
  EXPECT_NE(refused("INSERT INTO metric VALUES (900, 1, 'luck', 1, 'm')"), "");
  EXPECT_EQ(refused("INSERT INTO subscore VALUES (900, 0, 'luck', 1, NULL, 2, 'N', 0, 5, 0)"), "");
  EXPECT_NE(refused("INSERT INTO subscore VALUES (900, 1, 'luck', 1, 1, 2, 'N', 0, 5, 0)"), "");
  EXPECT_NE(refused("DELETE FROM score WHERE id = 900"), "");
  EXPECT_EQ(rows_of(file_, "SELECT position, name, weight, full_at, gate FROM subscore WHERE score_id = 900").front(),
            "i0;t4:luck;n;r0000000000000000;i0;");
}

TEST_F(ByName, TheStoreRefusesAMetricTwiceToo) {
  AttemptResult result = sample_result();
  result.grade.metrics.push_back({"time_s", 1.0, "min"});
  EXPECT_THROW(AttemptStore(database_).finish_attempt(id_, result), InputError);
  AttemptStore(database_).finish_attempt(id_, sample_result());
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(ByName, RowsOfNobodyAreTold) {
  AttemptStore(database_).finish_attempt(id_, sample_result());
  ASSERT_EQ(
      run_without_triggers(file_,
                           "INSERT INTO event_row SELECT 500 << 20, t_s, kind_id, 0, 0, 0, 0, 0 FROM event_row LIMIT 1;"
                           "INSERT INTO metric_row VALUES (1 << 10 | 999, 9, 1);"
                           "INSERT INTO subscore_row VALUES (700 << 10, 1, 1, 1)"),
      "");
  const std::string problems = problems_of(database_);
  for (const char* table :
       {"of event_row points to nothing", "of metric_row points to nothing", "of subscore_row points to nothing"})
    EXPECT_NE(problems.find(table), std::string::npos) << problems;
}

TEST(Schema5, QueriesByOldNamesUseTheRowsNumbers) {
  Database database(":memory:");
  const auto plan = [&](const std::string& query) {
    std::string all;
    sql::Statement rows(database.connection(), "EXPLAIN QUERY PLAN " + query);
    while (rows.step()) all += rows.text(3) + "; ";
    return all;
  };
  for (const char* query :
       {"SELECT * FROM event WHERE attempt_id = 5", "SELECT * FROM metric WHERE score_id = 5",
        "SELECT * FROM subscore WHERE score_id = 5", "SELECT value FROM metric WHERE score_id = 5 AND name = 'time_s'",
        "SELECT m.value FROM score s JOIN metric m ON m.score_id = s.id WHERE s.attempt_id = 5 AND s.revision = 0"}) {
    EXPECT_EQ(plan(query).find("SCAN"), std::string::npos) << query << ": " << plan(query);
  }
}

}  // namespace
}  // namespace trocar::schema5_migration_test
