#include "trainees/store/database.h"

#include <sqlite3.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/cap_rows.h"
#include "trainees/store/record_files.h"
#include "trainees/store/sqlite_handle.h"
#include "trainees/store/statement_cache.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& file) {
  if (!make_owner_folders(file.parent_path()))
    throw EnvironmentError(file.string() + ": its folder cannot be created: " + std::strerror(errno));
}

/// A file that is something else is not touched. SQLite itself takes one of a few bytes for an empty database and
/// writes over it; a longer one it refuses. The file is not opened here: closing it would drop the locks (POSIX) of
/// every connection that this program has to it, and the next program would take itself for the only one and remove the
/// log that they write to.
void require_no_other_content(const fs::path& file) {
  constexpr std::uintmax_t kLeastPage = 512;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size == 0 || size >= kLeastPage) return;
  throw InputError(file.string() + ": is not a database");
}

/// What is only to be read or added to must be one already: nothing else is made into one.
void require_content(const fs::path& file) {
  if (!fs::exists(file))
    throw EnvironmentError(file.string() + ": there is no database yet; the first attempt or trainee makes it");
  std::error_code error;
  if (fs::is_regular_file(file, error) && fs::file_size(file, error) == 0 && !error)
    throw InputError(file.string() + ": is empty, no database; it was left as it is");
}

/// Gives back the room that a migration freed. Where that is not possible now (another program reads, no room for the
/// copy), it stays in the file and later attempts use it.
bool compacted(sqlite3* connection) {
  return sqlite3_exec(connection, "VACUUM", nullptr, nullptr, nullptr) == SQLITE_OK;
}

// Rows that say by their number alone whose they are (schema.cpp).
constexpr const char* kStrays = R"sql(
SELECT 'event_row', min(id), 'attempt or event_kind' FROM event_row r WHERE NOT EXISTS (SELECT 1 FROM attempt WHERE id = r.id >> 20)
  OR NOT EXISTS (SELECT 1 FROM event_kind WHERE id = r.kind_id) GROUP BY id >> 20
UNION ALL SELECT 'device_transition_row', min(id), 'attempt or device_change' FROM device_transition_row r
  WHERE NOT EXISTS (SELECT 1 FROM attempt WHERE id = r.id >> 20) OR NOT EXISTS (SELECT 1 FROM device_change WHERE id = r.change_id)
  GROUP BY id >> 20
UNION ALL SELECT 'metric_row', min(id), 'score or metric_kind' FROM metric_row r
  WHERE NOT EXISTS (SELECT 1 FROM score WHERE id = r.id >> 10) OR NOT EXISTS (SELECT 1 FROM metric_kind WHERE id = r.id & 1023)
  GROUP BY id >> 10
UNION ALL SELECT 'subscore_row', min(id), 'score or subscore_kind' FROM subscore_row r
  WHERE NOT EXISTS (SELECT 1 FROM score WHERE id = r.id >> 10) OR NOT EXISTS (SELECT 1 FROM subscore_kind WHERE id = r.kind_id)
  GROUP BY id >> 10
)sql";

}  // namespace

fs::path default_database_path() {
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && fs::path(data).is_absolute()) return fs::path(data) / "trocar" / "trocar.db";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') throw EnvironmentError("no place for the database: set HOME or give --db FILE");
  return fs::path(home) / ".local" / "share" / "trocar" / "trocar.db";
}

std::optional<int> schema_of_file(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> connection(raw, sqlite3_close_v2);
  if (code != SQLITE_OK) throw EnvironmentError(file.string() + ": cannot be opened: " + sqlite3_errstr(code));
  require_ours(raw, file, shipped_migrations());
  return static_cast<int>(sql::query_integer(raw, "PRAGMA user_version"));
}

void Database::Close::operator()(sqlite3* connection) const { sql::close_connection(connection); }

