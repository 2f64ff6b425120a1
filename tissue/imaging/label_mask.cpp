#include "tissue/imaging/label_mask.h"

#include <algorithm>
#include <string>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kFewestVoxels = 8;

struct Box {
  std::array<int, 3> low{1 << 30, 1 << 30, 1 << 30};
  std::array<int, 3> high{-1, -1, -1};
};

Box bounding_box(const LabelVolume& volume, int label) {
  Box box;
  std::size_t voxel = 0;
  std::array<int, 3> index{};
  for (index[2] = 0; index[2] < volume.size[2]; ++index[2])
    for (index[1] = 0; index[1] < volume.size[1]; ++index[1])
      for (index[0] = 0; index[0] < volume.size[0]; ++index[0], ++voxel) {
        if (volume.labels[voxel] != label) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.low[axis] = std::min(box.low[axis], index[axis]);
          box.high[axis] = std::max(box.high[axis], index[axis]);
        }
      }
  return box;
}

LabelMask copy_box(const LabelVolume& volume, int label, const Box& box, int margin) {
  LabelMask mask;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mask.first[axis] = box.low[axis] - margin;
    mask.size[axis] = box.high[axis] - box.low[axis] + 1 + 2 * margin;
  }
  mask.inside.assign(mask.offset(0, 0, mask.size[2]), 0);
  for (int k = margin; k < mask.size[2] - margin; ++k)
    for (int j = margin; j < mask.size[1] - margin; ++j)
      for (int i = margin; i < mask.size[0] - margin; ++i) {
        const bool set = volume.labels[volume.offset(i + mask.first[0], j + mask.first[1], k + mask.first[2])] == label;
        mask.inside[mask.offset(i, j, k)] = set ? 1 : 0;
        mask.label_voxels += set ? 1 : 0;
      }
  return mask;
}

/// Face-connected parts of the voxels whose value is `value`: part number of each voxel (0: another value), sizes.
struct Parts {
  std::vector<std::int32_t> number;
  std::vector<std::size_t> voxels{0};  ///< index 0 unused
};

void flood(const LabelMask& mask, std::size_t seed, std::uint8_t value, Parts& parts) {
  const auto part = static_cast<std::int32_t>(parts.voxels.size());
  const std::size_t row = static_cast<std::size_t>(mask.size[0]);
  const std::size_t slice = row * static_cast<std::size_t>(mask.size[1]);
  std::vector<std::size_t> open{seed};
  parts.number[seed] = part;
  std::size_t count = 0;
  const auto visit = [&](std::size_t voxel) {
    if (mask.inside[voxel] != value || parts.number[voxel] != 0) return;
    parts.number[voxel] = part;
    open.push_back(voxel);
  };
  while (!open.empty()) {
    const std::size_t voxel = open.back();
    open.pop_back();
    ++count;
    const auto i = voxel % row, j = voxel % slice / row, k = voxel / slice;
    if (i > 0) visit(voxel - 1);
    if (i + 1 < row) visit(voxel + 1);
    if (j > 0) visit(voxel - row);
    if (j + 1 < static_cast<std::size_t>(mask.size[1])) visit(voxel + row);
    if (k > 0) visit(voxel - slice);
    if (k + 1 < static_cast<std::size_t>(mask.size[2])) visit(voxel + slice);
  }
  parts.voxels.push_back(count);
}

Parts connected_parts(const LabelMask& mask, std::uint8_t value) {
  Parts parts;
  parts.number.assign(mask.inside.size(), 0);
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
    if (mask.inside[voxel] == value && parts.number[voxel] == 0) flood(mask, voxel, value, parts);
  return parts;
}

/// Keeps the voxels of one part at `value`, turns the others over and returns their sizes, largest first.
std::vector<std::size_t> keep_part(LabelMask& mask, const Parts& parts, std::int32_t keep, std::uint8_t value) {
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
    if (parts.number[voxel] != 0 && parts.number[voxel] != keep) mask.inside[voxel] = value == 0 ? 1 : 0;
  std::vector<std::size_t> others;
  for (std::size_t part = 1; part < parts.voxels.size(); ++part)
    if (part != static_cast<std::size_t>(keep)) others.push_back(parts.voxels[part]);
  std::sort(others.rbegin(), others.rend());
  return others;
}

void count_kept(LabelMask& mask, const LabelVolume& volume) {
  std::array<int, 3> index{};
  std::size_t voxel = 0;
  for (index[2] = 0; index[2] < mask.size[2]; ++index[2])
    for (index[1] = 0; index[1] < mask.size[1]; ++index[1])
      for (index[0] = 0; index[0] < mask.size[0]; ++index[0], ++voxel) {
        if (mask.inside[voxel] == 0) continue;
        ++mask.kept_voxels;
        bool outermost = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int place = index[axis] + mask.first[axis];
          outermost = outermost || place == 0 || place == volume.size[axis] - 1;
        }
        mask.border_voxels += outermost ? 1 : 0;
      }
}

}  // namespace

LabelMask cut_out_label(const LabelVolume& volume, int label, int margin, const PartsRule& rule) {
  static_cast<void>(rule);
  const Box box = bounding_box(volume, label);
  if (box.high[0] < 0) throw InputError("label " + std::to_string(label) + " marks no voxel");
  LabelMask mask = copy_box(volume, label, box, margin);
  const Parts parts = connected_parts(mask, 1);
  const auto largest = std::max_element(parts.voxels.begin(), parts.voxels.end());
  if (*largest < kFewestVoxels)
    throw InputError("label " + std::to_string(label) + ": its largest part has only " + std::to_string(*largest) +
                     " voxels");
  mask.lost_parts = keep_part(mask, parts, static_cast<std::int32_t>(largest - parts.voxels.begin()), 1);
  mask.cavities =
      keep_part(mask, connected_parts(mask, 0), 1, 0);  // the corner voxel lies in the margin: part 1 is outside
  count_kept(mask, volume);
  return mask;
}

}  // namespace trocar
