#include "tissue/imaging/labels/label_mask.h"

#include <algorithm>
#include <string>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kFewestVoxels = 8;

struct VoxelBox {
  std::array<int, 3> low{1 << 30, 1 << 30, 1 << 30};
  std::array<int, 3> high{-1, -1, -1};
};

VoxelBox bounding_box(const LabelVolume& volume, int label) {
  VoxelBox box;
  std::size_t voxel = 0;
  std::array<int, 3> index{};
  for (index[2] = 0; index[2] < volume.size[2]; ++index[2])
    for (index[1] = 0; index[1] < volume.size[1]; ++index[1])
      for (index[0] = 0; index[0] < volume.size[0]; ++index[0], ++voxel) {
        if (volume.labels[voxel] != label) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.low[axis] = std::min(box.low[axis], index[axis]);
          box.high[axis] = std::max(box.high[axis], index[axis]);
        }
      }
  return box;
}

LabelMask copy_box(const LabelVolume& volume, int label, const VoxelBox& box, int margin) {
  LabelMask mask;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mask.first[axis] = box.low[axis] - margin;
    mask.size[axis] = box.high[axis] - box.low[axis] + 1 + 2 * margin;
  }
  mask.inside.assign(mask.offset(0, 0, mask.size[2]), 0);
  for (int k = margin; k < mask.size[2] - margin; ++k)
    for (int j = margin; j < mask.size[1] - margin; ++j)
      for (int i = margin; i < mask.size[0] - margin; ++i) {
        const bool set = volume.labels[volume.offset(i + mask.first[0], j + mask.first[1], k + mask.first[2])] == label;
        mask.inside[mask.offset(i, j, k)] = set ? 1 : 0;
        mask.label_voxels += set ? 1 : 0;
      }
  return mask;
}

/// Face-connected parts of the voxels whose value is `value`: part number of each voxel (0: another value), sizes.
/// Parts are numbered in the order of their first voxels.
struct Parts {
  std::vector<std::int32_t> number;
  std::vector<std::size_t> voxels{0};  ///< index 0 unused
};

/// Voxels of one row that follow each other, and the run they were joined to; the root of a set is its first run.
struct Run {
  std::size_t begin, end;
  std::size_t parent;
};

std::size_t root_of(std::vector<Run>& runs, std::size_t run) {
  while (runs[run].parent != run) run = runs[run].parent = runs[runs[run].parent].parent;
  return run;
}

/// The runs of one value, row by row; `first[row]` is the row's first one, and one entry more at the end.
std::vector<Run> runs_of(const LabelMask& mask, std::uint8_t value, std::vector<std::size_t>& first) {
  const auto row = static_cast<std::size_t>(mask.size[0]);
  std::vector<Run> runs;
  for (std::size_t start = 0; start < mask.inside.size(); start += row) {
    first.push_back(runs.size());
    const auto begin = mask.inside.begin() + static_cast<std::ptrdiff_t>(start),
               end = begin + static_cast<std::ptrdiff_t>(row);
    const auto offset = [&](auto voxel) { return start + static_cast<std::size_t>(voxel - begin); };
    for (auto from = std::find(begin, end, value); from != end;) {
      const auto to = std::find_if(from, end, [value](std::uint8_t other) { return other != value; });
      runs.push_back({offset(from), offset(to), runs.size()});
      from = std::find(to, end, value);
    }
  }
  first.push_back(runs.size());
  return runs;
}

/// Joins the runs of two rows, `apart` voxels from each other, where they touch.
void join_rows(std::vector<Run>& runs, std::array<std::size_t, 2> earlier, std::array<std::size_t, 2> later,
               std::size_t apart) {
  auto [a, a_end] = earlier;
  auto [b, b_end] = later;
  while (a < a_end && b < b_end) {
    if (runs[a].begin + apart < runs[b].end && runs[b].begin < runs[a].end + apart) {
      const std::size_t x = root_of(runs, a), y = root_of(runs, b);
      runs[std::max(x, y)].parent = std::min(x, y);
    }
    ++(runs[a].end + apart < runs[b].end ? a : b);
  }
}

