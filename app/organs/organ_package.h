// `trocar organ package`: organs and scenes in one zip to be passed on, with their credits.
//
// Refused as a whole when one of them has no licence: what nobody may pass on is not packed. The zip holds the files of
// every organ and CREDITS.txt; same organs, same bytes. Errors leave as InputError (exit code 2), EnvironmentError (3).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct OrganPackageOptions {
  std::vector<std::string> organs;  ///< files, or names of organs that ship
  std::filesystem::path assets;
  std::filesystem::path output;  ///< FILE.zip
};

/// Whether somebody said under what terms it may be passed on.
bool has_licence(std::string licence);

/// @return exit code 0
int organ_package(const OrganPackageOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
