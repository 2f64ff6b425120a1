// Streams the voxels of a file into arrays in RAS order, each voxel straight to its place.
//
// Thread: any, not the tick (file I/O).
#pragma once

#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/imaging/volumes/volume_header.h"
#include "tissue/progress.h"

namespace trocar {

/// One value a voxel. More than `most` voxels are averaged over pairs, along the axes with the shortest edges first,
/// with a note. Values that are not finite become the lowest finite one, with a note. @throws InputError for colours,
/// damaged or missing data
ImageVolume assemble_image(const VolumeHeader& header, const Progress& progress, std::uint64_t most = kMostVoxels);

/// One layer a component, as stored (sheared axes stay); no layer and no segment when all voxels are 0. @throws
/// InputError for what is no label map
LabelMap assemble_labels(const VolumeHeader& header, const Progress& progress);

}  // namespace trocar
