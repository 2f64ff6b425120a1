// The steps of a segmentation that ITK does, on one block of voxels, seen without any ITK or Eigen type (ITK carries an
// Eigen of its own).
//
// Masks hold 0 and 1, i fastest. One ITK thread: same input, same bytes. Thread: any, one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace trocar {

struct RegionShape {
  std::array<int, 3> size{};
  std::array<double, 3> spacing_mm{1, 1, 1};
};

/// Curvature flow: smooths within tissues and keeps their borders. In place.
void curvature_flow(std::vector<float>& values, const RegionShape& shape, int steps);

/// 1 where low <= value <= high.
std::vector<std::uint8_t> window_mask(const std::vector<float>& values, const RegionShape& shape, float low,
                                      float high);

/// Every voxel within `radius_mm` of the mask joins it (centres, straight distance, exact on unequal edges).
void dilate(std::vector<std::uint8_t>& mask, const RegionShape& shape, double radius_mm);
/// Every voxel within `radius_mm` of the background leaves the mask; what lies beyond the block is no background.
void erode(std::vector<std::uint8_t>& mask, const RegionShape& shape, double radius_mm);

/// Keeps what hangs together with the voxel over faces. @param seed index of a voxel of the mask
void keep_connected(std::vector<std::uint8_t>& mask, const RegionShape& shape, const std::array<int, 3>& seed);

}  // namespace trocar
