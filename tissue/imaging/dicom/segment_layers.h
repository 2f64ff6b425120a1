// Segments on one lattice of voxels, laid into as few layers as their overlaps allow.
//
// Each goes into the first layer where it meets no other. Those of several maps, which may be cut-outs of one image,
// are laid on the least grid that holds all. Thread: one owner.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_grid.h"
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

  /// Of nothing so far: the grid is the one that is held first.
  explicit SegmentLayers(std::string name) : name_(std::move(name)) {}

  /// Makes room for a grid. @return false when it is not on the lattice of what there is (label_grid.h, common_grid)
  bool hold(const VoxelGrid& grid);
  const VoxelGrid& grid() const { return grid_; }

  /// @throws InputError when so many segments overlap that their layers would be larger than an import may hold
  /// @param segment its layer is found here
  void add(Segment segment, const SegmentMask& mask);
  /// What `volume`, whose grid is held, marks with `number`. @throws InputError as above
  void add(Segment segment, const LabelVolume& volume, int number);
  /// Layers in RAS order; empty when nothing was added.
  LabelMap take();

 private:
  bool free(const LabelVolume& layer, const SegmentMask& mask) const;

  VoxelGrid grid_;
  std::string name_;
  LabelMap map_;
};

}  // namespace trocar
