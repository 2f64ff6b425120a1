// Names and colours of labels that a NIfTI file carries itself: the label table of a "CaretExtension" among its header
// extensions, as TotalSegmentator (--ml), Connectome Workbench and Caret write it.
//
// Extensions: nifti1.h, "extension" (4 bytes, the first not 0), then blocks of esize, ecode and esize - 8 bytes. The
// code is not looked at (Caret's is 30, TotalSegmentator writes 0): the text says what it is. Thread: any.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tissue/imaging/labels/segment.h"

namespace trocar {

/// @param bytes what lies between the header (348 or 540 bytes) and the voxels
/// @param swapped the file's byte order is the other one
/// @param notes told of a table that is damaged, or that names one number twice: such names are not taken
/// @returns the labels that the file names, by number, layer 0; none without such a table
std::vector<Segment> nifti_labels(std::span<const unsigned char> bytes, bool swapped, std::vector<std::string>& notes);

}  // namespace trocar
