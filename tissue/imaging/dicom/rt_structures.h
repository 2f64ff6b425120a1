// DICOM structure sets (RTSTRUCT): contours drawn in planes, filled on a grid of voxels.
//
// Source: DICOM PS3.3 C.8.8.5 and C.8.8.6; decoded by dcmrt in a child process. A voxel belongs to a structure when its
// centre lies inside by the even-odd rule over all contours of the plane: holes by a second contour and by a keyhole
// both come out. Frame RAS, mm. Thread: as dicom_reader.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/progress.h"

namespace trocar {

class DicomStudy;

/// Filled on the grid of the image that was drawn on. Contours must lie in slices of that grid, or evenly between them.
/// @param input an RTSTRUCT file; or a folder, zip or DICOMDIR that holds one
/// @param series number as list_dicom gives it, where the input holds several structure sets
/// @throws InputError naming the file, the structure by its number and name, and what is wrong
LabelMap read_rtstruct(const std::filesystem::path& input, const ImageVolume& grid, const Progress& progress = {},
                       std::optional<int> series = {});

/// Filled on a grid of its own: slices where the contours lie, square voxels in them (a note gives their size).
/// @throws InputError as above; also when the planes of the contours are not evenly spaced or not parallel
LabelMap read_rtstruct(const std::filesystem::path& input, const Progress& progress = {},
                       std::optional<int> series = {});
/// Of a study that was looked at. The label of a structure is its place in the list (from 1): numbers of structures may
/// be any.
/// @param wanted names or places of the structures to fill; those alone decide a grid of their own. Empty: all; all too
/// when none fits
LabelMap read_rtstruct(const DicomStudy& study, const ImageVolume& grid, const Progress& progress = {},
                       std::optional<int> series = {}, const std::vector<std::string>& wanted = {});
LabelMap read_rtstruct(const DicomStudy& study, const Progress& progress = {}, std::optional<int> series = {},
                       const std::vector<std::string>& wanted = {});

}  // namespace trocar
