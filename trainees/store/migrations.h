// Schema versions of the database and the way from one to the next. Internal to trainees/ and its tests.
//
// PRAGMA user_version holds the schema version, PRAGMA application_id marks the file as ours. A migration is SQL that
// leads from version-1 to version; an older database is copied beside itself, and the copy proved whole, before the
// first step. All steps are one transaction: whatever interrupts them, the old database is what is found.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

struct sqlite3;

namespace trocar {

inline constexpr int kApplicationId = 0x54524352;  // "TRCR"

struct Migration {
  int version;  ///< the schema version that it leads to; 1, 2, 3, ...
  const char* sql;
  /// Called in the same transaction when the way ends with this step.
  void (*after)(sqlite3* connection, int from, int to) = nullptr;
};

/// Migrations of this program, in order.
std::span<const Migration> shipped_migrations();

/// An entry of the audit trail: what was there before, and the head of its chain. @param from 0: the database was made.
void note_migration(sqlite3* connection, int from, int to);

struct MigrationReport {
  int from = 0, to = 0;          ///< equal when nothing was to do; from is 0 for a new database
  std::filesystem::path backup;  ///< copy made before migrating; empty for a new database or when nothing was done
  bool compacted = false;        ///< the file was made as small as its content
};

/// @throws InputError: another application's database. EnvironmentError: a schema newer than `migrations` know.
void require_ours(sqlite3* connection, const std::filesystem::path& file, std::span<const Migration> migrations);

/// Brings the database to the newest version of `migrations`, all steps in one transaction.
/// @param file the database's file, empty when in memory (no backup then).
/// @throws InputError: another application's database. EnvironmentError: a schema newer than this program knows, the
/// backup cannot be written or is not whole. The database is untouched then.
MigrationReport migrate(sqlite3* connection, const std::filesystem::path& file, std::span<const Migration> migrations);

/// Copies the whole database, consistent even while others write, for its owner's eyes only. @throws InputError when
/// `to` exists already, EnvironmentError when it cannot be written, DiskFull when there is no room for it.
void copy_database(sqlite3* from, const std::filesystem::path& to);

/// Beside the database: what killed programs left of backups, "NAME.*.backup.part". What is being written stays.
void remove_abandoned_copies(const std::filesystem::path& file);

/// Where the schema of the database is not that of `migrations`: tables, indices, triggers, views; one line each.
std::vector<std::string> check_schema(sqlite3* connection, std::span<const Migration> migrations);

/// What in the schema would act on rows in another way than this program means, "" when nothing: a trigger that does
/// not belong there, a trigger, table or view that was altered.
std::string meddling_schema(sqlite3* connection, std::span<const Migration> migrations);

}  // namespace trocar
