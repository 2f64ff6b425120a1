// `trocar sync`: a station's record to the central database and back, or everything of all stations into a file for a desk.
// InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct SyncOptions {
  std::filesystem::path database;       ///< empty: the default path
  std::filesystem::path password_file{};
  std::string to{}, from{};             ///< one of them: address of the central database
  std::string station{};                ///< name under which this station is known; empty: as it was
  bool new_station = false;
  bool with_identity = false;
  bool apply_erasures = false;
  bool json = false;
};

/// @return exit code: 0 done; 1 conflicts, or rows that do not hold: the rest was done, the names are part of the result.
int sync_command(const SyncOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
