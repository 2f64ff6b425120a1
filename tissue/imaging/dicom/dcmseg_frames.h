// The frames of a DICOM segmentation through dcmseg, seen without any of its types.
//
// Runs dcmseg in a child process. Of native pixels nothing is taken: dcmseg 3.6.7 shifts the bits of binary frames
// whose pixels do not fill whole bytes (a test shows it), and they are easily read without it. Thread: as
// dicom_reader.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tissue/imaging/labels/segment.h"
#include "tissue/progress.h"

namespace trocar {

struct SegmentationFrames {
  std::vector<Segment> segments;    ///< number, label, colour and codes
  std::vector<int> segment_of;      ///< number, frame by frame; 0: belongs to none
  std::vector<std::string> values;  ///< of compressed fractional frames: one byte a pixel; empty otherwise
};

/// @param with_pixels whether the frames are compressed, so that their pixels must be decoded
/// @throws InputError naming the file
SegmentationFrames read_segmentation_frames(const std::filesystem::path& path, const std::string& name,
                                            bool with_pixels, const Progress& progress);

}  // namespace trocar
