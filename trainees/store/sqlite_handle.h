// SQLite's C interface behind RAII: statements, transactions, errors. Internal to trainees/.
//
// Every failure becomes an exception that names the database: InputError for what the file or the data are (not a
// database, damaged, constraint), EnvironmentError for what the machine refuses (cannot open, read-only, full, busy).
// Thread: one connection belongs to one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace trocar::sql {

/// SQLite's result `code` says that the disk has no room left, by its own word or by the system's.
bool disk_full(sqlite3* connection, int code);

/// Throws the exception that stands for SQLite's result `code` on `connection` (which may be null).
[[noreturn]] void raise(sqlite3* connection, int code, std::string_view doing);

/// Runs statements that return nothing of interest.
void execute(sqlite3* connection, const char* sql);

class StatementCache;

/// Prepared, or taken from the connection's kept ones (statement_cache.h); reset and given back at the end of its
/// scope.
class Statement {
 public:
  Statement(sqlite3* connection, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // Binds the next parameter; NaN and empty optionals are stored as NULL.
  Statement& bind(std::int64_t value);
  Statement& bind(int value) { return bind(static_cast<std::int64_t>(value)); }
  Statement& bind(bool value) { return bind(static_cast<std::int64_t>(value)); }
  Statement& bind(std::uint64_t value) { return bind(static_cast<std::int64_t>(value)); }
  Statement& bind(double value);
  Statement& bind(const std::optional<double>& value);
  Statement& bind(std::string_view value);
  Statement& bind(const std::string& value) { return bind(std::string_view(value)); }
  Statement& bind(const char* value) { return bind(std::string_view(value)); }
  Statement& bind_null();

  /// Advances to the next row. @returns false when there is none.
  bool step();
  /// Runs to the end and makes the statement ready for new parameters.
  void run();

  enum class Kind : std::uint8_t { kNull, kInteger, kReal, kText };

  int columns() const;
  std::string name(int column) const;
  Kind kind(int column) const;
  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL reads as NaN
  std::optional<double> optional_real(int column) const;
  std::string text(int column) const;       ///< NULL reads as ""
  std::string_view view(int column) const;  ///< the same, good until the next step
  /// The value with its type, for hashing: n; i<decimal>; r<16 hex digits of the bits>; t<length>:<bytes>.
  std::string canonical(int column) const;
  void append_canonical(int column, std::string& to) const;

 private:
  void check(int code);

  sqlite3* connection_;
  std::shared_ptr<StatementCache> cache_;
  sqlite3_stmt* statement_ = nullptr;
  int next_parameter_ = 1;
  bool done_ = false;  ///< the last step found no further row
};

/// The single integer that a query gives.
std::int64_t query_integer(sqlite3* connection, std::string_view sql);
std::string query_text(sqlite3* connection, std::string_view sql);
/// Number of the row that this connection inserted last. RETURNING tells it too, by way of a table of its own.
std::int64_t newest_row(sqlite3* connection);
/// Rows that this connection has changed since it was opened.
std::int64_t changes_of(sqlite3* connection);

/// BEGIN IMMEDIATE; rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(sqlite3* connection);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  sqlite3* connection_;
  bool open_ = true;
};

/// All reads while it lives see one state of the database; nothing is to be written meanwhile. Statements cost less so:
/// each by itself takes the lock, and looks whether anybody has written. Within another's transaction it is that one's.
class ReadSnapshot {
 public:
  explicit ReadSnapshot(sqlite3* connection);
  ~ReadSnapshot();
  ReadSnapshot(const ReadSnapshot&) = delete;
  ReadSnapshot& operator=(const ReadSnapshot&) = delete;

 private:
  sqlite3* connection_;
  bool own_;
};

}  // namespace trocar::sql
