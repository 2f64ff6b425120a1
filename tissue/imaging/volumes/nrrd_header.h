// The header of a NRRD file (.nrrd, detached .nhdr) and of a 3D Slicer segmentation (.seg.nrrd), judged.
//
// Spaces RAS, LAS and LPS; encodings raw, gzip and ascii; three axes in space, and at most one that is not (layers of a
// segmentation). Segment numbers, layers and names come from the SegmentN_... keys. Files of Slicer before 4.11 have no
// such layers: each segment is one component of 0 and 1. Frame RAS, millimetres. Thread: any, not the tick (file I/O).
#pragma once

#include <filesystem>

#include "tissue/imaging/volumes/nrrd_fields.h"
#include "tissue/imaging/volumes/volume_header.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar {

/// @throws InputError naming file, line and field
VolumeHeader nrrd_volume_header(const std::filesystem::path& path, const VolumeReading& reading);

/// The SegmentN_... keys: numbers, layers, names, colours, terminology. Of several segments in one layer, one without a
/// number is left out: it could be any.
/// @param components values a voxel @param notes what was left out
/// @throws InputError for a number or layer that cannot be
std::vector<Segment> nrrd_segments(const NrrdFields& header, int components, std::vector<std::string>& notes);

/// The voxel file that a header names, beside the header or in a folder below it.
/// @throws InputError for an absolute name, one that leads out of the folder, patterns and lists of files, a missing
/// file
std::filesystem::path detached_file(const std::filesystem::path& header, const std::string& name,
                                    const std::string& field);

}  // namespace trocar
