// Events, metrics, sub-scores and changes of the device's state: narrow rows and texts that stand once, read and
// written under the names of their views.
#include <sqlite3.h>

#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::narrow_rows_test {
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

/// Rows that come in by name, as a central database's do.
class ByName : public TemporaryFolder {
 protected:
  ByName() : file_(folder_ / "t.db"), database_(file_) {
    id_ = AttemptStore(database_).begin_attempt(sample_start("T-old"));
  }
  std::string attempt() const { return std::to_string(id_.row); }
  std::string refused(const std::string& sql) {
    return message_of<InputError>([&] { sql::execute(database_.connection(), sql.c_str()); });
  }
  std::string insert_event(const std::string& values) {
    return refused("INSERT INTO event VALUES (" + attempt() + ", " + values + ")");
  }
  fs::path file_;
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

TEST_F(ByName, AChangedTextOfALookUpTableChangesEveryAttemptThatHasIt) {
  AttemptStore(database_).finish_attempt(id_, sample_result());
  const AttemptId other = store_attempt(database_, sample_start("T-other"), sample_result());
  ASSERT_EQ(run_without_triggers(file_, "UPDATE metric_kind SET unit = 'ms' WHERE name = 'time_s'"), "");
  const std::string problems = problems_of(database_);
  for (const std::string& uuid : {id_.uuid, other.uuid})
    EXPECT_NE(problems.find("attempt " + uuid + " was changed"), std::string::npos) << problems;
}

TEST_F(ByName, TheCounterOfAttemptsStaysAheadOfWhatWasRemoved) {
  ASSERT_EQ(run_outside(file_, "UPDATE sqlite_sequence SET seq = 40 WHERE name = 'attempt'"), "");
  EXPECT_NE(problems_of(database_).find("the newest attempts were deleted"), std::string::npos);
}

TEST(NarrowRows, QueriesByTheViewsUseTheRowsNumbers) {
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
}  // namespace trocar::narrow_rows_test
