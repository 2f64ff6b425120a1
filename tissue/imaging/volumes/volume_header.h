// What the header of a volume file says, whichever format it came from: size, frame, and where and how the voxels are
// stored.
//
// Frame RAS, millimetres; index (0, 0, 0) is the centre of the first stored voxel. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tissue/imaging/labels/segment.h"

namespace trocar {

enum class VoxelType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };
std::size_t bytes_of(VoxelType type);

/// Deflated: a gzip or zlib stream. Text: decimal numbers between white space.
enum class VoxelEncoding { kRaw, kDeflated, kText };

struct VoxelBlock {
  std::filesystem::path file;
  VoxelEncoding encoding = VoxelEncoding::kRaw;
  VoxelType type = VoxelType::kUint8;
  bool swapped = false;       ///< stored in the other byte order
  std::uint64_t offset = 0;   ///< bytes of the file before the block
  std::uint64_t skipped = 0;  ///< bytes before the first voxel once unpacked
  bool last_in_file = false;  ///< raw: the voxels are the last bytes of the file, behind a header of unknown length
  double slope = 1, intercept = 0;  ///< value = slope * stored + intercept
};

/// Of a header's only segment that does not say which number it has.
inline constexpr int kAnyNumber = 0;

struct VolumeHeader {
  std::string format;         ///< "NIfTI-1", for messages
  std::array<int, 3> size{};  ///< voxels along the three stored axes that lie in space
  int components = 1;         ///< values a voxel
  int component_axis = 3;     ///< place of the components among the four stored axes, 0 the fastest
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();
  VoxelBlock block;
  std::string modality = "unknown";
  bool segmentation = false;      ///< the header names segments (.seg.nrrd)
  bool cut_out = false;           ///< of a larger image, as the header says: its border cuts no organ
  std::vector<Segment> segments;  ///< that the header tells of, whether they mark a voxel or not
  std::string description = {};   ///< free text of a NIfTI header; "" elsewhere
  std::vector<std::string> notes;

  std::uint64_t value_count() const;
};

}  // namespace trocar
