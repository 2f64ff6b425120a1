#include "trainees/migrations.h"

#include <sqlite3.h>

#include <memory>
#include <system_error>

#include "haptics/input_error.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

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
  if (id == kApplicationId || (id == 0 && empty)) return;
  throw InputError(name_of(file) + ": is a database of another program");
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

void apply(sqlite3* connection, std::span<const Migration> migrations) {
  sql::Transaction transaction(connection);
  // Another program may have migrated since we looked: the version is read again under the lock.
  const int present = schema_version(connection);
  for (const Migration& migration : migrations) {
    if (migration.version > present) sql::execute(connection, migration.sql);
  }
  if (!sql::query_text(connection, "SELECT \"table\" FROM pragma_foreign_key_check").empty()) {
    throw InputError("database: migrating would break references between its tables; it was left as it was");
  }
  sql::execute(connection, ("PRAGMA user_version = " + std::to_string(migrations.back().version)).c_str());
  sql::execute(connection, ("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  transaction.commit();
}

}  // namespace

std::span<const Migration> shipped_migrations() {
  static const Migration kMigrations[] = {{1, kSchemaV1}};
  return kMigrations;
}

MigrationReport migrate(sqlite3* connection, const fs::path& file, std::span<const Migration> migrations) {
  check_owner(connection, file);
  MigrationReport report;
  report.from = schema_version(connection);
  report.to = migrations.back().version;
  if (report.from > report.to) {
    throw InputError(name_of(file) + ": was written by a newer trocar (schema " + std::to_string(report.from) +
                     ", this program knows up to " + std::to_string(report.to) + ")");
  }
  if (report.from == report.to) return report;
  if (report.from > 0 && !file.empty()) {
    report.backup = backup_name(file, report.from);
    copy_database(connection, report.backup);
  }
  apply(connection, migrations);
  return report;
}

void copy_database(sqlite3* from, const fs::path& to) {
  if (fs::exists(to)) throw InputError(to.string() + ": exists already; a backup never overwrites");
  fs::path part = to;
  part += ".part";
  std::error_code ignored;
  fs::remove(part, ignored);
  sqlite3* raw = nullptr;
  int code = sqlite3_open_v2(part.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  Connection target(raw);
  if (code == SQLITE_OK) {
    sqlite3_backup* backup = sqlite3_backup_init(target.get(), "main", from, "main");
    if (backup != nullptr) sqlite3_backup_step(backup, -1);
    code = backup != nullptr ? sqlite3_backup_finish(backup) : sqlite3_errcode(target.get());
  }
  const std::string detail = sqlite3_errmsg(target.get());
  target.reset();
  std::error_code error;
  if (code == SQLITE_OK) fs::rename(part, to, error);
  if (code == SQLITE_OK && !error) return;
  fs::remove(part, ignored);
  throw EnvironmentError(to.string() + ": the backup cannot be written: " + (error ? error.message() : detail));
}

}  // namespace trocar
