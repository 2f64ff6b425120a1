// `trocar organ phantom`: draws the synthetic CT phantom, writes it, and imports its liver and gallbladder from those
// files.
//
// DIR receives ct.nii.gz, labels.nii.gz, README.md, phantom-liver and phantom-gallbladder (.organ.toml, .ply).
// Errors leave as EnvironmentError (exit code 3) when DIR cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace trocar {

struct OrganPhantomOptions {
  std::filesystem::path out;
  std::uint64_t seed = 1;
  bool json = false;
};

/// @return exit code 0
int organ_phantom(const OrganPhantomOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
