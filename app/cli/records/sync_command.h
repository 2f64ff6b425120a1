// `trocar sync`: a station's record to the central database and back, or everything of all stations into a file for a
// desk. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct SyncOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::filesystem::path password_file{};
  std::string to{}, from{};  ///< one of them: address of the central database
  std::string station{};     ///< name under which this station is known; empty: as it was
  bool new_station = false;
  bool with_identity = false;
  bool apply_erasures = false;
  bool recordings = false;  ///< also the recordings of attempts
  bool weak_tls = false;    ///< the address may have an sslmode that does not check who answers
  bool json = false;
};

struct SyncLinkOptions {
  std::string at{}, one{}, other{};  ///< address of the central database; CODE@STATION or a trainee's UUID
  std::filesystem::path password_file{};
  std::string author{};  ///< empty: $USER
  bool weak_tls = false;
};

/// Two trainees are one person, or no longer are. @return exit code 0
int sync_link(const SyncLinkOptions& options, std::ostream& out, std::ostream& err);
int sync_unlink(const SyncLinkOptions& options, std::ostream& out, std::ostream& err);

/// @return exit code: 0 done; 1 conflicts, or rows that do not hold: the rest was done, the names are part of the
/// result.
int sync_command(const SyncOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
