#include "app/commands/open_database.h"

#include <ostream>

namespace trocar {

Database open_database(const std::filesystem::path& file, OpenMode mode, std::ostream& err) {
  Database database(file.empty() ? default_database_path() : file, mode);
  const MigrationReport& migration = database.migration();
  if (!migration.backup.empty()) {
    err << database.file().string() << ": migrated from schema " << migration.from << " to " << migration.to
        << "; the old database is kept as " << migration.backup.string() << '\n';
  }
  for (const RecoveredAttempt& attempt : database.recovered()) {
    err << "attempt " << attempt.uuid << " of " << attempt.trainee << " was cut off and is now marked as aborted; "
        << (attempt.recording.empty() ? "it left no recording"
                                      : "its recording is readable: " + attempt.recording.string())
        << '\n';
  }
  return database;
}

}  // namespace trocar
