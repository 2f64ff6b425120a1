#include "tissue/imaging/labels/label_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/volume_frame.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar {
namespace {

Eigen::Vector3d corner_of(const VoxelGrid& grid, int corner, double beyond) {
  Eigen::Vector3d index;
  for (int axis = 0; axis < 3; ++axis)
    index[axis] = (corner >> axis & 1) != 0 ? grid.size[static_cast<std::size_t>(axis)] - 1 + beyond : -beyond;
  return grid.index_to_ras_mm * index;
}

/// The box along the patient's axes round all voxels, edges included.
Eigen::AlignedBox3d box_of(const VoxelGrid& grid) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) box.extend(corner_of(grid, corner, 0.5));
  return box;
}

/// The box along the patient's axes round the voxels that carry a label.
Eigen::AlignedBox3d labelled_box(const LabelVolume& volume) {
  Eigen::AlignedBox3d box;
  std::size_t voxel = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i, ++voxel)
        if (volume.labels[voxel] != 0) box.extend(volume.index_to_ras_mm * Eigen::Vector3d(i, j, k));
  return box;
}

double box_gap_mm(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  return std::sqrt(a.squaredExteriorDistance(b));
}

void check_grid(const VoxelGrid& grid) {
  double count = 1;
  for (const int extent : grid.size) count *= extent;
  if (*std::min_element(grid.size.begin(), grid.size.end()) < 1 || count > static_cast<double>(kMostLabelVoxels))
    throw InputError("a grid of " + plain(count) + " voxels cannot be filled with labels");
  if (!grid.index_to_ras_mm.matrix().allFinite() || std::abs(grid.index_to_ras_mm.linear().determinant()) < 1e-9)
    throw InputError("a grid whose axes fall together cannot be filled with labels");
}

std::size_t labelled(const LabelVolume& volume) {
  return volume.labels.size() - static_cast<std::size_t>(std::count(volume.labels.begin(), volume.labels.end(), 0));
}

}  // namespace

VoxelGrid grid_of(const LabelVolume& volume) { return {volume.size, volume.index_to_ras_mm}; }
VoxelGrid grid_of(const ImageVolume& volume) { return {volume.size, volume.index_to_ras_mm}; }

bool same_grid(const VoxelGrid& a, const VoxelGrid& b, double tolerance_mm) {
  if (a.size != b.size) return false;
  for (int corner = 0; corner < 8; ++corner)
    if (!((corner_of(a, corner, 0) - corner_of(b, corner, 0)).norm() <= tolerance_mm)) return false;
  return true;
}

std::optional<VoxelGrid> common_grid(const VoxelGrid& a, const VoxelGrid& b, double tolerance_mm) {
  const Eigen::Vector3d shift = (a.index_to_ras_mm.inverse() * b.index_to_ras_mm.translation()).array().round();
  if (!(shift.array().abs() <= static_cast<double>(kMostLabelVoxels)).all()) return std::nullopt;
  VoxelGrid there = b;  // where b would lie on a's lattice
  there.index_to_ras_mm.linear() = a.index_to_ras_mm.linear();
  there.index_to_ras_mm.translation() = a.index_to_ras_mm * shift;
  if (!same_grid(there, b, tolerance_mm)) return std::nullopt;
  VoxelGrid both = a;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  double count = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    low[axis] = std::min(0.0, shift[axis]);
    const double extent = std::max<double>(a.size[n], shift[axis] + b.size[n]) - low[axis];
    count *= extent;
    if (count > static_cast<double>(kMostLabelVoxels)) return std::nullopt;
    both.size[n] = static_cast<int>(extent);
  }
  both.index_to_ras_mm.translation() = a.index_to_ras_mm * low;
  return both;
}

bool fills_grid(const LabelVolume& volume) {
  std::array<std::array<bool, 2>, 3> reached{};
  std::size_t voxel = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i, ++voxel) {
        if (volume.labels[voxel] == 0) continue;
        const std::array<int, 3> place{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (place[axis] == 0) reached[axis][0] = true;
          if (place[axis] + 1 == volume.size[axis]) reached[axis][1] = true;
        }
      }
  return std::all_of(reached.begin(), reached.end(), [](const auto& sides) { return sides[0] && sides[1]; });
}

