// A copy of a whole record: database, anchor and recordings, each for its owner alone. It is a record of its own and
// passes the check by itself. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

enum class BackedUp : std::uint8_t { kWithRecordings, kWithoutRecordings };

struct BackupReport {
  std::filesystem::path recordings = {};            ///< folder of the copy; empty without any
  std::size_t files = 0;                            ///< recordings copied
  std::uintmax_t bytes = 0;                         ///< of them
  std::vector<std::filesystem::path> missing = {};  ///< named by an attempt, but not there any more
};

/// Recordings that attempts name and that are there, in bytes.
std::uintmax_t recordings_size(const Database& database);

/// The recordings lie beside the copy as they do beside the record: NAME.recordings. All or nothing: what was begun is
/// taken away again.
/// @throws InputError when `to` or its folder of recordings exists, DiskFull: no room, EnvironmentError: cannot be
/// written.
BackupReport back_up(const Database& database, const std::filesystem::path& to, BackedUp what);

}  // namespace trocar
