// The NIfTI header, read and judged by ourselves before a voxel is touched.
//
// Versions 1 and 2 (nifti_fields.h), one file (.nii, .nii.gz) or a pair (.hdr with .img). Voxel (i, j, k) counts from
// 0, its centre lies at index_to_ras_mm * (i, j, k) in the RAS patient frame (x right, y anterior, z superior),
// millimetres. A signed header alone is no proof of data: the length of the voxel block is measured too, through the
// inflater for .nii.gz. Thread: any, not the tick.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tissue/imaging/volumes/volume_header.h"

namespace trocar {

/// NIfTI data type codes that hold one real number a voxel.
enum class NiftiType : std::int16_t {
  kUint8 = 2,
  kInt16 = 4,
  kInt32 = 8,
  kFloat32 = 16,
  kFloat64 = 64,
  kInt8 = 256,
  kUint16 = 512,
  kUint32 = 768,
  kInt64 = 1024,
  kUint64 = 1280,
};

struct NiftiHeader {
  int version = 1;
  std::array<int, 3> size{};  ///< voxels along i, j, k
  NiftiType type = NiftiType::kUint8;
  bool swapped = false;  ///< stored in the other byte order
  bool gzip = false;
  bool pair = false;         ///< the voxels lie in an .img file
  double data_offset = 352;  ///< bytes before the first voxel
  double slope = 1;          ///< value = slope * stored + intercept; slope 0 in the file means 1
  double intercept = 0;
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();
  std::string description;         ///< the field descrip of a NIfTI-1 header; of a file, not of bare bytes
  std::string frame_source;        ///< "sform 2" or "qform 1": which transform placed the image
  std::vector<Segment> labels;     ///< that a header extension names (nifti_labels.h); of a file, not of bare bytes
  std::vector<std::string> notes;  ///< what was odd but usable, one sentence each

  std::size_t voxel_count() const;
  /// Edge lengths of one voxel, mm.
  Eigen::Vector3d spacing_mm() const;
};

/// Judges the header bytes alone.
/// @param file name used in messages
/// @param unit of its lengths where the header says none, or another than mm (millimetres_in); "" as the header says
/// @throws InputError "FILE: field: what is wrong"
NiftiHeader parse_nifti_header(std::span<const unsigned char> bytes, const std::string& file,
                               const std::string& unit = {});

/// Extension and signature, header, and presence of every voxel byte of a single file.
/// @throws InputError naming file and field
NiftiHeader read_nifti_header(const std::filesystem::path& path);

/// The same as the other formats' headers are told; the voxels are not looked at. .nii, .nii.gz, .hdr or .img (also
/// .gz) of a pair.
/// @param unit as parse_nifti_header has it
/// @throws InputError naming file and field
VolumeHeader nifti_volume_header(const std::filesystem::path& path, const std::string& unit = {});

}  // namespace trocar
