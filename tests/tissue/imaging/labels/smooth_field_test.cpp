#include "tissue/imaging/labels/smooth_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace trocar::smooth_field_test {
namespace {

LabelMask block(std::array<int, 3> extent) {
  LabelMask mask;
  for (std::size_t axis = 0; axis < 3; ++axis) mask.size[axis] = extent[axis] + 2 * kSmoothingMargin;
  mask.inside.assign(mask.offset(0, 0, mask.size[2]), 0);
  for (int k = 0; k < extent[2]; ++k)
    for (int j = 0; j < extent[1]; ++j)
      for (int i = 0; i < extent[0]; ++i)
        mask.inside[mask.offset(i + kSmoothingMargin, j + kSmoothingMargin, k + kSmoothingMargin)] = 1;
  return mask;
}

TEST(SmoothField, KeepsTheSumAndTheRange) {
  const ScalarField field = smooth_field(block({9, 8, 7}), {});
  EXPECT_NEAR(std::accumulate(field.values.begin(), field.values.end(), 0.0), 9 * 8 * 7, 1e-2);  // float32 sums
  for (const float value : field.values) {
    EXPECT_GE(value, -1e-6F);
    EXPECT_LE(value, 1 + 1e-5F);
  }
}

TEST(SmoothField, FallsThroughOneHalfAtAFlatFace) {
  const LabelMask mask = block({15, 15, 15});
  const ScalarField field = smooth_field(mask, {});
  const int middle = kSmoothingMargin + 7;
  const double inside = field.values[field.offset(kSmoothingMargin, middle, middle)];
  const double outside = field.values[field.offset(kSmoothingMargin - 1, middle, middle)];
  EXPECT_NEAR(inside + outside, 1, 1e-5);  // the face lies half-way between the two samples
  EXPECT_GT(inside, 0.5);
}

/// The Gaussian of a block is the product of three sums of the kernel along the axes.
TEST(SmoothField, IsTheProductOfItsAxes) {
  const std::array<int, 3> extent{9, 12, 7};
  constexpr double kSigma = 0.65;
  constexpr int kReach = 3;  // ceil(3.5 sigma)
  double sum = 0;
  for (int n = -kReach; n <= kReach; ++n) sum += std::exp(-0.5 * n * n / (kSigma * kSigma));
  const auto along = [&](std::size_t axis, int place) {
    double inside = 0;
    for (int n = -kReach; n <= kReach; ++n)
      if (const int from = place + n - kSmoothingMargin; from >= 0 && from < extent[axis])
        inside += std::exp(-0.5 * n * n / (kSigma * kSigma));
    return inside / sum;
  };
  const ScalarField field = smooth_field(block(extent), {});
  for (int k = 0; k < field.size[2]; ++k)
    for (int j = 0; j < field.size[1]; ++j)
      for (int i = 0; i < field.size[0]; ++i)
        ASSERT_NEAR(field.values[field.offset(i, j, k)], along(0, i) * along(1, j) * along(2, k), 2e-6)
            << i << ' ' << j << ' ' << k;
}

/// Two steps along every axis from a voxel all of whose neighbours are inside, looked for voxel by voxel.
TEST(SmoothField, ThinVoxelsAreThoseFarFromAnyCore) {
  std::mt19937 engine(11);
  LabelMask mask = block({14, 12, 10});
  for (auto& voxel : mask.inside) voxel = voxel != 0 && engine() % 100 < 85 ? 1 : 0;
  const auto inside = [&](int i, int j, int k) { return mask.inside[mask.offset(i, j, k)] != 0; };
  const auto core = [&](int i, int j, int k) {
    return inside(i, j, k) && inside(i - 1, j, k) && inside(i + 1, j, k) && inside(i, j - 1, k) &&
           inside(i, j + 1, k) && inside(i, j, k - 1) && inside(i, j, k + 1);
  };
  const auto near_core = [&](int i, int j, int k) {
    for (int n = 0; n < 125; ++n)
      if (core(i + n % 5 - 2, j + n / 5 % 5 - 2, k + n / 25 - 2)) return true;
    return false;
  };
  std::size_t thin = 0;
  for (int k = kSmoothingMargin; k < kSmoothingMargin + 10; ++k)
    for (int j = kSmoothingMargin; j < kSmoothingMargin + 12; ++j)
      for (int i = kSmoothingMargin; i < kSmoothingMargin + 14; ++i)
        thin += inside(i, j, k) && !near_core(i, j, k) ? 1 : 0;
  EXPECT_GT(thin, 0U);
  EXPECT_EQ(count_thin_voxels(mask), thin);
}

TEST(SmoothField, VanishesAtTheBorderOfTheBox) {
  const ScalarField field = smooth_field(block({5, 5, 5}), {});
  for (int j = 0; j < field.size[1]; ++j)
    for (int i = 0; i < field.size[0]; ++i) EXPECT_EQ(field.values[field.offset(i, j, 0)], 0.0F);
}

TEST(SmoothField, ThinPartsKeepTheirCore) {
  const int middle = kSmoothingMargin + 10;
  const ScalarField rod = smooth_field(block({21, 1, 1}), {});
  const ScalarField melted = smooth_field(block({21, 1, 1}), {.broad = 0.8, .thin = 0.8});
  EXPECT_GT(rod.values[rod.offset(middle, kSmoothingMargin, kSmoothingMargin)], 0.5F);
  EXPECT_LT(melted.values[melted.offset(middle, kSmoothingMargin, kSmoothingMargin)], 0.3F);
}

TEST(SmoothField, ThickPartsAreNotTouchedByTheThinRule) {
  const ScalarField one = smooth_field(block({9, 9, 9}), {.broad = 0.8, .thin = 0.4});
  const ScalarField two = smooth_field(block({9, 9, 9}), {.broad = 0.8, .thin = 0.8});
  EXPECT_EQ(one.values, two.values);
}

}  // namespace
}  // namespace trocar::smooth_field_test
