#include "tissue/imaging/labels/label_values.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trocar::label_values_test {
namespace {

TEST(LabelValues, MeanDeviationAndQuantilesOfTheMarkedVoxelsOnly) {
  ImageVolume image;
  LabelVolume labels;
  image.size = labels.size = {101, 2, 1};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i <= 100; ++i) {
      image.values.push_back(j == 0 ? static_cast<float>(i) : -1000);
      labels.labels.push_back(j == 0 ? 7 : 3);
    }
  const LabelValues values = values_under(image, labels, 7);  // 0 to 100 once each
  EXPECT_EQ(values.voxels, 101U);
  EXPECT_NEAR(values.mean, 50, 1e-9);
  EXPECT_NEAR(values.deviation, std::sqrt((101.0 * 101 - 1) / 12), 1e-9);
  EXPECT_EQ(values.p05, 5);
  EXPECT_EQ(values.p95, 95);
  EXPECT_EQ(values_under(image, labels, 9).voxels, 0U);
  labels.size = {202, 1, 1};
  EXPECT_THROW(values_under(image, labels, 7), std::invalid_argument);
}

TEST(Hounsfield, AirBelowMinus500IsCertain) {
  ImageVolume image;
  image.values = {-499, 0, 3000};
  EXPECT_FALSE(certainly_hounsfield(image));
  image.values.push_back(-501);
  EXPECT_TRUE(certainly_hounsfield(image));
}

}  // namespace
}  // namespace trocar::label_values_test
