// Segments on one grid, laid into as few layers as their overlaps allow.
//
// Each goes into the first layer where it meets no other. Thread: one owner.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"

namespace trocar {

/// The voxels of one segment, and the slices (last index) that hold any.
struct SegmentMask {
  std::vector<bool> voxels;
  int first_slice = 0, last_slice = -1;

  explicit SegmentMask(const std::array<int, 3>& size)
      : voxels(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2])),
        first_slice(size[2]) {}
  bool empty() const { return last_slice < first_slice; }
  void mark_slice(int slice) {
    first_slice = slice < first_slice ? slice : first_slice;
    last_slice = slice > last_slice ? slice : last_slice;
  }
};

class SegmentLayers {
 public:
  /// @param frame of the grid, RAS mm
  /// @param name of the file in messages
  SegmentLayers(const std::array<int, 3>& size, const Eigen::Affine3d& frame, std::string name);

  /// @throws InputError when so many segments overlap that their layers would be larger than an import may hold
  /// @param segment its layer is found here
  void add(Segment segment, const SegmentMask& mask);
  /// Layers in RAS order; empty when nothing was added.
  LabelMap take();

 private:
  bool free(const LabelVolume& layer, const SegmentMask& mask) const;

  std::array<int, 3> size_;
  Eigen::Affine3d frame_;
  std::string name_;
  LabelMap map_;
};

}  // namespace trocar
