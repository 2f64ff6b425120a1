#include "tissue/imaging/smooth_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace trocar {
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
}  // namespace trocar
