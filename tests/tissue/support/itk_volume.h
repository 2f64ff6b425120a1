// The voxels of a NIfTI, NRRD or MetaImage file through ITK: an oracle for our own readers, without any ITK or Eigen
// type (ITK carries an Eigen of its own).
//
// Hand over only files that read_nifti_header has passed: ITK 5.2.1 fills missing voxels with 0 and aborts on a
// non-finite transform. Frame of origin and direction: LPS, mm, as ITK has it. Thread: any, one at a time; ITK's own
// thread pool is set to one thread.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace trocar {

struct ItkVolume {
  std::array<int, 3> size{};
  std::array<double, 3> origin_mm{};  ///< LPS, centre of voxel (0, 0, 0)
  std::array<double, 3> spacing_mm{};
  std::array<std::array<double, 3>, 3> direction{};  ///< [row][column], LPS
  std::vector<double> values;                        ///< slope and intercept applied, i fastest
};

/// @throws InputError with ITK's description when it refuses the file
ItkVolume read_itk_volume(const std::filesystem::path& path);

}  // namespace trocar