Database::Database(const fs::path& file, OpenMode mode, int busy_timeout_ms, std::span<const Migration> migrations)
    : migrations_(migrations) {
  if (file != ":memory:") file_ = fs::absolute(file).lexically_normal();
  open(mode, busy_timeout_ms);
  sqlite3_busy_timeout(connection_.get(), busy_timeout_ms);
  if (mode == OpenMode::kExisting && !in_memory() && schema_version() == 0) {
    require_ours(connection_.get(), file_, migrations_);
    throw InputError(file_.string() + ": holds no tables, no database of trocar; it was left as it is");
  }
  migration_ = migrate(connection_.get(), file_, migrations_);
  if (!migration_.backup.empty()) migration_.compacted = compacted(connection_.get());
  if (!in_memory()) enter_wal(busy_timeout_ms);
  for (const fs::path& open : record_files_open_to_others(file_)) close_to_others(open);
  // The log is copied back every 8000 pages (32 MB), not every 1000: a commit that has to do it waits for the disk.
  sql::execute(connection_.get(),
               "PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON; PRAGMA wal_autocheckpoint = 8000;"
               "PRAGMA secure_delete = ON");  // what an erasure takes away is overwritten
  sql::keep_statements(connection_.get());
  add_cap_sentence(connection_.get());
  add_row_holds(connection_.get());
  anchor_beginning();
  // The schema is looked at only where there is something to end.
  if (sql::query_integer(connection_.get(), "SELECT EXISTS (SELECT 1 FROM attempt WHERE status = 'running')") != 0 &&
      meddling_schema(connection_.get(), migrations_).empty())
    recovered_ = recover_dead_attempts(connection_.get(), file_);
  if (!recovered_.empty()) append_anchor(file_, audit_head(connection_.get()));
}

Database::~Database() = default;
Database::Database(Database&&) noexcept = default;

void Database::open(OpenMode mode, int busy_timeout_ms) {
  if (!in_memory() && mode == OpenMode::kExisting) require_content(file_);
  if (!in_memory()) require_no_other_content(file_);
  if (!in_memory() && mode == OpenMode::kCreate) {
    make_folder(file_);
    make_owner_file(file_);  // there already, or in vain: SQLite says why. Its log gets the same rights
  }
  sqlite3* raw = nullptr;
  const std::string name = in_memory() ? ":memory:" : file_.string();
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;  // one thread (header)
  const int code = sqlite3_open_v2(name.c_str(), &raw, flags, nullptr);
  connection_.reset(raw);
  if (code != SQLITE_OK) throw EnvironmentError(name + ": cannot be opened: " + sqlite3_errstr(code));
  sqlite3_busy_timeout(raw, busy_timeout_ms);
  if (sqlite3_db_readonly(raw, "main") == 1) throw EnvironmentError(name + ": is not writable");
}

