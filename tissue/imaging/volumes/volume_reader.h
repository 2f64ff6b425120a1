// Volume files other than DICOM: images and label maps from NIfTI, NRRD, .seg.nrrd and MetaImage.
//
// The ending of the name says what a file should be and its first bytes must agree: a name that says NRRD over other
// bytes is refused, saying what it looks like. Formats: NIfTI-1 and -2 (.nii, .nii.gz, .hdr/.img pairs), NRRD (.nrrd,
// .nhdr; raw, gzip, ascii), 3D Slicer segmentations (.seg.nrrd), MetaImage (.mha, .mhd). Voxels go straight into their
// final array, in RAS order. Frame RAS, millimetres. Frames are rounded to 2^-20 mm in the steps and 2^-10 mm in the
// origin, so that one volume in several containers (float32 or text) stands in one and the same place. Thread: any, not
// the tick (file I/O).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/progress.h"

namespace trocar {

/// What the file leaves open, said by the one who asks.
struct VolumeReading {
  std::string unit;   ///< "mm", "cm", "dm", "m", "um": of the lengths in the file; "" what the file says or implies
  std::string space;  ///< "RAS", "LPS", "LAS": of a NRRD that names no space; "" such a file is refused
  bool may_be_empty = false;  ///< a label map that marks no voxel comes back without segments instead of being refused
};

/// No reader makes more label voxels than this over all layers: 1 GiB (a 512 x 512 x 2000 map and a little).
inline constexpr std::uint64_t kMostLabelVoxels = std::uint64_t{1} << 29;

/// Whether the ending of a name is one that the readers here take.
bool is_volume_file(const std::filesystem::path& path);
/// "NIfTI (.nii, .nii.gz, ...), ...": for messages of those who dispatch.
std::string volume_formats();

/// @returns the image in RAS order; one of more than kMostVoxels is averaged over pairs of voxels and says so in
/// `notes`
/// @throws InputError naming file and field: header, missing data, colours, series, unknown frame, implausible lengths
ImageVolume read_image_volume(const std::filesystem::path& path, const Progress& progress = {},
                              const VolumeReading& reading = {});

/// @returns all layers and segments; axes that are not at right angles are straightened (nearest voxel), which `notes`
/// tell
/// @throws InputError as above, and for what is an image rather than a label map (fractions, negative values, more than
/// 1000 labels)
LabelMap read_label_map(const std::filesystem::path& path, const Progress& progress = {},
                        const VolumeReading& reading = {});

}  // namespace trocar
