// The contours of a DICOM structure set through dcmrt, seen without any of its types.
//
// Runs dcmrt in a child process. Frame LPS, mm. Thread: as dicom_reader.h.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/labels/segment.h"
#include "tissue/progress.h"

namespace trocar {

using Contour = std::vector<Eigen::Vector3d>;

struct Structure {
  int number = 0;
  std::string name;
  std::vector<Contour> closed;  ///< CLOSED_PLANAR and CLOSEDPLANAR_XOR, three points at least, finite
  int others = 0;               ///< points, open lines, contours of fewer than three points
  std::optional<SegmentColour> colour = {};
  std::vector<SegmentCode> codes = {};
};

/// By number; structures without any contour are among them.
/// @param series as read_rtstruct has it
/// @throws InputError naming the file
std::vector<Structure> read_structures(const DicomStudy& study, const Progress& progress,
                                       std::optional<int> series = {});

}  // namespace trocar
