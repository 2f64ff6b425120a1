// Statements are prepared once for a connection, whatever is nested, fails, or changes under them.
#include "trainees/store/statement_cache.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "haptics/input_error.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::statement_cache_test {
namespace {

class StatementCacheTest : public testing::Test {
 protected:
  StatementCacheTest() {
    sqlite3_open(":memory:", &connection_);
    sql::execute(
        connection_,
        "CREATE TABLE t (id INTEGER PRIMARY KEY, s TEXT UNIQUE) STRICT; INSERT INTO t VALUES (1, 'a'), (2, 'b')");
    sql::keep_statements(connection_);
  }
  ~StatementCacheTest() override { sql::close_connection(connection_); }

  sql::StatementCache& cache() const { return *sql::statements_of(connection_); }
  std::string asked(const char* query) const { return sql::query_text(connection_, query); }

  sqlite3* connection_ = nullptr;
};

TEST_F(StatementCacheTest, PreparesATextOnce) {
  EXPECT_EQ(asked("SELECT s FROM t WHERE id = 1"), "a");
  EXPECT_EQ(cache().size(), 1u);
  EXPECT_EQ(asked("SELECT s FROM t WHERE id = 1"), "a");
  EXPECT_EQ(cache().size(), 1u);
  EXPECT_EQ(cache().reused(), 1u);
}

TEST_F(StatementCacheTest, ForgetsParametersAndPlaceBetweenUses) {
  const char* query = "SELECT s FROM t WHERE ?1 IS NULL OR id = ?1 ORDER BY id";
  {
    sql::Statement first(connection_, query);
    ASSERT_TRUE(first.bind(2).step());
    EXPECT_EQ(first.text(0), "b");
  }
  sql::Statement second(connection_, query);
  ASSERT_TRUE(second.step());
  EXPECT_EQ(second.text(0), "a") << "from the beginning, its parameter NULL again";
}

TEST_F(StatementCacheTest, TheSameTextCanBeNested) {
  const char* query = "SELECT id FROM t ORDER BY id";
  int pairs = 0;
  {
    sql::Statement outer(connection_, query);
    while (outer.step()) {
      sql::Statement inner(connection_, query);
      while (inner.step()) pairs += outer.integer(0) == inner.integer(0) ? 1 : 10;
    }
  }
  EXPECT_EQ(pairs, 22) << "each saw every row";
  EXPECT_EQ(cache().size(), 1u) << "one of a kind is kept";
}

TEST_F(StatementCacheTest, ALeftStatementHoldsNoLock) {
  {
    sql::Statement rows(connection_, "SELECT id FROM t");
    rows.step();
  }
  sql::execute(connection_, "DROP TABLE t");  // SQLite refuses while a statement reads it
  EXPECT_THROW(asked("SELECT id FROM t"), InputError);
}

TEST_F(StatementCacheTest, SeesAChangedSchema) {
  EXPECT_EQ(asked("SELECT count(*) FROM pragma_table_info('t')"), "2");
  const char* all = "SELECT * FROM t WHERE id = 1";
  { EXPECT_EQ(sql::Statement(connection_, all).columns(), 2); }
  sql::execute(connection_, "ALTER TABLE t ADD COLUMN n INTEGER DEFAULT 7");
  sql::Statement rows(connection_, all);
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.columns(), 3);
  EXPECT_EQ(rows.integer(2), 7);
}

TEST_F(StatementCacheTest, WorksOnAfterAnError) {
  const char* insert = "INSERT INTO t (s) VALUES (?)";
  EXPECT_THROW(sql::Statement(connection_, insert).bind("a").run(), InputError);
  sql::Statement(connection_, insert).bind("c").run();
  EXPECT_EQ(sql::query_integer(connection_, "SELECT count(*) FROM t"), 3);
}

TEST_F(StatementCacheTest, KeepsNothingThatActsWhenItIsPrepared) {
  for (const char* text : {"PRAGMA user_version", "ROLLBACK", "CREATE TABLE u (x)", "ATTACH 'x' AS y", "VACUUM"})
    EXPECT_FALSE(sql::StatementCache::keeps(text)) << text;
  asked("PRAGMA user_version");
  EXPECT_EQ(cache().size(), 0u);
}

TEST_F(StatementCacheTest, TheLongestUnusedGoesFirst) {
  const auto query = [](std::size_t n) { return "SELECT " + std::to_string(n); };
  for (std::size_t n = 0; n < sql::StatementCache::kMostKept; ++n) asked(query(n).c_str());
  asked(query(0).c_str());
  asked("SELECT 'one more'");
  EXPECT_EQ(cache().size(), sql::StatementCache::kMostKept);
  EXPECT_NE(sqlite3_next_stmt(connection_, nullptr), nullptr);
  const auto before = cache().reused();
  asked(query(0).c_str());
  EXPECT_EQ(cache().reused(), before + 1) << "used lately, so it is there";
  asked(query(1).c_str());
  EXPECT_EQ(cache().reused(), before + 1) << "it went";
}

TEST_F(StatementCacheTest, ATextWithAZeroByteOrMoreBehindItIsNotTakenForAnother) {
  EXPECT_EQ(asked("SELECT s FROM t WHERE id = 1; "), "a");
  EXPECT_EQ(asked("SELECT s FROM t WHERE id = 1"), "a");
  EXPECT_EQ(sql::query_text(connection_, std::string_view("SELECT s FROM t WHERE id = 12", 28)), "a")
      << "the view ends before the 2";
}

TEST(StatementsOfAConnection, AreKeptOnlyWhereItWasAskedFor) {
  sqlite3* plain = nullptr;
  sqlite3_open(":memory:", &plain);
  EXPECT_EQ(sql::query_integer(plain, "SELECT 5"), 5);
  EXPECT_EQ(sql::statements_of(plain), nullptr);
  EXPECT_EQ(sqlite3_close(plain), SQLITE_OK) << "no statement was left";
}

TEST(StatementsOfAConnection, MayOutliveIt) {
  sqlite3* connection = nullptr;
  sqlite3_open(":memory:", &connection);
  sql::keep_statements(connection);
  const auto late = std::make_unique<sql::Statement>(connection, "SELECT 5");
  sql::query_integer(connection, "SELECT 6");
  sql::close_connection(connection);  // goes with its last statement
  EXPECT_TRUE(late->step());
}

TEST(StatementsOfAConnection, AStoreUsesThem) {
  Database database(":memory:");
  for (int i = 0; i < 2; ++i)
    store_attempt(database, sample_start(), sample_result());  // a new trainee and exercise, then known ones
  const auto cache = sql::statements_of(database.connection());
  ASSERT_NE(cache, nullptr);
  const std::size_t kept = cache->size();
  const auto reused = cache->reused();
  store_attempt(database, sample_start(), sample_result());
  EXPECT_EQ(cache->size(), kept) << "a further attempt prepares nothing";
  EXPECT_GT(cache->reused(), reused + 20);
}

}  // namespace
}  // namespace trocar::statement_cache_test
