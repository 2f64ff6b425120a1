// DICOM Segmentation objects (SEG) as label maps.
//
// Source: DICOM PS3.3 A.51 and C.8.20. Kinds: BINARY; FRACTIONAL, which counts from one half of its maximum on (a note
// says so); LABELMAP (8 or 16 bits, with a palette or not), which carries one number a voxel. Every segment is one
// Segment; segments that share a voxel lie in different layers. Frame RAS, mm. Thread: as dicom_reader.h.
#pragma once

#include <filesystem>
#include <optional>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/progress.h"

namespace trocar {

class DicomStudy;

/// @param input a SEG file; or a folder, zip or DICOMDIR that holds one
/// @param series number as list_dicom gives it, where the input holds several segmentations
/// Several files of the series become one map, their segments counted from 1.
/// @param every takes the segmentations of all series, where no number is given
/// @throws InputError naming the file and what is wrong
LabelMap read_dicom_segmentation(const std::filesystem::path& input, const Progress& progress = {},
                                 std::optional<int> series = {});
LabelMap read_dicom_segmentation(const DicomStudy& study, const Progress& progress = {}, std::optional<int> series = {},
                                 bool every = false);

}  // namespace trocar