void Database::enter_wal(int busy_timeout_ms) {
  // Switching needs the file alone and does not always wait by itself; another program may be switching right now.
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::milliseconds(busy_timeout_ms);
  while (sql::query_text(connection_.get(), "PRAGMA journal_mode") != "wal") {
    const int code = sqlite3_exec(connection_.get(), "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
    const bool busy = (code & 0xFF) == SQLITE_BUSY || (code & 0xFF) == SQLITE_LOCKED;
    if (code != SQLITE_OK && (!busy || Clock::now() > give_up)) {
      sql::raise(connection_.get(), code, "cannot switch to a write-ahead log");
    }
    if (code == SQLITE_OK && sql::query_text(connection_.get(), "PRAGMA journal_mode") != "wal") {
      throw EnvironmentError(file_.string() + ": this file system allows no write-ahead log");
    }
    if (busy) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void Database::anchor_beginning() {
  // A missing file is made only where nothing could have been lost with it; otherwise check() must see that it is gone.
  const AuditHead head = audit_head(connection_.get());
  if (head.position == 1 && !in_memory() && !fs::exists(anchor_path(file_))) append_anchor(file_, head);
}

void Database::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Database::require_own_schema() {
  if (!trail_goes_on(connection_.get()))
    throw InputError(file_.string() +
                     ": nothing is written to it: its audit trail no longer holds what this program"
                     " saw of it; start anew, and see trocar db check");
  // What acts is what SQLite has read into memory, which need not be what the file says now, nor what its number says.
  // It prepares a statement anew whenever it has read the schema anew, and counts how often.
  const auto times_read = [this] {
    const int code = sqlite3_step(witness_.get());
    sqlite3_reset(witness_.get());
    if (code != SQLITE_ROW) sql::raise(connection_.get(), code, "cannot read the schema");
    return sqlite3_stmt_status(witness_.get(), SQLITE_STMTSTATUS_REPREPARE, 0);
  };
  if (!witness_) {
    sqlite3_stmt* raw = nullptr;
    const int code = sqlite3_prepare_v2(connection_.get(), "SELECT count(*) FROM sqlite_schema", -1, &raw, nullptr);
    witness_.reset(raw);
    if (code != SQLITE_OK) sql::raise(connection_.get(), code, "cannot read the schema");
  } else if (own_schema_ >= 0 && times_read() == own_schema_) {
    return;
  }
  own_schema_ = -1;
  sql::execute(connection_.get(), "PRAGMA writable_schema = RESET");  // memory is what the file says from here on
  if (const std::string other = meddling_schema(connection_.get(), migrations_); !other.empty())
    throw InputError(file_.string() + ": nothing is written to it: " + other +
                     ", and would act on what is written (trocar db check names all that was altered)");
  own_schema_ = times_read();
}

std::string Database::head() const {
  const AuditHead head = audit_head(connection_.get());
  return std::to_string(head.position) + ":" + head.row_hash;
}

void Database::renew_anchor() {
  sql::Transaction transaction(connection_.get());
  require_own_schema();
  append_audit(connection_.get(), kActionRenewed, "", "");
  transaction.commit();
  std::error_code ignored;
  fs::remove(anchor_path(file_), ignored);
  append_anchor(file_, audit_head(connection_.get()));
}

int Database::schema_version() const {
  return static_cast<int>(sql::query_integer(connection_.get(), "PRAGMA user_version"));
}

std::vector<std::string> Database::check() const {
  std::vector<std::string> problems;
  sql::Statement integrity(connection_.get(), "PRAGMA integrity_check");
  while (integrity.step()) {
    if (integrity.text(0) != "ok") problems.push_back("integrity: " + integrity.text(0));
  }
  const auto add_reference = [&](const std::string& table, const std::string& row, const std::string& to) {
    problems.push_back("reference: row " + row + " of " + table + " points to nothing in " + to);
  };
  sql::Statement references(connection_.get(), "PRAGMA foreign_key_check");
  while (references.step()) add_reference(references.text(0), references.text(1), references.text(2));
  sql::Statement strays(connection_.get(), kStrays);
  while (strays.step()) add_reference(strays.text(0), strays.text(1), strays.text(2));
  const auto add = [&](const char* what, const std::vector<std::string>& found) {
    for (const std::string& problem : found) problems.push_back(what + problem);
  };
  add("schema: ", check_schema(connection_.get(), migrations_));
  add("hash chain: ", check_chain(connection_.get()));
  add("audit trail: ", check_audit(connection_.get()));
  add("records: ", check_sealed_rows(connection_.get()));
  add("records: ", check_kept_rows(connection_.get()));
  add("anchor: ", check_anchor(file_, connection_.get()));
  return problems;
}

void Database::backup(const fs::path& to) const {
  for (const fs::path& beside : {anchor_path(to), key_path(to)})
    if (fs::exists(fs::symlink_status(beside)))
      throw InputError(beside.string() + ": exists already; a backup never overwrites");
  make_folder(fs::absolute(to));
  if (!in_memory()) remove_abandoned_copies(file_);
  const auto anchor = read_anchor(file_);  // before the copy: what it holds is in the copy for certain
  copy_database(connection_.get(), to);
  try {
    write_anchor(to, anchor);
    if (const auto key = station_key(file_)) write_station_key(to, *key);  // what is put back goes on being signed
  } catch (const std::exception&) {
    for (const fs::path& begun : {to, anchor_path(to), key_path(to)}) {
      std::error_code ignored;
      fs::remove(begun, ignored);
    }
    throw;
  }
}

}  // namespace trocar
