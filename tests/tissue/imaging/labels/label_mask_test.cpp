#include "tissue/imaging/labels/label_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::label_mask_test {
namespace {

LabelVolume empty_volume() {
  LabelVolume volume;
  volume.size = {14, 12, 10};
  volume.labels.assign(volume.offset(0, 0, 10), 0);
  return volume;
}

void fill(LabelVolume& volume, std::array<int, 3> low, std::array<int, 3> high, std::uint16_t label) {
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) volume.labels[volume.offset(i, j, k)] = label;
}

TEST(LabelMask, KeepsTheLargestPartAndCountsTheLost) {
  LabelVolume volume = empty_volume();
  fill(volume, {1, 1, 1}, {4, 4, 4}, 2);    // 64
  fill(volume, {8, 8, 8}, {9, 9, 8}, 2);    // 4
  fill(volume, {12, 1, 1}, {12, 1, 1}, 2);  // 1
  fill(volume, {5, 5, 5}, {5, 5, 5}, 2);    // 1, touches only over an edge
  fill(volume, {1, 1, 6}, {13, 4, 7}, 3);   // another organ
  const LabelMask mask = cut_out_label(volume, 2, 2);
  EXPECT_EQ(mask.label_voxels, 70U);
  EXPECT_EQ(mask.kept_voxels, 64U);
  EXPECT_EQ(mask.lost_parts, (std::vector<std::size_t>{4, 1, 1}));
  EXPECT_TRUE(mask.cavities.empty());
  EXPECT_EQ(mask.border_voxels, 0U);
  EXPECT_EQ(std::accumulate(mask.inside.begin(), mask.inside.end(), 0), 64);
  EXPECT_EQ(mask.inside[mask.offset(1 - mask.first[0], 1 - mask.first[1], 1 - mask.first[2])], 1);
}

/// Sizes of the parts of one value over a fixed margin, by growing each from a voxel: largest first.
std::vector<std::size_t> grown_parts(const LabelMask& grid, std::uint8_t value) {
  std::vector<bool> seen(grid.inside.size(), false);
  std::vector<std::size_t> sizes;
  const std::ptrdiff_t row = grid.size[0], slice = row * grid.size[1];
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (seen[seed] || grid.inside[seed] != value) continue;
    std::vector<std::size_t> open{seed};
    seen[seed] = true;
    for (std::size_t n = 0; n < open.size(); ++n)
      for (const std::ptrdiff_t step : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}, -row, row, -slice, slice}) {
        const std::size_t next = open[n] + static_cast<std::size_t>(step);  // wraps into the empty margin at worst
        if (next >= seen.size() || seen[next] || grid.inside[next] != value) continue;
        seen[next] = true, open.push_back(next);
      }
    sizes.push_back(open.size());
  }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

/// Noise at the density where parts of all sizes and forms occur.
TEST(LabelMask, PartsAndCavitiesOfNoiseAreThoseThatGrowFromAVoxel) {
  std::mt19937 engine(3);
  for (const unsigned percent : {20U, 30U, 35U, 60U, 75U}) {
    LabelVolume volume = empty_volume();
    for (auto& label : volume.labels) label = engine() % 100 < percent ? 1 : 0;
    fill(volume, {0, 0, 0}, {2, 2, 2}, 1);  // a part of 8 voxels at least; the box is the whole volume
    fill(volume, {13, 11, 9}, {13, 11, 9}, 1);
    LabelMask grid;
    grid.size = {18, 16, 14};
    grid.inside.assign(grid.offset(0, 0, 14), 0);
    for (int k = 0; k < 10; ++k)
      for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 14; ++i)
          grid.inside[grid.offset(i + 2, j + 2, k + 2)] =
              static_cast<std::uint8_t>(volume.labels[volume.offset(i, j, k)]);
    const LabelMask mask = cut_out_label(volume, 1, 2);
    const auto parts = grown_parts(grid, 1);
    ASSERT_EQ(mask.inside.size(), grid.inside.size());
    EXPECT_EQ(mask.lost_parts, std::vector<std::size_t>(parts.begin() + 1, parts.end())) << percent << " %";
    EXPECT_EQ(mask.kept_voxels, parts[0] + std::accumulate(mask.cavities.begin(), mask.cavities.end(), std::size_t{0}));
    EXPECT_EQ(grown_parts(mask, 1), std::vector<std::size_t>{mask.kept_voxels});
    EXPECT_EQ(grown_parts(mask, 0).size(), 1U) << "a cavity was left";
  }
}

TEST(LabelMask, FillsCavitiesAndNamesTheirSizes) {
  LabelVolume volume = empty_volume();
  fill(volume, {2, 2, 2}, {9, 9, 8}, 5);
  fill(volume, {3, 3, 3}, {3, 3, 3}, 0);
  fill(volume, {6, 6, 5}, {7, 6, 5}, 9);  // another label inside counts as a cavity too
  fill(volume, {9, 5, 5}, {9, 5, 5}, 0);  // a dent, open to the outside
  const LabelMask mask = cut_out_label(volume, 5, 1);
  EXPECT_EQ(mask.cavities, (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(mask.kept_voxels, mask.label_voxels + 3);
}

TEST(LabelMask, CountsVoxelsInTheOutermostSlices) {
  LabelVolume volume = empty_volume();
  fill(volume, {3, 3, 6}, {6, 5, 9}, 1);  // 4 x 3 voxels in the top slice
  EXPECT_EQ(cut_out_label(volume, 1, 3).border_voxels, 12U);
  fill(volume, {0, 3, 6}, {2, 5, 9}, 1);  // and on to the left wall: 7 x 3 + 3 x 4 - 3
  EXPECT_EQ(cut_out_label(volume, 1, 3).border_voxels, 30U);
}

TEST(LabelMask, LeavesAnEmptyMarginEvenAtTheBorder) {
  LabelVolume volume = empty_volume();
  fill(volume, {0, 0, 0}, {13, 11, 9}, 1);
  const LabelMask mask = cut_out_label(volume, 1, 2);
  EXPECT_EQ(mask.size, (std::array<int, 3>{18, 16, 14}));
  EXPECT_EQ(mask.first, (std::array<int, 3>{-2, -2, -2}));
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 18; ++i) EXPECT_EQ(mask.inside[mask.offset(i, j, 1)] + mask.inside[mask.offset(i, j, 12)], 0);
}

TEST(LabelMask, RefusesAbsentAndTinyLabels) {
  LabelVolume volume = empty_volume();
  fill(volume, {1, 1, 1}, {1, 1, 7}, 4);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { cut_out_label(volume, 3, 1); }), "label 3 marks no voxel");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { cut_out_label(volume, 4, 1); }), "only 7 voxels");
}

}  // namespace
}  // namespace trocar::label_mask_test
