#include "app/cli/records/open_database.h"

#include <cstdlib>
#include <ostream>

#include "trainees/integrity/station_key.h"
#include "trainees/store/record_files.h"

namespace trocar {

Author author_said(const std::string& name) {
  if (!name.empty()) return {"", name};
  const char* user = std::getenv("USER");
  return {"", user != nullptr && *user != '\0' ? user : "instructor"};
}

Database open_database(const std::filesystem::path& file, OpenMode mode, std::ostream& err) {
  constexpr int kBusy_ms = 5000;
  const std::filesystem::path path = file.empty() ? default_database_path() : file;
  const std::size_t open_before = record_files_open_to_others(path == ":memory:" ? "" : path).size();
  Database database(path, mode, kBusy_ms);
  if (open_before > record_files_open_to_others(database.file()).size())
    err << database.file().string() << ": " << open_before
        << " of its files and folders could be opened by other users of this machine; from now on its owner alone "
           "can\n";
  const MigrationReport& migration = database.migration();
  if (!migration.backup.empty()) {
    err << database.file().string() << ": migrated from schema " << migration.from << " to " << migration.to
        << "; the old database is kept as " << migration.backup.string() << '\n';
    if (!migration.compacted)
      err << database.file().string() << ": its file keeps its size for now; new attempts use the room in it\n";
  }
  if (const std::string lost = lost_key(database.connection()); !lost.empty())
    err << database.file().string() << ": " << lost << '\n';
  for (const RecoveredAttempt& attempt : database.recovered()) {
    err << "attempt " << attempt.uuid << " of " << attempt.trainee << " was cut off and is now marked as aborted; "
        << (attempt.recording.empty() ? "it left no recording"
                                      : "what it recorded is kept: " + attempt.recording.string())
        << '\n';
  }
  return database;
}

}  // namespace trocar
