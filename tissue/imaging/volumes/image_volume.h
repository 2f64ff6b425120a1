// A scalar image in patient space: one value a voxel, and where the voxels lie.
//
// The array is kept in RAS order like LabelVolume's (axis i mostly to the patient's right, j to the front, k to the
// head). Frame RAS, millimetres. CT in Hounsfield units (rescale applied file by file), MR in the scanner's own units.
// Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trocar {

/// No reader makes a larger volume: with float voxels this is 1 GiB.
inline constexpr std::uint64_t kMostVoxels = std::uint64_t{256} << 20;

struct ImageVolume {
  std::array<int, 3> size{};
  std::vector<float> values;  ///< i fastest
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();
  std::string modality = "unknown";  ///< "CT", "MR", "unknown"
  std::vector<std::string> notes;    ///< what was odd but usable, and what was decided

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
};

/// Permutes and flips the axes into RAS order; the world position of every voxel stays.
ImageVolume in_ras_order(ImageVolume volume);

/// Whether the values can only be Hounsfield units: some lie below -500, as air in CT does.
bool certainly_hounsfield(const ImageVolume& image);

}  // namespace trocar
