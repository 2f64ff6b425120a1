// The files of a record: database, log, anchor, backups beside it, recordings, films and live folder. All of them are
// for their owner alone (0600, 0700); an older program left some open to others. Thread: any.
#pragma once

#include <filesystem>
#include <vector>

namespace trocar {

/// Those of this user that others may open: files first, folders after what lies in them. A folder that is closed
/// already is not looked into, for nobody else gets there.
std::vector<std::filesystem::path> record_files_open_to_others(const std::filesystem::path& database);

}  // namespace trocar
