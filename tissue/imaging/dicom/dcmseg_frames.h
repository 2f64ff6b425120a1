// The frames of a DICOM segmentation through dcmseg, seen without any of its types.
//
// Runs dcmseg in a child process. Thread: as dicom_reader.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tissue/progress.h"

namespace trocar {

struct SegmentationFrames {
  struct Named {
    int number = 0;
    std::string label;
  };
  bool fractional = false;
  std::vector<Named> segments;
  std::vector<int> segment_of;     ///< number, frame by frame; 0: belongs to none
  std::vector<std::string> bits;   ///< frame by frame, row by row, lowest bit first; set from one half of the maximum on
};

/// @throws InputError naming the file
SegmentationFrames read_segmentation_frames(const std::filesystem::path& path, const std::string& name, const Progress& progress);

}  // namespace trocar
