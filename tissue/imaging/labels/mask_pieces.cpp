#include "tissue/imaging/labels/mask_pieces.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr std::uint8_t kOutside = 0, kInside = 1, kSeen = 2, kKept = 3;

/// Fills over faces with a stack of its own; each voxel goes on it once.
class Flood {
 public:
  Flood(std::vector<std::uint8_t>& mask, const RegionShape& shape, const Progress& progress, const char* stage)
      : mask_(mask), shape_(shape), progress_(progress), stage_(stage), row_(extent(0)), slice_(row_ * extent(1)) {}

  /// All voxels of value `from` that hang together with `start` become `to`. @returns how many
  std::size_t fill(std::size_t start, std::uint8_t from, std::uint8_t to) {
    std::size_t count = 0;
    take(start, from, to);
    while (!open_.empty()) {
      const std::size_t at = open_.back();
      open_.pop_back();
      ++count;
      tell();
      const std::size_t i = at % row_, j = at / row_ % extent(1), k = at / slice_;
      if (i > 0) take(at - 1, from, to);
      if (i + 1 < row_) take(at + 1, from, to);
      if (j > 0) take(at - row_, from, to);
      if (j + 1 < extent(1)) take(at + row_, from, to);
      if (k > 0) take(at - slice_, from, to);
      if (k + 1 < extent(2)) take(at + slice_, from, to);
    }
    return count;
  }

  bool on_border(std::size_t at) const {
    const std::size_t i = at % row_, j = at / row_ % extent(1), k = at / slice_;
    return i == 0 || j == 0 || k == 0 || i + 1 == row_ || j + 1 == extent(1) || k + 1 == extent(2);
  }

 private:
  std::size_t extent(std::size_t axis) const { return static_cast<std::size_t>(shape_.size[axis]); }

  void take(std::size_t at, std::uint8_t from, std::uint8_t to) {
    if (mask_[at] != from) return;
    mask_[at] = to;
    open_.push_back(static_cast<std::uint32_t>(at));
  }

  void tell() {
    constexpr std::size_t kBetween = std::size_t{1} << 20;
    if (++done_ % kBetween == 0) report(progress_, stage_, -1);
  }

  std::vector<std::uint8_t>& mask_;
  const RegionShape& shape_;
  const Progress& progress_;
  const char* stage_;
  std::size_t row_, slice_, done_ = 0;
  std::vector<std::uint32_t> open_;
};

}  // namespace

std::vector<std::size_t> keep_largest(std::vector<std::uint8_t>& mask, const RegionShape& shape,
                                      const Progress& progress) {
  Flood flood(mask, shape, progress, "connected pieces");
  std::vector<std::size_t> sizes;
  std::size_t most = 0, first = 0;
  for (std::size_t voxel = 0; voxel < mask.size(); ++voxel) {
    if (mask[voxel] != kInside) continue;
    sizes.push_back(flood.fill(voxel, kInside, kSeen));
    if (sizes.back() > most) most = sizes.back(), first = voxel;
  }
  if (most > 0) flood.fill(first, kSeen, kKept);
  for (std::uint8_t& voxel : mask) voxel = voxel == kKept ? kInside : kOutside;
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

std::size_t fill_holes(std::vector<std::uint8_t>& mask, const RegionShape& shape, const Progress& progress) {
  Flood flood(mask, shape, progress, "filling holes");
  for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
    if (mask[voxel] == kOutside && flood.on_border(voxel)) flood.fill(voxel, kOutside, kSeen);
  const auto filled = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), kOutside));
  for (std::uint8_t& voxel : mask) voxel = voxel == kSeen ? kOutside : kInside;
  return filled;
}

std::int64_t tunnels_of(const std::vector<std::uint8_t>& mask, const RegionShape& shape) {
  const auto [nx, ny, nz] = shape.size;
  const auto at = [&](int i, int j, int k) -> std::int64_t {
    if (i >= nx || j >= ny || k >= nz) return 0;
    return mask[static_cast<std::size_t>(i) +
                static_cast<std::size_t>(nx) *
                    (static_cast<std::size_t>(j) + static_cast<std::size_t>(ny) * static_cast<std::size_t>(k))];
  };
  std::int64_t euler = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (at(i, j, k) == 0) continue;
        const std::int64_t x = at(i + 1, j, k), y = at(i, j + 1, k), z = at(i, j, k + 1);
        const std::int64_t xy = x * y * at(i + 1, j + 1, k), yz = y * z * at(i, j + 1, k + 1),
                           xz = x * z * at(i + 1, j, k + 1);
        euler += 1 - (x + y + z) + (xy + yz + xz) - xy * yz * xz * at(i + 1, j + 1, k + 1);
      }
  return 1 - euler;
}

}  // namespace trocar
