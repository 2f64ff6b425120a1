// A label map in patient space: one whole number a voxel, and where the voxels lie.
//
// The array is kept in RAS order: axis i runs mostly to the patient's right (+x), j to the front (+y), k to the head
// (+z), so that one anatomy stored in any of the 48 axis orders becomes one and the same array. Frame RAS, millimetres
// (nibabel's world frame; ITK and DICOM use LPS, which is (-x, -y, z)). Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trocar {

struct LabelVolume {
  std::array<int, 3> size{};
  std::vector<std::uint16_t> labels;  ///< i fastest
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();
  std::vector<std::string> notes;  ///< what was odd but usable

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  double voxel_volume_ml() const;
  /// Voxels of every label but 0.
  std::map<int, std::size_t> label_counts() const;
};

/// Permutes and flips the axes into RAS order; the world position of every voxel stays.
LabelVolume in_ras_order(LabelVolume volume);

}  // namespace trocar
