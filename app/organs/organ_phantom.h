// `trocar organ phantom`: draws the synthetic CT phantom, writes it, and imports its liver and gallbladder from those
// files.
//
// DIR receives ct.nii.gz, labels.nii.gz, README.md, phantom-liver and phantom-gallbladder (.organ.toml, .ply), and
// dicom/ when asked for. Errors leave as EnvironmentError (exit code 3) when DIR cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "tissue/progress.h"

namespace trocar {

struct OrganPhantomOptions {
  std::filesystem::path out;
  std::uint64_t seed = 1;          ///< of the noise, and of the variant "by-seed"
  std::string variant = "normal";  ///< see phantom_variant; "by-seed": phantom_variant_of_seed
  std::uint64_t patient = 0;       ///< natural variation; 0 the standard patient
  double voxel_mm = 2.5;           ///< the shipped organs are made at 2.5
  bool scene = false;              ///< the organs round the hilum as one scene as well, phantom-abdomen
  bool dicom = false;              ///< the CT as a DICOM series as well, in DIR/dicom
  bool json = false;
  Progress progress = {};
};

/// @return exit code 0; 2 when an organ cuts itself or another
/// @throws InputError for an unknown variant or a voxel size out of range
int organ_phantom(const OrganPhantomOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
