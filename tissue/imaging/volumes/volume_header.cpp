#include "tissue/imaging/volumes/volume_header.h"

namespace trocar {

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::kInt8:
    case VoxelType::kUint8:
      return 1;
    case VoxelType::kInt16:
    case VoxelType::kUint16:
      return 2;
    case VoxelType::kInt32:
    case VoxelType::kUint32:
    case VoxelType::kFloat32:
      return 4;
    case VoxelType::kInt64:
    case VoxelType::kUint64:
    case VoxelType::kFloat64:
      return 8;
  }
  return 8;
}

std::uint64_t VolumeHeader::value_count() const {
  std::uint64_t count = static_cast<std::uint64_t>(components);
  for (const int extent : size) count *= static_cast<std::uint64_t>(extent);
  return count;
}

}  // namespace trocar
