// The database of trainees and attempts: one SQLite file in WAL mode, opened, migrated and repaired on construction.
//
// Opening creates the file and its folder, migrates an older schema (after a backup beside it) and ends attempts that
// died with their process (attempt_recovery.h). synchronous = NORMAL: what is committed survives kill -9; a power cut
// may cost the last commits, never the database. Two programs at once work; writers wait for each other. Thread: one
// Database belongs to one thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trainees/records/attempt_recovery.h"
#include "trainees/store/migrations.h"

struct sqlite3;
struct sqlite3_stmt;

namespace trocar {

/// $XDG_DATA_HOME/trocar/trocar.db, else ~/.local/share/trocar/trocar.db. @throws EnvironmentError without HOME.
std::filesystem::path default_database_path();

/// Schema version of a database that is only looked at: nothing is made, migrated or repaired. Empty when there is
/// none.
/// @throws InputError: not a database of ours. EnvironmentError: cannot be read, a newer schema.
std::optional<int> schema_of_file(const std::filesystem::path& file);

enum class OpenMode : std::uint8_t {
  kCreate,    ///< made when missing
  kExisting,  ///< a missing file is an EnvironmentError, an empty one an InputError
};

class Database {
 public:
  /// @param file path, or ":memory:" for one that vanishes with the object.
  /// @param busy_timeout_ms how long to wait for another program's write.
  /// @param migrations the way to the schema wanted; another than the program's own only in tests.
  /// @throws EnvironmentError: cannot be opened or written, folder not creatable, disk full, busy too long, a newer
  /// schema. @throws InputError: not a database, another program's database, damaged.
  explicit Database(const std::filesystem::path& file, OpenMode mode = OpenMode::kCreate, int busy_timeout_ms = 5000,
                    std::span<const Migration> migrations = shipped_migrations());
  ~Database();
  Database(Database&&) noexcept;

  bool in_memory() const { return file_.empty(); }
  /// Absolute path, empty when in memory.
  const std::filesystem::path& file() const { return file_; }
  int schema_version() const;
  const MigrationReport& migration() const { return migration_; }
  /// Attempts found dead and ended when this object was made.
  const std::vector<RecoveredAttempt>& recovered() const { return recovered_; }

  /// Problems of file, schema, references, hash chain, audit trail, what people wrote and anchor, one line each; empty
  /// when sound.
  std::vector<std::string> check() const;
  /// For who writes, inside the transaction: nothing but this program's own triggers may act on what it writes.
  /// @throws InputError: something else would, by name.
  void require_own_schema();
  /// Head of the audit trail as "POSITION:HASH": noted elsewhere, it shows any later change of what is there now.
  std::string head() const;
  /// Begins a new anchor file where the old one was lost, and says so in the audit trail.
  void renew_anchor();
  /// Consistent copy. What killed programs left of backups beside the database goes. @throws InputError when `to`
  /// exists, EnvironmentError when it cannot be written, DiskFull when there is no room for it.
  void backup(const std::filesystem::path& to) const;

  sqlite3* connection() const { return connection_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  void open(OpenMode mode, int busy_timeout_ms);
  void enter_wal(int busy_timeout_ms);
  void anchor_beginning();
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> connection_;
  std::span<const Migration> migrations_;
  std::unique_ptr<sqlite3_stmt, Finalize> witness_;  ///< prepared anew by SQLite whenever it has read the schema anew
  int own_schema_ = -1;                              ///< how often it was when the schema was looked at last
  MigrationReport migration_;
  std::vector<RecoveredAttempt> recovered_;
};

}  // namespace trocar
