// The segments that a DICOM segmentation describes, and which of them each of its frames marks.
//
// Source: DICOM PS3.3 C.8.20.4 (segment description), C.8.20.3 (segment identification), C.7.6.3.1.5 (palette). Thread:
// any.
#pragma once

#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_elements.h"
#include "tissue/imaging/labels/segment.h"

namespace trocar {

/// Number, label, colour and codes as the file has them, by number: they need not follow each other. A segment without
/// a colour of its own gets that of the palette, where the file has one.
/// @throws InputError naming the file: no segment, or two of one number
std::vector<Segment> described_segments(const DicomItem& data, const std::string& name);

/// Number of the segment that each frame marks; -1 where none is named (as in a label map).
std::vector<int> frame_segments(const DicomItem& data, std::size_t frames);

}  // namespace trocar
