#include "tissue/imaging/dicom/segment_layers.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar {

SegmentLayers::SegmentLayers(const std::array<int, 3>& size, const Eigen::Affine3d& frame, std::string name)
    : size_(size), frame_(frame), name_(std::move(name)) {}

bool SegmentLayers::free(const LabelVolume& layer, const SegmentMask& mask) const {
  const std::size_t end = layer.offset(0, 0, mask.last_slice + 1);
  for (std::size_t n = layer.offset(0, 0, mask.first_slice); n < end; ++n)
    if (mask.voxels[n] && layer.labels[n] != 0) return false;
  return true;
}

void SegmentLayers::add(Segment segment, const SegmentMask& mask) {
  if (mask.empty()) return;
  std::size_t layer = 0;
  while (layer < map_.layers.size() && !free(map_.layers[layer], mask)) ++layer;
  if (layer == map_.layers.size()) {
    if ((layer + 1) * mask.voxels.size() > kMostVoxels)
      throw InputError(name_ + ": its segments overlap so often that " + std::to_string(layer + 1) +
                       " layers are needed: more than an import may hold; export fewer segments at a time");
    LabelVolume& fresh = map_.layers.emplace_back();
    fresh.size = size_, fresh.index_to_ras_mm = frame_;
    fresh.labels.assign(mask.voxels.size(), 0);
  }
  LabelVolume& target = map_.layers[layer];
  const std::size_t end = target.offset(0, 0, mask.last_slice + 1);
  for (std::size_t n = target.offset(0, 0, mask.first_slice); n < end; ++n)
    if (mask.voxels[n]) target.labels[n] = static_cast<std::uint16_t>(segment.number);
  segment.layer = layer;
  map_.segments.push_back(std::move(segment));
}

LabelMap SegmentLayers::take() {
  for (LabelVolume& layer : map_.layers) layer = in_ras_order(std::move(layer));
  std::sort(map_.segments.begin(), map_.segments.end(), [](const Segment& a, const Segment& b) {
    return a.layer != b.layer ? a.layer < b.layer : a.number < b.number;
  });
  return std::move(map_);
}

}  // namespace trocar
