// The header of a MetaImage (.mha with its voxels, .mhd beside them), judged.
//
// World of the format: LPS, as ITK reads it; TransformMatrix holds the axes' directions one after the other. The format
// has no unit: lengths that cannot be millimetres of a patient are refused unless the caller names one. Thread: any,
// not the tick (file I/O).
#pragma once

#include <filesystem>

#include "tissue/imaging/volumes/volume_header.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar {

/// @throws InputError naming file, line and key
VolumeHeader meta_image_header(const std::filesystem::path& path, const VolumeReading& reading);

}  // namespace trocar
