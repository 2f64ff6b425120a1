#include "tissue/imaging/image_volume.h"

#include "tissue/imaging/axis_order.h"

namespace trocar {

ImageVolume in_ras_order(ImageVolume volume) {
  const AxisOrder order = ras_order(volume.index_to_ras_mm.linear());
  ImageVolume result;
  result.size = reordered_size(volume.size, order);
  result.index_to_ras_mm = reordered_frame(volume.index_to_ras_mm, volume.size, order);
  result.values = reordered(volume.values, volume.size, order);
  result.modality = std::move(volume.modality);
  result.notes = std::move(volume.notes);
  return result;
}

}  // namespace trocar
