// Several files that are one patient: a folder or a zip of one mask an organ (TotalSegmentator's own output), or files
// and surfaces named one by one.
//
// The name of a file is the name of its organ. Masks may be cut-outs of one grid. A folder or zip with DICOM in it is
// none of these. Thread: any, not the tick (file I/O).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/organs/import_options.h"
#include "tissue/imaging/dicom/unpacked_zip.h"
#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/imaging/volumes/volume_reader.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {

struct OrganFile {
  std::filesystem::path path;
  std::string name;  ///< without folder and endings: "kidney_left" of "kidney_left.nii.gz"
};

struct OrganFiles {
  std::string input;                   ///< as it was given, for messages
  std::vector<OrganFile> volumes;      ///< by name
  std::vector<OrganFile> surfaces;     ///< by name
  std::size_t passed_over = 0;         ///< files of other kinds
  std::unique_ptr<UnpackedZip> zip{};  ///< keeps the unpacked files

  /// Names of the files that are asked for, nothing for all: by --label; without it and --all by --name, which of
  /// several files must be one. A number of --label that no mask is called counts the labels of all of them.
  /// @throws InputError listing the names when none of three or more files is called so
  std::vector<std::string> asked(const std::vector<OrganFile>& files, const OrganImportOptions& options) const;
  /// What is asked for by name; all when nothing is.
  /// @throws InputError listing the names when one of them is not there
  std::vector<OrganFile> chosen(const std::vector<OrganFile>& files, const std::vector<std::string>& wanted) const;
};

/// @param inputs one folder or zip, or several files; nothing for anything else (a single file, DICOM)
/// @throws InputError for several inputs that are not all volumes or all surfaces; a damaged archive
std::optional<OrganFiles> organ_files(const std::vector<std::string>& inputs, const Progress& progress);

/// Masks as one label map: numbers count the files, from 1; those that overlap lie in layers.
struct CombinedMasks {
  LabelMap map;
  std::map<int, OrganSource> origin;  ///< file, its sha256 and the number in it, by the number in `map`
  std::optional<ImageVolume> image;   ///< that lay among the masks
};

/// @throws InputError naming the file: not a mask, not on the lattice of the first, several labels without names; no
/// mask that marks a voxel
CombinedMasks combined_masks(const OrganFiles& files, const std::vector<std::string>& wanted,
                             const VolumeReading& reading, const Progress& progress);

/// @throws InputError when the input is an organ or a scene of ours, which is no source, saying what takes it
void refuse_own_manifest(const std::string& input);

/// "liver" from "dir/liver.nii.gz".
std::string plain_stem(const std::filesystem::path& path);

}  // namespace trocar
