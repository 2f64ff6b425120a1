#include "tissue/imaging/volumes/image_volume.h"

#include <algorithm>

#include "tissue/imaging/volumes/axis_order.h"

namespace trocar {

ImageVolume in_ras_order(ImageVolume volume) {
  put_in_ras_order(volume.size, volume.index_to_ras_mm, volume.values);
  return volume;
}

bool certainly_hounsfield(const ImageVolume& image) {
  constexpr float kAirInCt = -500;  // no MR magnitude image and no label map goes below 0
  return std::any_of(image.values.begin(), image.values.end(), [](float value) { return value < kAirInCt; });
}

}  // namespace trocar
