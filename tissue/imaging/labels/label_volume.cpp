#include "tissue/imaging/labels/label_volume.h"

#include <cmath>

#include "tissue/imaging/volumes/axis_order.h"

namespace trocar {

double LabelVolume::voxel_volume_ml() const { return std::abs(index_to_ras_mm.linear().determinant()) * 1e-3; }

std::map<int, std::size_t> LabelVolume::label_counts() const {
  std::vector<std::size_t> histogram(65536, 0);
  for (const std::uint16_t label : labels) ++histogram[label];
  std::map<int, std::size_t> counts;
  for (std::size_t label = 1; label < histogram.size(); ++label)
    if (histogram[label] > 0) counts[static_cast<int>(label)] = histogram[label];
  return counts;
}

LabelVolume in_ras_order(LabelVolume volume) {
  put_in_ras_order(volume.size, volume.index_to_ras_mm, volume.labels);
  return volume;
}

}  // namespace trocar
