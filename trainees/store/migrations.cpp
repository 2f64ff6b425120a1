#include "trainees/store/migrations.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <system_error>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/station_key.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/schema.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstSigned = 2;
constexpr const char* kSignatures = "ALTER TABLE audit ADD COLUMN signature TEXT NOT NULL DEFAULT ''";

struct Close {
  void operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }
};
using Connection = std::unique_ptr<sqlite3, Close>;

int schema_version(sqlite3* connection) {
  return static_cast<int>(sql::query_integer(connection, "PRAGMA user_version"));
}

std::string name_of(const fs::path& file) { return file.empty() ? "database" : file.string(); }

void check_owner(sqlite3* connection, const fs::path& file) {
  // Tables first: another program may be making the database right now, and commits tables and id together. Once tables
  // are seen, so is its id; the other order could see no id yet, and then the tables.
  const bool empty = sql::query_integer(connection, "SELECT count(*) FROM sqlite_schema") == 0;
  const auto id = sql::query_integer(connection, "PRAGMA application_id");
  if (id != kApplicationId && !(id == 0 && empty))
    throw InputError(name_of(file) + ": is a database of another program");
  // In another encoding bytes that no text has can hide a signed entry from every query, and its hash stays.
  if (const std::string encoding = sql::query_text(connection, "PRAGMA encoding"); encoding != "UTF-8")
    throw InputError(name_of(file) + ": holds its texts as " + encoding +
                     ", as no trocar writes them: it was rewritten");
}

/// trocar.db -> trocar.db.schema1.backup, or .schema1-2.backup when that exists.
fs::path backup_name(const fs::path& file, int version) {
  fs::path name = file;
  name += ".schema" + std::to_string(version) + ".backup";
  for (int n = 2; fs::exists(name); ++n) {
    name = file;
    name += ".schema" + std::to_string(version) + "-" + std::to_string(n) + ".backup";
  }
  return name;
}

