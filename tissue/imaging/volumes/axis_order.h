// The 48 ways to store one volume, brought to one: RAS axis order without moving a voxel in patient space.
//
// Frames: index (i, j, k) to RAS millimetres. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

namespace trocar {

/// Which stored axis runs along each RAS axis, and whether it must be flipped.
struct AxisOrder {
  std::array<int, 3> stored{};
  std::array<bool, 3> flipped{};
};

/// @param linear index to RAS, its columns the steps of the stored axes; not singular
AxisOrder ras_order(const Eigen::Matrix3d& linear);

std::array<int, 3> reordered_size(const std::array<int, 3>& size, const AxisOrder& order);
Eigen::Affine3d reordered_frame(const Eigen::Affine3d& frame, const std::array<int, 3>& size, const AxisOrder& order);

/// The same voxels in the new order, i fastest. @param size of the stored array
template <typename Value>
std::vector<Value> reordered(const std::vector<Value>& stored, const std::array<int, 3>& size, const AxisOrder& order) {
  const std::array<std::ptrdiff_t, 3> stride{1, size[0], static_cast<std::ptrdiff_t>(size[0]) * size[1]};
  const std::array<int, 3> extent = reordered_size(size, order);
  std::array<std::ptrdiff_t, 3> step{};
  std::ptrdiff_t first = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::ptrdiff_t along = stride[static_cast<std::size_t>(order.stored[axis])];
    step[axis] = order.flipped[axis] ? -along : along;
    if (order.flipped[axis]) first += along * (extent[axis] - 1);
  }
  std::vector<Value> result;
  result.reserve(stored.size());
  for (int k = 0; k < extent[2]; ++k)
    for (int j = 0; j < extent[1]; ++j) {
      const std::ptrdiff_t row = first + k * step[2] + j * step[1];
      for (int i = 0; i < extent[0]; ++i) result.push_back(stored[static_cast<std::size_t>(row + i * step[0])]);
    }
  return result;
}

/// A volume brought into RAS order in place, whatever its voxels hold.
template <typename Value>
void put_in_ras_order(std::array<int, 3>& size, Eigen::Affine3d& index_to_ras_mm, std::vector<Value>& voxels) {
  const AxisOrder order = ras_order(index_to_ras_mm.linear());
  voxels = reordered(voxels, size, order);
  index_to_ras_mm = reordered_frame(index_to_ras_mm, size, order);
  size = reordered_size(size, order);
}

}  // namespace trocar
