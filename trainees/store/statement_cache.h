// Statements that a connection has prepared once and keeps for the next use: a third of an attempt's commit was
// preparing them.
//
// Only connections for which keep_statements() was called have one (Database does); sql::Statement takes from it and
// gives back by itself. A statement that is in use is not in the cache, so the same text may be nested; a changed
// schema is SQLite's own business, which prepares anew. Thread: the connection's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

struct sqlite3;
struct sqlite3_stmt;

namespace trocar::sql {

class StatementCache {
 public:
  static constexpr std::size_t kMostKept = 200;  ///< the one that was unused for longest goes

  ~StatementCache();

  /// Only texts that do nothing before their first step and are not a PRAGMA.
  static bool keeps(std::string_view sql);
  /// @returns one that is ready for parameters, null when none is kept.
  sqlite3_stmt* take(std::string_view sql);
  /// Reset and without parameters.
  void give_back(sqlite3_stmt* statement);
  std::size_t size() const { return idle_.size(); }
  std::uint64_t reused() const { return reused_; }
  /// Nothing is kept any more: the connection is about to be closed.
  void close();

 private:
  struct Idle {
    sqlite3_stmt* statement;
    std::uint64_t used;
  };
  void drop_oldest();

  std::unordered_map<std::string_view, Idle> idle_;  ///< by the text that SQLite holds for the statement
  std::uint64_t uses_ = 0, reused_ = 0;
  bool closed_ = false;
};

/// From now on `connection` keeps its statements. It must be closed by close_connection().
void keep_statements(sqlite3* connection);
/// The connection's cache, null when it keeps none.
std::shared_ptr<StatementCache> statements_of(sqlite3* connection);
/// Lets go of kept statements, then of the connection.
void close_connection(sqlite3* connection);

}  // namespace trocar::sql
