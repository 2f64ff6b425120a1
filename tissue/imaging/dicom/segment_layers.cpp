#include "tissue/imaging/dicom/segment_layers.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar {

SegmentLayers::SegmentLayers(const std::array<int, 3>& size, const Eigen::Affine3d& frame, std::string name)
    : grid_{size, frame}, name_(std::move(name)) {}

bool SegmentLayers::hold(const VoxelGrid& grid) {
  const std::optional<VoxelGrid> both = grid_.size[0] == 0 ? grid : common_grid(grid_, grid);
  if (!both) return false;
  if (same_grid(*both, grid_)) return true;
  for (LabelVolume& layer : map_.layers) layer = resampled_to(layer, *both);
  grid_ = *both;
  return true;
}

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
    fresh.size = grid_.size, fresh.index_to_ras_mm = grid_.index_to_ras_mm;
    fresh.labels.assign(mask.voxels.size(), 0);
  }
  LabelVolume& target = map_.layers[layer];
  const std::size_t end = target.offset(0, 0, mask.last_slice + 1);
  for (std::size_t n = target.offset(0, 0, mask.first_slice); n < end; ++n)
    if (mask.voxels[n]) target.labels[n] = static_cast<std::uint16_t>(segment.number);
  segment.layer = layer;
  map_.segments.push_back(std::move(segment));
}

void SegmentLayers::add(Segment segment, const LabelVolume& volume, int number) {
  if (!same_grid(grid_of(volume), grid_)) return add(std::move(segment), resampled_to(volume, grid_), number);
  SegmentMask mask(volume.size);
  const std::size_t slice = volume.offset(0, 0, 1);
  for (std::size_t n = 0; n < volume.labels.size(); ++n)
    if (volume.labels[n] == number) mask.voxels[n] = true, mask.mark_slice(static_cast<int>(n / slice));
  add(std::move(segment), mask);
}

LabelMap SegmentLayers::take() {
  for (LabelVolume& layer : map_.layers) layer = in_ras_order(std::move(layer));
  std::sort(map_.segments.begin(), map_.segments.end(), [](const Segment& a, const Segment& b) {
    return a.layer != b.layer ? a.layer < b.layer : a.number < b.number;
  });
  return std::move(map_);
}

}  // namespace trocar
