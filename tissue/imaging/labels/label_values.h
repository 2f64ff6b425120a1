// What an image holds under a label: the check that anyone who knows the organ makes first (liver in a portal venous
// CT: about 110 HU).
//
// Values in the image's own (HU for CT). Thread: any.
#pragma once

#include <cstddef>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar {

struct LabelValues {
  std::size_t voxels = 0;  ///< of the image, under the label
  double mean = 0, deviation = 0;
  double p05 = 0, p95 = 0;  ///< 5 % of the voxels lie below, above
};

/// @param labels on the image's grid (on_grid_of); @throws std::invalid_argument when they are not of its size
LabelValues values_under(const ImageVolume& image, const LabelVolume& labels, int number);

}  // namespace trocar
