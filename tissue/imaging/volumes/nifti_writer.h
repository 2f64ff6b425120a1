// Writes small volumes as NIfTI-1 (.nii.gz), the form in which the phantom leaves the house.
//
// Frame RAS, millimetres, stated as sform 1 (scanner). No time stamp: same volume, same bytes. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trocar {

/// The bytes of a .nii.gz. @param values i fastest; size[0] * size[1] * size[2] of them
std::string nifti_gz_bytes(const std::array<int, 3>& size, const Eigen::Affine3d& index_to_ras_mm,
                           const std::vector<std::int16_t>& values);
std::string nifti_gz_bytes(const std::array<int, 3>& size, const Eigen::Affine3d& index_to_ras_mm,
                           const std::vector<std::uint16_t>& values);

}  // namespace trocar
