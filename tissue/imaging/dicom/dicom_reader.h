// Images from DICOM as hospitals hand them out: a folder, a zip, a DICOMDIR or a single file, with or without
// extensions.
//
// Source: DICOM PS3.3 (modules), PS3.5 (encoding), PS3.10 (files). Geometry comes from ImagePositionPatient and
// ImageOrientationPatient alone. Frame of results: RAS, mm (DICOM itself is LPS). Nothing that names a patient leaves
// this reader: no name, id, birth date, institution, UID or free text; series are told apart by a number and a short
// hash. Errors may name files. Thread: any, from a process without other threads that hold locks (compressed pixels are
// decoded in a forked child).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/progress.h"

namespace trocar {

class DicomStudy;  // dicom_study.h: looked at once, read from several times

enum class DicomKind { kImage, kSegmentation, kStructureSet, kOther };

struct DicomSeries {
  int number = 0;  ///< 1, 2, ... in an order that does not depend on file names
  DicomKind kind = DicomKind::kOther;
  std::string part = {};               ///< "echo 2 of 3" of a series that holds several images of each place
  std::string modality = "unknown";    ///< "CT", "MR", "SEG", ...; never free text
  int images = 0;                      ///< slices or frames; 0 for kStructureSet and kOther
  int rows = 0, columns = 0;           ///< 0 where it has no images
  std::array<double, 3> spacing_mm{};  ///< along a row, along a column, between slices; 0 where it cannot be told
  std::array<double, 3> extent_mm{};   ///< outer edges, same order
  std::string hash;                    ///< 8 hexadecimal digits that identify the series
  std::string problem;                 ///< why it cannot be read as a volume; "" when nothing was found against it
};

/// All series of a folder (with its subfolders), a zip, a DICOMDIR or one file; files that are not DICOM are passed
/// over.
/// @throws InputError when there is no DICOM in it, or when the input itself is damaged or beyond the limits
std::vector<DicomSeries> list_dicom(const std::filesystem::path& input, const Progress& progress = {});

/// One line for people: "2: CT, 44 images of 512 x 512, 0.391 x 0.391 x 1.875 mm, 200 x 200 x 82.5 mm [3f2a9c01]".
std::string describe(const DicomSeries& series);

/// The images of one series as a volume: CT in Hounsfield units, MR and others with the file's rescale applied.
/// @param series number as list_dicom gives it; without one the only series of images is taken
/// @throws InputError naming the file and what is wrong; listing the series for choice when there are several and none
/// is given
ImageVolume read_dicom_series(const std::filesystem::path& input, std::optional<int> series = {},
                              const Progress& progress = {});
ImageVolume read_dicom_series(const DicomStudy& study, std::optional<int> series = {}, const Progress& progress = {});

}  // namespace trocar