Parts connected_parts(const LabelMask& mask, std::uint8_t value) {
  std::vector<std::size_t> first;
  std::vector<Run> runs = runs_of(mask, value, first);
  const auto row = static_cast<std::size_t>(mask.size[0]), rows = static_cast<std::size_t>(mask.size[1]);
  for (std::size_t n = 0; n + 1 < first.size(); ++n) {
    if (n % rows > 0) join_rows(runs, {first[n - 1], first[n]}, {first[n], first[n + 1]}, row);
    if (n >= rows) join_rows(runs, {first[n - rows], first[n - rows + 1]}, {first[n], first[n + 1]}, row * rows);
  }
  Parts parts;
  parts.number.assign(mask.inside.size(), 0);
  for (std::size_t n = 0; n < runs.size(); ++n) {
    const std::size_t root = root_of(runs, n);
    std::int32_t& number = parts.number[runs[root].begin];  // the root comes first
    if (root == n) number = static_cast<std::int32_t>(parts.voxels.size()), parts.voxels.push_back(0);
    parts.voxels[static_cast<std::size_t>(number)] += runs[n].end - runs[n].begin;
    std::fill_n(parts.number.begin() + static_cast<std::ptrdiff_t>(runs[n].begin), runs[n].end - runs[n].begin,
                std::int32_t{number});
  }
  return parts;
}

/// Fewest background voxels that connect two parts over faces.
struct Gap {
  std::array<std::size_t, 2> voxels{};  ///< the same one twice when one is enough
  std::int32_t first = 0, second = 0;   ///< parts
  int length() const { return voxels[0] == voxels[1] ? 1 : 2; }
};

/// Parts that a background voxel touches over its faces, each once.
std::vector<std::int32_t> touched(const LabelMask& mask, const Parts& parts, std::size_t voxel) {
  const std::size_t row = static_cast<std::size_t>(mask.size[0]), slice = row * static_cast<std::size_t>(mask.size[1]);
  std::vector<std::int32_t> result;
  for (const std::size_t neighbour : {voxel - 1, voxel + 1, voxel - row, voxel + row, voxel - slice, voxel + slice})
    if (parts.number[neighbour] != 0 &&
        std::find(result.begin(), result.end(), parts.number[neighbour]) == result.end())
      result.push_back(parts.number[neighbour]);
  return result;
}

/// Gaps of one voxel, then of two, in voxel order. Voxels on the box's border are left out: they lie in the margin.
std::vector<Gap> gaps_of(const LabelMask& mask, const Parts& parts, int longest) {
  const std::size_t row = static_cast<std::size_t>(mask.size[0]), slice = row * static_cast<std::size_t>(mask.size[1]);
  std::vector<Gap> single, twice;
  for (int k = 1; k + 2 < mask.size[2]; ++k)
    for (int j = 1; j + 2 < mask.size[1]; ++j)
      for (int i = 1; i + 2 < mask.size[0]; ++i) {
        const std::size_t voxel = mask.offset(i, j, k);
        if (mask.inside[voxel] != 0) continue;
        const auto here = touched(mask, parts, voxel);
        for (std::size_t n = 1; n < here.size(); ++n) single.push_back({{voxel, voxel}, here[0], here[n]});
        if (here.empty() || longest < 2) continue;
        for (const std::size_t next : {voxel + 1, voxel + row, voxel + slice})
          if (mask.inside[next] == 0)
            for (const auto there : touched(mask, parts, next))
              for (const auto part : here)
                if (part != there) twice.push_back({{voxel, next}, part, there});
      }
  if (longest < 1) single.clear();
  single.insert(single.end(), twice.begin(), twice.end());
  return single;
}

/// Joins parts over gaps; `root[part]` then names the smallest part of each joined group.
std::vector<std::int32_t> bridge(LabelMask& mask, Parts& parts, int longest) {
  std::vector<std::int32_t> root(parts.voxels.size());
  for (std::size_t n = 0; n < root.size(); ++n) root[n] = static_cast<std::int32_t>(n);
  if (parts.voxels.size() <= 2) return root;
  for (const Gap& gap : gaps_of(mask, parts, longest)) {
    const std::int32_t a = root[static_cast<std::size_t>(gap.first)], b = root[static_cast<std::size_t>(gap.second)];
    if (a == b) continue;
    std::replace(root.begin(), root.end(), std::max(a, b), std::min(a, b));
    for (int n = 0; n < gap.length(); ++n) {
      const std::size_t voxel = gap.voxels[static_cast<std::size_t>(n)];
      if (parts.number[voxel] != 0) continue;
      parts.number[voxel] = gap.first;
      ++parts.voxels[static_cast<std::size_t>(gap.first)];
      mask.inside[voxel] = 1;
      ++mask.bridge_voxels;
    }
  }
  return root;
}