LabelVolume widened(const LabelVolume& volume) {
  VoxelGrid grid = grid_of(volume);
  for (int& extent : grid.size) extent += 2;
  grid.index_to_ras_mm.translation() = volume.index_to_ras_mm * Eigen::Vector3d(-1, -1, -1);
  return resampled_to(volume, grid);
}

LabelVolume resampled_to(const LabelVolume& volume, const VoxelGrid& grid, const Progress& progress) {
  check_grid(grid);
  const Eigen::Affine3d map = volume.index_to_ras_mm.inverse() * grid.index_to_ras_mm;
  LabelVolume result{.size = grid.size, .labels = {}, .index_to_ras_mm = grid.index_to_ras_mm, .notes = volume.notes};
  result.labels.assign(result.offset(0, 0, grid.size[2]), 0);
  const Eigen::Vector3d step = map.linear().col(0);
  const Eigen::Vector3d extent(volume.size[0], volume.size[1], volume.size[2]);
  std::size_t voxel = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      // Half a voxel up, so that cutting off gives the nearest; the nudge lets exact middles fall one way on every
      // machine.
      const Eigen::Vector3d first = map * Eigen::Vector3d(0, j, k) + Eigen::Vector3d::Constant(0.5 - 1e-6);
      for (int i = 0; i < grid.size[0]; ++i, ++voxel) {
        const Eigen::Vector3d place = first + i * step;
        if ((place.array() < 0).any() || (place.array() >= extent.array()).any()) continue;
        result.labels[voxel] = volume.labels[volume.offset(static_cast<int>(place.x()), static_cast<int>(place.y()),
                                                           static_cast<int>(place.z()))];
      }
    }
    report(progress, "resampling labels", (k + 1.0) / grid.size[2]);
  }
  return result;
}

double gap_mm(const VoxelGrid& a, const VoxelGrid& b) { return box_gap_mm(box_of(a), box_of(b)); }

LabelVolume on_grid_of(const ImageVolume& image, const LabelVolume& labels, const std::string& name,
                       const Progress& progress) {
  const VoxelGrid wanted = grid_of(image), given = grid_of(labels);
  if (same_grid(wanted, given)) return labels;
  const bool apart = gap_mm(wanted, given) > 0;
  LabelVolume result = apart ? LabelVolume{} : resampled_to(labels, wanted, progress);
  const std::size_t before = labelled(labels), after = labelled(result);
  const double gap = after > 0 ? 0 : box_gap_mm(labelled_box(labels), box_of(wanted));
  if (gap > 0) throw InputError(name + ": the label map lies " + plain(gap) + " mm outside the image: not its labels");
  const double kept =
      static_cast<double>(after) * result.voxel_volume_ml() / (static_cast<double>(before) * labels.voxel_volume_ml());
  result.notes.push_back(
      "the labels have another grid than the image; surfaces are made on the labels' own grid; carried to the image's "
      "grid by the nearest "
      "voxel, for pictures and image values, they keep " +
      plain(std::round(1000 * kept) / 10) + " % of their volume");
  return result;
}

VoxelGrid squared_grid(const VoxelGrid& grid) {
  const Eigen::Matrix3d linear = grid.index_to_ras_mm.linear();
  Eigen::Matrix3d axes;
  axes.col(0) = linear.col(0).normalized();
  axes.col(2) = linear.col(0).cross(linear.col(1)).normalized();
  if (axes.col(2).dot(linear.col(2)) < 0) axes.col(2) *= -1;
  axes.col(1) = (linear.col(1) - axes.col(0) * axes.col(0).dot(linear.col(1))).normalized();
  const Eigen::Vector3d step = (axes.transpose() * linear).diagonal();
  Eigen::AlignedBox3d box;  // of the voxel centres, along the new axes
  for (int corner = 0; corner < 8; ++corner) box.extend(axes.transpose() * corner_of(grid, corner, 0));
  VoxelGrid squared;
  squared.index_to_ras_mm.linear() = axes * step.asDiagonal();
  squared.index_to_ras_mm.translation() = axes * box.min();
  for (int axis = 0; axis < 3; ++axis)
    squared.size[static_cast<std::size_t>(axis)] =
        1 + static_cast<int>(std::ceil(box.sizes()[axis] / step[axis] - 1e-6));
  return squared;
}

double skew_of(const Eigen::Affine3d& index_to_ras_mm) {
  const Eigen::Matrix3d axes = index_to_ras_mm.linear().colwise().normalized();
  return (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace trocar
