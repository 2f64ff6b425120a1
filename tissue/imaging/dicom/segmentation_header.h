// What a DICOM segmentation says of its pixels, checked before any decoder sees them.
//
// Source: DICOM PS3.3 C.8.20.2. Frame of places: LPS, mm. Thread: one owner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/imaging/labels/segment.h"

namespace trocar {

/// What a pixel says: whether it belongs to the frame's segment, by how much of a maximum, or the number of its own.
enum class SegmentationContent { kBits, kFractions, kNumbers };

struct SegmentationHeader {
  SegmentationContent content = SegmentationContent::kBits;
  unsigned maximum = 1;     ///< of fractions
  unsigned background = 0;  ///< number of what belongs to no segment
  DicomInstance file;       ///< with `image`
  std::unique_ptr<ByteSource> source;
  std::vector<Segment> segments;
  std::vector<int> segment_of;  ///< frame by frame

  const DicomImage& image() const { return *file.image; }
  std::size_t frames() const { return static_cast<std::size_t>(file.frames); }
  std::size_t pixels() const { return static_cast<std::size_t>(file.rows) * static_cast<std::size_t>(file.columns); }
};

/// @throws InputError naming the file: cut off, larger than an import may hold, stored in a way that is not read
SegmentationHeader segmentation_header(const DicomInstance& file);

}  // namespace trocar
