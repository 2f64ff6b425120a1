// The steps that ITK does, against the same steps done one voxel at a time.
#include "tissue/imaging/labels/itk_region.h"
#include "tissue/imaging/labels/mask_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trocar::itk_region_test {
namespace {

using Mask = std::vector<std::uint8_t>;

const RegionShape kShape{{9, 8, 7}, {1, 0.8, 2}};

std::size_t at(int i, int j, int k) { return static_cast<std::size_t>(i + 9 * (j + 8 * k)); }

Mask random_mask(std::uint64_t seed, int percent) {
  std::mt19937_64 random(seed);
  Mask mask(9 * 8 * 7);
  for (std::uint8_t& voxel : mask) voxel = random() % 100 < static_cast<std::uint64_t>(percent) ? 1 : 0;
  return mask;
}

/// Face-connected pieces of the voxels that hold `value`, by repeated sweeps: slow and plain.
std::vector<int> pieces_of(const Mask& mask, std::uint8_t value) {
  std::vector<int> piece(mask.size(), 0);
  int count = 0;
  for (std::size_t n = 0; n < mask.size(); ++n)
    if (mask[n] == value) piece[n] = ++count;
  for (bool changed = true; changed;) {
    changed = false;
    for (int k = 0; k < 7; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 9; ++i) {
          if (piece[at(i, j, k)] == 0) continue;
          const auto join = [&](int a, int b, int c) {
            if (a >= 9 || b >= 8 || c >= 7 || piece[at(a, b, c)] == 0 || piece[at(a, b, c)] == piece[at(i, j, k)])
              return;
            const int low = std::min(piece[at(a, b, c)], piece[at(i, j, k)]);
            piece[at(a, b, c)] = piece[at(i, j, k)] = low;
            changed = true;
          };
          join(i + 1, j, k), join(i, j + 1, k), join(i, j, k + 1);
        }
  }
  return piece;
}

TEST(ItkRegion, WindowIncludesBothEnds) {
  const std::vector<float> values{-1, 0, 0.5F, 1, 1.0001F, 2, 3, 4};
  EXPECT_EQ(window_mask(values, {{2, 2, 2}, {1, 1, 1}}, 0, 1), (Mask{0, 1, 1, 1, 0, 0, 0, 0}));
}

TEST(ItkRegion, ConnectedPieceIsThatOfTheSeed) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mask mask = random_mask(seed, 45);
    const std::vector<int> piece = pieces_of(mask, 1);
    for (int k = 0; k < 7; k += 3)
      for (int i = 0; i < 9; i += 4) {
        if (mask[at(i, 4, k)] == 0) continue;
        Mask kept = mask;
        keep_connected(kept, kShape, {i, 4, k});
        for (std::size_t n = 0; n < mask.size(); ++n) EXPECT_EQ(kept[n] == 1, piece[n] == piece[at(i, 4, k)]);
      }
  }
}

TEST(ItkRegion, LargestPieceAndAllSizes) {
  for (std::uint64_t seed = 11; seed <= 15; ++seed) {
    const Mask mask = random_mask(seed, 30);
    const std::vector<int> piece = pieces_of(mask, 1);
    std::vector<std::size_t> sizes(mask.size() + 1, 0);
    for (const int number : piece)
      if (number > 0) ++sizes[static_cast<std::size_t>(number)];
    std::sort(sizes.rbegin(), sizes.rend());
    sizes.erase(std::find(sizes.begin(), sizes.end(), 0U), sizes.end());
    Mask kept = mask;
    EXPECT_EQ(keep_largest(kept, kShape), sizes);
    EXPECT_EQ(static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 1)), sizes.front());
    const auto first = static_cast<std::size_t>(std::find(kept.begin(), kept.end(), 1) - kept.begin());
    for (std::size_t n = 0; n < mask.size(); ++n) EXPECT_EQ(kept[n] == 1, piece[n] == piece[first]);
  }
  Mask empty(9 * 8 * 7, 0);
  EXPECT_TRUE(keep_largest(empty, kShape).empty());
}

TEST(ItkRegion, HolesAreBackgroundThatDoesNotReachTheBorder) {
  for (std::uint64_t seed = 21; seed <= 25; ++seed) {
    const Mask mask = random_mask(seed, 80);
    const std::vector<int> piece = pieces_of(mask, 0);
    std::vector<bool> open(mask.size() + 1, false);
    for (int k = 0; k < 7; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 9; ++i)
          if (i == 0 || j == 0 || k == 0 || i == 8 || j == 7 || k == 6)
            open[static_cast<std::size_t>(piece[at(i, j, k)])] = true;
    Mask filled = mask;
    const std::size_t count = fill_holes(filled, kShape);
    std::size_t wanted = 0;
    for (std::size_t n = 0; n < mask.size(); ++n) {
      const bool hole = mask[n] == 0 && !open[static_cast<std::size_t>(piece[n])];
      wanted += hole ? 1 : 0;
      EXPECT_EQ(filled[n], mask[n] == 1 || hole ? 1 : 0);
    }
    EXPECT_EQ(count, wanted);
  }
}

TEST(ItkRegion, OpeningTakesOnlyAndClosingGivesOnly) {
  const Mask mask = random_mask(31, 60);
  Mask opened = mask, closed = mask;
  erode(opened, kShape, 1.1), dilate(opened, kShape, 1.1);
  dilate(closed, kShape, 1.1), erode(closed, kShape, 1.1);
  for (std::size_t n = 0; n < mask.size(); ++n) {
    EXPECT_LE(opened[n], mask[n]);
    EXPECT_GE(closed[n], mask[n]);
  }
  Mask twice = opened;
  erode(twice, kShape, 1.1), dilate(twice, kShape, 1.1);
  EXPECT_EQ(twice, opened);  // an opened mask has nothing left to take
}

TEST(ItkRegion, CurvatureFlowCalmsNoiseAndKeepsStepsAndLevels) {
  const RegionShape shape{{24, 24, 24}, {1, 1, 1}};
  std::mt19937_64 random(7);
  std::normal_distribution<float> noise(0, 20);
  std::vector<float> level(24 * 24 * 24, 50), noisy;
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) noisy.push_back((i < 12 ? 0.0F : 200.0F) + noise(random));
  const auto spread = [&](const std::vector<float>& values, int from, int to) {
    double sum = 0, squares = 0;
    int count = 0;
    for (std::size_t n = 0; n < values.size(); ++n) {
      const int i = static_cast<int>(n % 24);
      if (i < from || i >= to) continue;
      sum += values[n], squares += values[n] * values[n], ++count;
    }
    return std::pair(sum / count, std::sqrt(squares / count - sum / count * sum / count));
  };
  const double before = spread(noisy, 2, 9).second;
  curvature_flow(noisy, shape, 5);
  EXPECT_LT(spread(noisy, 2, 9).second, 0.7 * before);
  EXPECT_NEAR(spread(noisy, 2, 9).first, 0, 3);
  EXPECT_NEAR(spread(noisy, 15, 22).first, 200, 3);
  EXPECT_GT(spread(noisy, 12, 13).first - spread(noisy, 11, 12).first, 120);  // the step stays a step
  curvature_flow(level, shape, 5);
  for (const float value : level) EXPECT_EQ(value, 50);
}

}  // namespace
}  // namespace trocar::itk_region_test
