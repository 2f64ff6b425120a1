// One organ cut out of a label map: the parts that a rule keeps, cavities filled, with what was lost and where the
// image cut it.
//
// Parts hang together over voxel faces (6 neighbours), and so does the background whose enclosed pieces are cavities.
// Parts that touch by an edge or a corner, or lie a voxel or two apart, are joined by the fewest voxels that connect
// them over faces (Kruskal's tree over all such gaps, shortest first, then in voxel order). Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"

namespace trocar {

/// Which face-connected parts of a label are kept. Every other part is lost, and reported.
struct PartsRule {
  bool only_largest = false;  ///< nothing but the largest part; then the rest of the rule is not used
  double least_share = 0.01;  ///< parts of at least this share (and 8 voxels) of the label's voxels are kept
  int bridge_voxels =
      2;  ///< parts are joined over gaps of so many voxels, counted over faces: 0 to 2 (edge 1, corner 2)
};

struct LabelMask {
  std::array<int, 3> size{};                 ///< of the box cut out, margin included
  std::array<int, 3> first{};                ///< index in the label map of the box's voxel (0, 0, 0); may be negative
  std::array<std::array<bool, 2>, 3> cut{};  ///< [axis][low, high]: the organ reaches the border of the image there
  std::vector<std::uint8_t> inside;          ///< 1 inside, i fastest; the margin is 0, so a cut organ gets a flat cap
  std::size_t label_voxels = 0;              ///< voxels that carry the label
  std::vector<std::size_t> lost_parts;       ///< voxels of each smaller part, largest first
  std::vector<std::size_t> cavities;         ///< voxels of each cavity that was filled, largest first
  std::size_t bridge_voxels = 0;             ///< voxels added to join parts
  std::size_t parts = 1;                     ///< pieces that stay apart in the mask
  std::size_t kept_voxels = 0;               ///< voxels inside the mask
  std::size_t border_voxels = 0;             ///< kept voxels in the outermost slices of the label map

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
};

/// @param margin empty voxels round the organ's bounding box, >= 1
/// @throws InputError when no voxel carries the label, or fewer than 8 hang together
LabelMask cut_out_label(const LabelVolume& volume, int label, int margin,
                        const PartsRule& rule = {.only_largest = true});

}  // namespace trocar
