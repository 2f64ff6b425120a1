// The common outline of neighbours: slits close, interfaces stay, lone organs are left as they are.
#include "tissue/mesh/complex/scene_fields.h"

#include <gtest/gtest.h>

namespace trocar::scene_fields_test {
namespace {

constexpr int kLength = 12;

/// A row of samples, one field on all of it.
RegionField row(const std::vector<float>& values) {
  RegionField field;
  field.field.size = {static_cast<int>(values.size()), 1, 1};
  field.field.values = values;
  return field;
}

TEST(SceneFields, ALoneOrganIsLeftAsItIs) {
  std::vector<RegionField> fields{row({0, 0.2F, 0.7F, 1}), row({0, 0, 0, 0})};
  const std::vector<float> before = fields[0].field.values;
  close_slits(fields, {{{4, 1, 1}, {0.1F, 0.3F, 0.6F, 0.8F}}, {{4, 1, 1}, {0, 0, 0, 0}}}, {4, 1, 1});
  EXPECT_EQ(fields[0].field.values, before);
}

TEST(SceneFields, TheSumBecomesTheBroadOneAndSharesStay) {
  std::vector<RegionField> fields{row({0.6F, 0.3F}), row({0.2F, 0.3F})};
  close_slits(fields, {{{2, 1, 1}, {0.5F, 0.5F}}, {{2, 1, 1}, {0.4F, 0.3F}}}, {2, 1, 1});
  EXPECT_NEAR(fields[0].field.values[0], 0.75 * 0.9, 1e-6);
  EXPECT_NEAR(fields[1].field.values[0], 0.25 * 0.9, 1e-6);
  EXPECT_NEAR(fields[0].field.values[1], 0.4, 1e-6);
  EXPECT_NEAR(fields[1].field.values[1], 0.4, 1e-6);
}

TEST(SceneFields, ASlitWithoutAnySharpFieldIsFilledByTheBroadShares) {
  std::vector<RegionField> fields{row({0}), row({0})};
  close_slits(fields, {{{1, 1, 1}, {0.35F}}, {{1, 1, 1}, {0.25F}}}, {1, 1, 1});
  EXPECT_NEAR(fields[0].field.values[0], 0.35, 1e-6);
  EXPECT_NEAR(fields[1].field.values[0], 0.25, 1e-6);
}

TEST(SceneFields, TheInterfaceOfTwoHalvesDoesNotMove) {
  std::vector<float> left, right, broad_left, broad_right;
  for (int n = 0; n < kLength; ++n) {  // sharp: steep between samples 5 and 6; broad: flat, and shifted by two samples
    left.push_back(n < 6 ? 0.9F : 0.1F), right.push_back(1 - left.back());
    broad_left.push_back(n < 8 ? 0.6F : 0.4F), broad_right.push_back(1 - broad_left.back());
  }
  std::vector<RegionField> fields{row(left), row(right)};
  close_slits(fields, {{{kLength, 1, 1}, broad_left}, {{kLength, 1, 1}, broad_right}}, {kLength, 1, 1});
  for (int n = 0; n < kLength; ++n) {
    const auto at = static_cast<std::size_t>(n);
    EXPECT_EQ(fields[0].field.values[at] > fields[1].field.values[at], n < 6) << n;
  }
}

TEST(SceneFields, FieldsMayReachBeyondTheCommonGrid) {
  std::vector<RegionField> fields{row({1, 1, 1}), row({0, 0.5F, 1})};
  fields[0].first = {-2, 0, 0}, fields[1].first = {0, 0, 0};
  close_slits(fields, {{{3, 1, 1}, {1, 1, 0.5F}}, {{3, 1, 1}, {0.5F, 0.5F, 1}}}, {2, 1, 1});
  EXPECT_EQ(fields[0].field.values[0], 1);  // not in the grid
  EXPECT_EQ(fields[0].field.values[1], 1);
  EXPECT_NEAR(fields[0].field.values[2], 1, 1e-6);  // sum 1, broad sum 1: nothing to change
  EXPECT_EQ(fields[1].field.values[2], 1);
}

}  // namespace
}  // namespace trocar::scene_fields_test
