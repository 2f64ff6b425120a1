// The thin layer over SQLite: values, errors by kind, transactions.
#include "trainees/store/sqlite_handle.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "haptics/input_error.h"

namespace trocar::sqlite_handle_test {
namespace {

class SqliteHandle : public testing::Test {
 protected:
  SqliteHandle() {
    sqlite3_open(":memory:", &connection_);
    sql::execute(connection_, "CREATE TABLE t (i INTEGER, r REAL, s TEXT UNIQUE) STRICT");
  }
  ~SqliteHandle() override { sqlite3_close(connection_); }

  sqlite3* connection_ = nullptr;
};

TEST_F(SqliteHandle, ReturnsValuesAsTheyWereBound) {
  sql::Statement insert(connection_, "INSERT INTO t VALUES (?, ?, ?)");
  const std::string text("with \0 inside", 13);
  insert.bind(std::numeric_limits<std::int64_t>::min()).bind(0.1).bind(text).run();
  insert.bind(true).bind(std::optional<double>()).bind("").run();
  sql::Statement rows(connection_, "SELECT i, r, s FROM t ORDER BY rowid");
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.columns(), 3);
  EXPECT_EQ(rows.integer(0), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(rows.real(1), 0.1);
  EXPECT_EQ(rows.text(2), text);
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.integer(0), 1);
  EXPECT_TRUE(rows.is_null(1));
  EXPECT_TRUE(std::isnan(rows.real(1)));
  EXPECT_FALSE(rows.optional_real(1));
  EXPECT_EQ(rows.text(2), "");
  EXPECT_FALSE(rows.is_null(2));
  EXPECT_FALSE(rows.step());
}

TEST_F(SqliteHandle, StoresNotANumberAsNullAndInfinityAsItself) {
  sql::Statement insert(connection_, "INSERT INTO t (r) VALUES (?)");
  insert.bind(std::nan("")).run();
  insert.bind(-std::numeric_limits<double>::infinity()).run();
  sql::Statement rows(connection_, "SELECT r FROM t ORDER BY rowid");
  ASSERT_TRUE(rows.step());
  EXPECT_TRUE(rows.is_null(0));
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.real(0), -std::numeric_limits<double>::infinity());
}

TEST_F(SqliteHandle, CanonicalFormTellsTypesAndLengthsApart) {
  sql::Statement row(connection_, "SELECT 1, 1.0, '1', NULL, '', -0.0, 'a;b'");
  ASSERT_TRUE(row.step());
  EXPECT_EQ(row.canonical(0), "i1;");
  EXPECT_EQ(row.canonical(1), "r3ff0000000000000;");
  EXPECT_EQ(row.canonical(2), "t1:1;");
  EXPECT_EQ(row.canonical(3), "n;");
  EXPECT_EQ(row.canonical(4), "t0:;");
  EXPECT_EQ(row.canonical(6), "t3:a;b;");
}

TEST_F(SqliteHandle, ConstraintsTypesAndBadStatementsAreInputErrors) {
  sql::execute(connection_, "INSERT INTO t (s) VALUES ('one')");
  EXPECT_THROW(sql::execute(connection_, "INSERT INTO t (s) VALUES ('one')"), InputError);
  EXPECT_THROW(sql::execute(connection_, "INSERT INTO t (i) VALUES ('text')"), InputError);
  EXPECT_THROW(sql::Statement(connection_, "SELECT nothing FROM nowhere"), InputError);
  sql::Statement none(connection_, "SELECT 1");
  EXPECT_THROW(none.bind(1), EnvironmentError);  // a parameter that is not there
}

TEST_F(SqliteHandle, ErrorsFallIntoTheTwoKinds) {
  for (const int code : {SQLITE_NOTADB, SQLITE_CORRUPT, SQLITE_CONSTRAINT_TRIGGER, SQLITE_MISMATCH}) {
    EXPECT_THROW(sql::raise(nullptr, code, "testing"), InputError) << code;
  }
  for (const int code : {SQLITE_CANTOPEN, SQLITE_READONLY, SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_BUSY, SQLITE_PERM}) {
    EXPECT_THROW(sql::raise(nullptr, code, "testing"), EnvironmentError) << code;
  }
}

TEST_F(SqliteHandle, ATransactionThatIsNotCommittedNeverWas) {
  {
    sql::Transaction transaction(connection_);
    sql::execute(connection_, "INSERT INTO t (i) VALUES (1)");
  }
  EXPECT_EQ(sql::query_integer(connection_, "SELECT count(*) FROM t"), 0);
  {
    sql::Transaction transaction(connection_);
    sql::execute(connection_, "INSERT INTO t (i) VALUES (1)");
    transaction.commit();
  }
  EXPECT_EQ(sql::query_integer(connection_, "SELECT count(*) FROM t"), 1);
  EXPECT_EQ(sql::query_integer(connection_, "SELECT i FROM t WHERE i = 9"), 0);
  EXPECT_EQ(sql::query_text(connection_, "SELECT 'x'"), "x");
}

TEST_F(SqliteHandle, AStatementRunsAgainWithNewValues) {
  sql::Statement insert(connection_, "INSERT INTO t (i) VALUES (?)");
  for (int i = 0; i < 5; ++i) insert.bind(i).run();
  EXPECT_EQ(sql::query_integer(connection_, "SELECT sum(i) FROM t"), 10);
}

}  // namespace
}  // namespace trocar::sqlite_handle_test
