#include "trainees/store/statement_cache.h"

#include <sqlite3.h>

#include <algorithm>

namespace trocar::sql {
namespace {

// SQLite has no place for a user's pointer at a connection before 3.44. The rollback hook has one, nothing else here
// uses it, and it is given back when another is set: so no list of connections has to be kept and locked.
using Held = std::shared_ptr<StatementCache>;

void on_rollback(void*) {}

Held* held_by(sqlite3* connection) {
  void* held = sqlite3_rollback_hook(connection, nullptr, nullptr);
  if (held != nullptr) sqlite3_rollback_hook(connection, on_rollback, held);
  return static_cast<Held*>(held);
}

}  // namespace

StatementCache::~StatementCache() { close(); }

bool StatementCache::keeps(std::string_view sql) {
  constexpr std::string_view kVerbs[] = {"SELECT", "INSERT", "UPDATE", "DELETE", "BEGIN", "COMMIT"};
  return std::any_of(std::begin(kVerbs), std::end(kVerbs),
                     [sql](std::string_view verb) { return sql.starts_with(verb); });
}

sqlite3_stmt* StatementCache::take(std::string_view sql) {
  const auto at = idle_.find(sql);
  if (at == idle_.end()) return nullptr;
  sqlite3_stmt* statement = at->second.statement;
  idle_.erase(at);
  ++reused_;
  return statement;
}

void StatementCache::give_back(sqlite3_stmt* statement) {
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  const char* text = sqlite3_sql(statement);
  if (closed_ || text == nullptr || !idle_.try_emplace(text, Idle{statement, ++uses_}).second) {
    sqlite3_finalize(statement);  // nested: one of a kind is enough
    return;
  }
  if (idle_.size() > kMostKept) drop_oldest();
}

void StatementCache::drop_oldest() {
  const auto oldest = std::min_element(idle_.begin(), idle_.end(),
                                       [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
  sqlite3_stmt* statement = oldest->second.statement;
  idle_.erase(oldest);
  sqlite3_finalize(statement);
}

void StatementCache::close() {
  closed_ = true;
  for (const auto& [text, idle] : idle_) sqlite3_finalize(idle.statement);
  idle_.clear();
}

void keep_statements(sqlite3* connection) {
  if (held_by(connection) == nullptr)
    sqlite3_rollback_hook(connection, on_rollback, new Held(std::make_shared<StatementCache>()));
}

std::shared_ptr<StatementCache> statements_of(sqlite3* connection) {
  const Held* held = connection == nullptr ? nullptr : held_by(connection);
  return held == nullptr ? nullptr : *held;
}

void close_connection(sqlite3* connection) {
  if (connection == nullptr) return;
  if (const std::unique_ptr<Held> held{static_cast<Held*>(sqlite3_rollback_hook(connection, nullptr, nullptr))})
    (*held)->close();
  sqlite3_close_v2(connection);
}

}  // namespace trocar::sql
