// What the phantom's tests ask of a label map: parts, neighbours, volumes and mean HU.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "tissue/imaging/phantom/phantom.h"

namespace trocar::test {

using Count = std::map<int, std::size_t>;

/// Calls visit(offset, neighbour's offset) for each of the up to six neighbours of a voxel.
template <typename Visit>
void for_each_neighbour(const LabelVolume& volume, std::size_t at, Visit visit) {
  const std::array<std::size_t, 3> size{static_cast<std::size_t>(volume.size[0]),
                                        static_cast<std::size_t>(volume.size[1]),
                                        static_cast<std::size_t>(volume.size[2])};
  const std::array<std::size_t, 3> stride{1, size[0], size[0] * size[1]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t index = at / stride[axis] % size[axis];
    if (index > 0) visit(at, at - stride[axis]);
    if (index + 1 < size[axis]) visit(at, at + stride[axis]);
  }
}

/// Parts of every label, hanging together over voxel faces.
inline Count parts_of(const LabelVolume& volume) {
  Count parts;
  std::vector<bool> seen(volume.labels.size());
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++parts[volume.labels[start]];
    std::vector<std::size_t> queue{start};
    seen[start] = true;
    while (!queue.empty()) {
      const std::size_t from = queue.back();
      queue.pop_back();
      for_each_neighbour(volume, from, [&](std::size_t a, std::size_t b) {
        if (seen[b] || volume.labels[a] != volume.labels[b]) return;
        seen[b] = true;
        queue.push_back(b);
      });
    }
  }
  return parts;
}

/// Faces that a label shares with every other label.
inline std::map<int, Count> contacts_of(const LabelVolume& volume) {
  std::map<int, Count> contacts;
  for (std::size_t at = 0; at < volume.labels.size(); ++at)
    for_each_neighbour(volume, at, [&](std::size_t a, std::size_t b) {
      if (volume.labels[a] != volume.labels[b]) ++contacts[volume.labels[a]][volume.labels[b]];
    });
  return contacts;
}

/// Euler number of a label whose voxels hang together over faces: parts - tunnels + cavities.
inline long euler_number(const LabelVolume& volume, int label) {
  long number = 0;
  const auto holds = [&](int i, int j, int k) { return volume.labels[volume.offset(i, j, k)] == label; };
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        if (!holds(i, j, k)) continue;
        for (int box = 0; box < 8; ++box) {  // voxels, pairs, squares and cubes that start here
          bool full = true;
          for (int corner = 0; corner < 8 && full; ++corner) {
            if ((corner & ~box) != 0) continue;
            const int x = i + (corner & 1), y = j + (corner >> 1 & 1), z = k + (corner >> 2);
            full = x < volume.size[0] && y < volume.size[1] && z < volume.size[2] && holds(x, y, z);
          }
          const int dimension = (box & 1) + (box >> 1 & 1) + (box >> 2);
          number += full ? (dimension % 2 == 0 ? 1 : -1) : 0;
        }
      }
  return number;
}

inline double mean_hounsfield(const CtPhantom& phantom, int label) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < phantom.hounsfield.size(); ++n)
    if (phantom.labels.labels[n] == label) sum += phantom.hounsfield[n], ++count;
  return sum / count;
}

/// Mean HU of the voxels whose six neighbours carry the label too: without partial volume.
inline double core_hounsfield(const CtPhantom& phantom, int label) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < phantom.hounsfield.size(); ++n) {
    bool inner = phantom.labels.labels[n] == label;
    for_each_neighbour(phantom.labels, n,
                       [&](std::size_t, std::size_t b) { inner = inner && phantom.labels.labels[b] == label; });
    if (inner) sum += phantom.hounsfield[n], ++count;
  }
  return sum / count;
}

/// FNV-1a of where a label lies, over the slices from `lowest_mm` up.
inline std::uint64_t mask_hash(const LabelVolume& volume, int label, double lowest_mm) {
  const std::size_t plane = static_cast<std::size_t>(volume.size[0]) * static_cast<std::size_t>(volume.size[1]);
  const double step = volume.index_to_ras_mm.linear()(2, 2), low = volume.index_to_ras_mm.translation().z();
  const auto first = static_cast<std::size_t>(std::lround((lowest_mm - low) / step));
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t n = first * plane; n < volume.labels.size(); ++n)
    hash = (hash ^ (volume.labels[n] == label ? 1U : 0U)) * 1099511628211ULL;
  return hash;
}

inline PhantomTube tube_of(const std::vector<PhantomTube>& tubes, int label) {
  for (const PhantomTube& tube : tubes)
    if (tube.label == label) return tube;
  return {};
}

/// Least distance between the walls of two tubes, and where on the first.
struct Gap {
  double mm = 1e9;
  Eigen::Vector3d at_first, at_second;
};

inline Gap gap_between(const PhantomTube& a, const PhantomTube& b) {
  Gap gap;
  for (std::size_t n = 0; n < a.points_mm.size(); ++n)
    for (std::size_t m = 0; m < b.points_mm.size(); ++m) {
      const double mm = (a.points_mm[n] - b.points_mm[m]).norm() - a.radii_mm[n] - b.radii_mm[m];
      if (mm < gap.mm) gap = {mm, a.points_mm[n], b.points_mm[m]};
    }
  return gap;
}

}  // namespace trocar::test