/// @param from the version that the whole way began at.
void apply(sqlite3* connection, std::span<const Migration> migrations, int from) {
  sql::Transaction transaction(connection);
  // Another program may have migrated since we looked: the version is read again under the lock.
  const int present = schema_version(connection);
  for (const Migration& migration : migrations) {
    if (migration.version <= present) continue;
    sql::execute(connection, migration.sql);
  }
  const Migration& last = migrations.back();
  if (last.version > present && last.after != nullptr) last.after(connection, from, last.version);
  if (!sql::query_text(connection, "SELECT \"table\" FROM pragma_foreign_key_check").empty()) {
    throw InputError("database: migrating would break references between its tables; it was left as it was");
  }
  sql::execute(connection, ("PRAGMA user_version = " + std::to_string(last.version)).c_str());
  sql::execute(connection, ("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  transaction.commit();
}

std::vector<std::string> table_names(sqlite3* connection) {
  std::vector<std::string> names;
  sql::Statement rows(connection, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  while (rows.step()) names.push_back(rows.text(0));
  return names;
}

/// A backup that is not whole must be found now, not when it is needed.
void verify_copy(sqlite3* original, const fs::path& copy) {
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(copy.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr);
  const Connection opened(raw);
  bool whole = code == SQLITE_OK && schema_version(raw) == schema_version(original) &&
               sql::query_text(raw, "PRAGMA integrity_check") == "ok";
  for (const std::string& table : table_names(original)) {
    const std::string count = "SELECT count(*) FROM \"" + table + "\"";
    whole = whole && sql::query_integer(raw, count) == sql::query_integer(original, count);
  }
  if (!whole) throw EnvironmentError(copy.string() + ": the backup is not whole; the database was not migrated");
}

/// Held by who writes it for as long as it is open, as no other program may then; who is killed lets go.
class HeldFile {
 public:
  explicit HeldFile(const fs::path& file)
      : file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {
    held_ = file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0;
  }
  ~HeldFile() {
    if (file_ >= 0) ::close(file_);
  }
  HeldFile(const HeldFile&) = delete;
  HeldFile& operator=(const HeldFile&) = delete;
  bool held() const { return held_; }

 private:
  int file_;
  bool held_ = false;
};

/// A copy that was begun, and whose writer is gone. @returns false: it is being written, or is not ours to touch.
bool remove_abandoned(const fs::path& part) {
  const HeldFile mine(part);
  if (!mine.held()) return false;
  std::error_code ignored;
  fs::remove(part.string() + "-journal", ignored);
  return fs::remove(part, ignored);
}

/// Everything that a schema is made of, by type and name; SQLite's own statistics are no part of it.
std::map<std::string, std::string> schema_of(sqlite3* connection) {
  std::map<std::string, std::string> parts;
  sql::Statement rows(connection,
                      "SELECT type, name, sql FROM sqlite_schema WHERE type <> 'table' OR name NOT IN ('sqlite_stat1', "
                      "'sqlite_stat4')");
  while (rows.step()) parts[rows.text(0) + " " + rows.text(1)] = rows.text(2);
  return parts;
}

std::map<std::string, std::string> schema_made_by(std::span<const Migration> migrations) {
  sqlite3* raw = nullptr;
  sqlite3_open(":memory:", &raw);
  const Connection fresh(raw);
  migrate(raw, "", migrations);
  return schema_of(raw);
}

/// What these migrations make; that of the program's own is made once.
std::map<std::string, std::string> wanted_schema(std::span<const Migration> migrations) {
  if (migrations.data() != shipped_migrations().data() || migrations.size() != shipped_migrations().size())
    return schema_made_by(migrations);
  static const std::map<std::string, std::string> kShipped = schema_made_by(shipped_migrations());
  return kShipped;
}

}  // namespace

std::span<const Migration> shipped_migrations() {
  static const Migration kMigrations[] = {{1, schema_sql(), note_migration},
                                          {2, kSignatures, note_migration},
                                          {3, programme_schema_sql(), note_migration},
                                          {4, running_rows_schema_sql(), note_migration},
                                          {5, endings_schema_sql(), note_migration}};
  return kMigrations;
}

void note_migration(sqlite3* connection, int from, int to) {
  const std::string wanted = std::to_string(to);
  const fs::path file = sqlite3_db_filename(connection, "main");
  if (from >= kFirstSigned && !file.empty() && announced_keys(connection).empty())
    throw InputError(name_of(file) + ": is of schema " + std::to_string(from) +
                     ", and no entry names the station's key, as the first of each such record does: it was taken"
                     " away; the database was left as it was");
  const bool lay_there = from > 0 && from < kFirstSigned && !file.empty() && fs::exists(key_path(file));
  const std::string key = file.empty() ? "" : make_station_key(file).public_key();
  if (from == 0) return append_audit(connection, kActionMade, "schema " + wanted, key);
  const std::string attempts = std::to_string(sql::query_integer(connection, "SELECT count(*) FROM attempt"));
  const std::string head = sql::query_text(
      connection, "SELECT row_hash FROM attempt WHERE row_hash IS NOT NULL ORDER BY chain_position DESC LIMIT 1");
  append_audit(connection, kActionMigrated, "schema " + std::to_string(from) + " to " + wanted,
               attempts + " attempts, head " + (head.empty() ? "none" : head) + (lay_there ? kKeyLayThere : ""));
  if (announced_keys(connection).empty() && !key.empty()) append_audit(connection, kActionKey, kActionKey, key);
}

std::string meddling_schema(sqlite3* connection, std::span<const Migration> migrations) {
  const auto wanted = wanted_schema(migrations);
  for (const auto& [part, text] : schema_of(connection)) {
    const auto own = wanted.find(part);
    const bool acts = part.starts_with("trigger ") || part.starts_with("index ");
    if (own == wanted.end() ? acts : own->second != text)
      return part + (own == wanted.end() ? " does not belong there" : " was altered");
  }
  return "";
}

std::vector<std::string> check_schema(sqlite3* connection, std::span<const Migration> migrations) {
  const auto found = schema_of(connection);
  const auto wanted = wanted_schema(migrations);
  std::vector<std::string> problems;
  for (const auto& [part, text] : wanted) {
    const auto present = found.find(part);
    if (present == found.end())
      problems.push_back(part + " is missing");
    else if (present->second != text)
      problems.push_back(part + " was altered");
  }
  for (const auto& [part, text] : found) {
    if (!wanted.contains(part)) problems.push_back(part + " does not belong here");
  }
  return problems;
}

void require_ours(sqlite3* connection, const fs::path& file, std::span<const Migration> migrations) {
  check_owner(connection, file);
  const int present = schema_version(connection), known = migrations.back().version;
  if (present <= known) return;
  throw EnvironmentError(name_of(file) + ": was written by a newer trocar (schema " + std::to_string(present) +
                         ", this program knows up to " + std::to_string(known) + "); it was left as it is");
}

MigrationReport migrate(sqlite3* connection, const fs::path& file, std::span<const Migration> migrations) {
  require_ours(connection, file, migrations);
  MigrationReport report;
  report.from = schema_version(connection);
  report.to = migrations.back().version;
  if (report.from == report.to) return report;
  if (report.from > 0 && !file.empty()) {
    report.backup = backup_name(file, report.from);
    copy_database(connection, report.backup);
    verify_copy(connection, report.backup);
  }
  apply(connection, migrations, report.from);
  return report;
}

void copy_database(sqlite3* from, const fs::path& to) {
  if (fs::exists(to)) throw InputError(to.string() + ": exists already; a backup never overwrites");
  fs::path part = to;
  part += ".part";
  remove_abandoned(part);
  if (!make_owner_file(part)) {
    if (is_disk_full(errno)) throw DiskFull(no_room_for_backup(to));
    throw EnvironmentError(to.string() + ": the backup cannot be written: " + std::strerror(errno));
  }
  const HeldFile held(part);
  sqlite3* raw = nullptr;
  int code = sqlite3_open_v2(part.c_str(), &raw, SQLITE_OPEN_READWRITE, nullptr);
  Connection target(raw);
  if (code == SQLITE_OK) {
    sqlite3_backup* backup = sqlite3_backup_init(target.get(), "main", from, "main");
    if (backup != nullptr) sqlite3_backup_step(backup, -1);
    code = backup != nullptr ? sqlite3_backup_finish(backup) : sqlite3_errcode(target.get());
    // One file by itself, which can be read where nothing can be written: without this it would want a log beside it.
    if (code == SQLITE_OK) code = sqlite3_exec(target.get(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  }
  const std::string detail = sqlite3_errmsg(target.get());
  const bool full = code != SQLITE_OK && sql::disk_full(target.get(), code);
  target.reset();
  std::error_code error;
  if (code == SQLITE_OK) fs::rename(part, to, error);
  if (code == SQLITE_OK && !error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  if (full || is_disk_full(error.value())) throw DiskFull(no_room_for_backup(to));
  throw EnvironmentError(to.string() + ": the backup cannot be written: " + (error ? error.message() : detail));
}

void remove_abandoned_copies(const fs::path& file) {
  std::error_code error;
  const std::string begin = file.filename().string() + ".";
  std::vector<fs::path> parts;
  for (fs::directory_iterator it(file.parent_path(), error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(begin) && name.ends_with(".backup.part")) parts.push_back(it->path());
  }
  for (const fs::path& part : parts) remove_abandoned(part);
}

}  // namespace trocar