/// Keeps the groups of parts that the rule keeps, empties the others.
/// @throws InputError when even the largest has too few voxels
void keep_parts(LabelMask& mask, const PartsRule& rule, int label) {
  Parts parts = connected_parts(mask, 1);
  const auto root = bridge(mask, parts, rule.only_largest ? 0 : std::min(rule.bridge_voxels, 2));
  std::vector<std::size_t> voxels(parts.voxels.size(), 0);
  for (std::size_t part = 1; part < root.size(); ++part)
    voxels[static_cast<std::size_t>(root[part])] += parts.voxels[part];
  const auto largest = static_cast<std::size_t>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
  if (voxels[largest] < kFewestVoxels)
    throw InputError("label " + std::to_string(label) + ": its largest part has only " +
                     std::to_string(voxels[largest]) + (voxels[largest] == 1 ? " voxel" : " voxels") + ", and " +
                     std::to_string(kFewestVoxels) + " are needed");
  const double least =
      std::max(static_cast<double>(kFewestVoxels), rule.least_share * static_cast<double>(mask.label_voxels));
  std::vector<bool> kept(voxels.size(), false);
  mask.parts = 0;
  for (std::size_t part = 1; part < voxels.size(); ++part) {
    kept[part] = part == largest || (!rule.only_largest && static_cast<double>(voxels[part]) >= least);
    if (kept[part]) ++mask.parts;
    if (!kept[part] && voxels[part] > 0) mask.lost_parts.push_back(voxels[part]);
  }
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
    if (mask.inside[voxel] != 0 && !kept[static_cast<std::size_t>(root[static_cast<std::size_t>(parts.number[voxel])])])
      mask.inside[voxel] = 0;
  std::sort(mask.lost_parts.rbegin(), mask.lost_parts.rend());
}

/// Background that does not hang together with the box's corner becomes inside.
void fill_cavities(LabelMask& mask) {
  const Parts parts = connected_parts(mask, 0);
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
    if (parts.number[voxel] > 1) mask.inside[voxel] = 1;  // the corner voxel lies in the margin: part 1 is outside
  for (std::size_t part = 2; part < parts.voxels.size(); ++part) mask.cavities.push_back(parts.voxels[part]);
  std::sort(mask.cavities.rbegin(), mask.cavities.rend());
}

void count_kept(LabelMask& mask, const LabelVolume& volume) {
  std::array<int, 3> index{};
  std::size_t voxel = 0;
  for (index[2] = 0; index[2] < mask.size[2]; ++index[2])
    for (index[1] = 0; index[1] < mask.size[1]; ++index[1])
      for (index[0] = 0; index[0] < mask.size[0]; ++index[0], ++voxel) {
        if (mask.inside[voxel] == 0) continue;
        ++mask.kept_voxels;
        bool outermost = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int place = index[axis] + mask.first[axis];
          outermost = outermost || place == 0 || place == volume.size[axis] - 1;
          if (place == 0) mask.cut[axis][0] = true;
          if (place == volume.size[axis] - 1) mask.cut[axis][1] = true;
        }
        mask.border_voxels += outermost ? 1 : 0;
      }
}

}  // namespace

LabelMask cut_out_label(const LabelVolume& volume, int label, int margin, const PartsRule& rule) {
  const VoxelBox box = bounding_box(volume, label);
  if (box.high[0] < 0) throw InputError("label " + std::to_string(label) + " marks no voxel");
  LabelMask mask = copy_box(volume, label, box, margin);
  keep_parts(mask, rule, label);
  fill_cavities(mask);
  count_kept(mask, volume);
  return mask;
}

}  // namespace trocar
