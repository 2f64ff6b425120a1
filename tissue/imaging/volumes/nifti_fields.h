// The fields of a NIfTI-1 or NIfTI-2 header as they are stored, in either byte order, not yet judged.
//
// Layouts: nifti1.h (348 bytes), nifti2.h (540 bytes: wider numbers, other places). Thread: any.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace trocar {

inline constexpr std::size_t kNifti1Bytes = 348;
inline constexpr std::size_t kNifti2Bytes = 540;

struct NiftiFields {
  int version = 1;
  bool swapped = false;
  bool pair = false;  ///< the voxels lie in an .img file
  std::array<std::int64_t, 8> dim{};
  int datatype = 0, bitpix = 0, intent = 0, units = 0;
  std::array<double, 8> pixdim{};
  double vox_offset = 0, slope = 0, intercept = 0;
  int qform = 0, sform = 0;
  std::array<double, 3> quatern{};  ///< b, c, d
  std::array<double, 3> qoffset{};
  Eigen::Matrix<double, 3, 4> srow = Eigen::Matrix<double, 3, 4>::Zero();
};

/// Bytes that the whole header has, told from its first four: 348, 540; 0 when neither.
std::size_t nifti_header_bytes(std::span<const unsigned char> bytes);

/// @param bytes at least the whole header
/// @throws InputError naming `file`: sizeof_hdr or magic is not NIfTI's
NiftiFields decode_nifti(std::span<const unsigned char> bytes, const std::string& file);

}  // namespace trocar
