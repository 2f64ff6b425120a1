#include "trainees/store/sqlite_handle.h"

#include <sqlite3.h>

#include <bit>
#include <cmath>
#include <limits>

#include "haptics/input_error.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/statement_cache.h"

namespace trocar::sql {
namespace {

std::string database_name(sqlite3* connection) {
  const char* file = connection == nullptr ? nullptr : sqlite3_db_filename(connection, "main");
  return file == nullptr || *file == '\0' ? "database" : file;
}

/// The index of the write-ahead log, a small file beside the database, could not be made: the system's own word is not
/// kept then.
bool index_has_no_room(sqlite3* connection) {
  return connection != nullptr && sqlite3_extended_errcode(connection) == SQLITE_IOERR_SHMSIZE;
}

}  // namespace

bool disk_full(sqlite3* connection, int code) {
  if ((code & 0xFF) == SQLITE_FULL) return true;
  if (code == SQLITE_OK || connection == nullptr) return false;
  return index_has_no_room(connection) || is_disk_full(sqlite3_system_errno(connection));
}

void raise(sqlite3* connection, int code, std::string_view doing) {
  const std::string detail = connection == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(connection);
  const std::string message = database_name(connection) + ": " + std::string(doing) + ": " + detail;
  switch (code & 0xFF) {
    case SQLITE_NOTADB:
      throw InputError(database_name(connection) + ": is not a database");
    case SQLITE_CORRUPT:
    case SQLITE_CONSTRAINT:
    case SQLITE_MISMATCH:
    case SQLITE_TOOBIG:
    case SQLITE_ERROR:
      throw InputError(message);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw EnvironmentError(message + " (another program has held the database too long)");
    default:
      if (disk_full(connection, code))
        throw DiskFull(database_name(connection) + ": " + std::string(doing) + ": the disk is full; make room on it" +
                       (index_has_no_room(connection) ? ", for without some 100 kB it cannot even be read" : ""));
      throw EnvironmentError(message);
  }
}

void execute(sqlite3* connection, const char* sql) {
  if (const int code = sqlite3_exec(connection, sql, nullptr, nullptr, nullptr); code != SQLITE_OK) {
    raise(connection, code, "cannot run a statement");
  }
}

Statement::Statement(sqlite3* connection, std::string_view sql) : connection_(connection) {
  if (StatementCache::keeps(sql)) cache_ = statements_of(connection);
  if (cache_) statement_ = cache_->take(sql);
  if (statement_ != nullptr) return;
  const unsigned flags = cache_ ? SQLITE_PREPARE_PERSISTENT : 0;
  check(sqlite3_prepare_v3(connection, sql.data(), static_cast<int>(sql.size()), flags, &statement_, nullptr));
}

Statement::~Statement() {
  if (cache_ && statement_ != nullptr)
    cache_->give_back(statement_);
  else
    sqlite3_finalize(statement_);
}

void Statement::check(int code) {
  if (code != SQLITE_OK) raise(connection_, code, "cannot run a statement");
}

Statement& Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_, next_parameter_++, value));
  return *this;
}

Statement& Statement::bind(double value) {
  if (std::isnan(value)) return bind_null();
  check(sqlite3_bind_double(statement_, next_parameter_++, value));
  return *this;
}

Statement& Statement::bind(const std::optional<double>& value) { return value ? bind(*value) : bind_null(); }

Statement& Statement::bind(std::string_view value) {
  const char* bytes = value.data() == nullptr ? "" : value.data();
  check(sqlite3_bind_text(statement_, next_parameter_++, bytes, static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null() {
  check(sqlite3_bind_null(statement_, next_parameter_++));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  done_ = code == SQLITE_DONE;
  if (code == SQLITE_ROW) return true;
  if (done_) return false;
  raise(connection_, code, "cannot run a statement");
}

void Statement::run() {
  while (!done_ && step()) {  // a step after the last one would begin again
  }
  check(sqlite3_reset(statement_));
  done_ = false;
  next_parameter_ = 1;
}

int Statement::columns() const { return sqlite3_column_count(statement_); }
std::string Statement::name(int column) const { return sqlite3_column_name(statement_, column); }

Statement::Kind Statement::kind(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_NULL:
      return Kind::kNull;
    case SQLITE_INTEGER:
      return Kind::kInteger;
    case SQLITE_FLOAT:
      return Kind::kReal;
    default:
      return Kind::kText;
  }
}

bool Statement::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_, column); }

double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_, column);
}

std::optional<double> Statement::optional_real(int column) const {
  if (is_null(column)) return std::nullopt;
  return sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const { return std::string(view(column)); }

std::string_view Statement::view(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (bytes == nullptr) return "";
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::string Statement::canonical(int column) const {
  std::string out;
  append_canonical(column, out);
  return out;
}

void Statement::append_canonical(int column, std::string& to) const {
  constexpr char kDigits[] = "0123456789abcdef";
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_NULL:
      to += 'n';
      break;
    case SQLITE_INTEGER:
      (to += 'i') += std::to_string(integer(column));
      break;
    case SQLITE_FLOAT: {
      const auto bits = std::bit_cast<std::uint64_t>(sqlite3_column_double(statement_, column));
      to += 'r';
      for (int shift = 60; shift >= 0; shift -= 4) to += kDigits[bits >> shift & 15];
      break;
    }
    default: {
      const std::string_view value = view(column);
      ((to += 't') += std::to_string(value.size())) += ':';
      to += value;
    }
  }
  to += ';';
}

std::int64_t query_integer(sqlite3* connection, std::string_view sql) {
  Statement statement(connection, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string query_text(sqlite3* connection, std::string_view sql) {
  Statement statement(connection, sql);
  return statement.step() ? statement.text(0) : "";
}

std::int64_t newest_row(sqlite3* connection) { return sqlite3_last_insert_rowid(connection); }
std::int64_t changes_of(sqlite3* connection) { return sqlite3_total_changes64(connection); }

Transaction::Transaction(sqlite3* connection) : connection_(connection) {
  Statement(connection, "BEGIN IMMEDIATE").run();
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(connection_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  Statement(connection_, "COMMIT").run();
  open_ = false;
}

ReadSnapshot::ReadSnapshot(sqlite3* connection)
    : connection_(connection), own_(sqlite3_get_autocommit(connection) != 0) {
  if (own_) Statement(connection, "BEGIN").run();
}

ReadSnapshot::~ReadSnapshot() {
  if (own_) sqlite3_exec(connection_, "ROLLBACK", nullptr, nullptr, nullptr);  // nothing was written
}

}  // namespace trocar::sql
