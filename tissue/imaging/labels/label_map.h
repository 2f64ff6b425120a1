// All segments of one segmentation: label maps of one frame, and the names that the file itself gives.
//
// Segments that overlap (DICOM SEG, .seg.nrrd with several layers, RTSTRUCT) lie in different layers; within a layer a
// voxel carries one number. Layers may have grids of their own: patient space (RAS, mm) is what they share. Thread:
// any.
#pragma once

#include <string>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/labels/segment.h"

namespace trocar {

struct LabelMap {
  std::vector<LabelVolume> layers;   ///< each in RAS order, never empty
  std::vector<Segment> segments;     ///< every number that marks a voxel, by layer and number
  std::string modality = "unknown";  ///< of the image that was segmented, where the file tells
  std::vector<std::string> notes;
  std::string table = {};  ///< built-in table (label_table.h) that the file itself says it follows; "" none
};

}  // namespace trocar
