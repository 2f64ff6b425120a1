// `trocar organ info`: what an organ file says of itself, after the surface has been proved anew.
//
// Report on `out`. Errors leave as InputError (exit code 2).
#pragma once

#include <filesystem>
#include <iosfwd>

namespace trocar {

struct OrganInfoOptions {
  std::filesystem::path manifest;  ///< as found by find_organ
  bool json = false;
};

/// @return exit code 0
int organ_info(const OrganInfoOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
