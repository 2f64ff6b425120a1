#include "tissue/imaging/phantom/scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace trocar::phantom::scanner_test {
namespace {

constexpr std::array<int, 3> kSize{31, 31, 31};
constexpr std::size_t kCount = 31 * 31 * 31, kMiddle = 15 + 31 * (15 + 31 * 15);

TEST(PhantomScanner, PointSpreadIsAGaussianOfTheStatedWidth) {
  for (const double voxel : {0.5, 0.8}) {
    std::vector<float> image(kCount, 0);
    image[kMiddle] = 1000;
    scan(image, kSize, {.voxel_mm = voxel, .noise_hu = 0});
    EXPECT_NEAR(std::accumulate(image.begin(), image.end(), 0.0), 1000, 0.01);  // nothing is lost
    double second = 0;
    for (int x = -15; x <= 15; ++x) {
      double plane = 0;
      for (int z = 0; z < 31; ++z)
        for (int y = 0; y < 31; ++y) plane += image[static_cast<std::size_t>(15 + x + 31 * (y + 31 * z))];
      second += plane / 1000 * x * x * voxel * voxel;
    }
    EXPECT_NEAR(std::sqrt(second), kPointSpreadMm, 0.02);
    EXPECT_FLOAT_EQ(image[kMiddle + 1], image[kMiddle + 31]);
    EXPECT_FLOAT_EQ(image[kMiddle - 31 * 31], image[kMiddle + 1]);
  }
}

TEST(PhantomScanner, AnEvenImageStaysEvenUpToItsRim) {
  std::vector<float> image(kCount, 77);
  scan(image, kSize, {.voxel_mm = 0.8, .noise_hu = 0});
  for (const float value : image) ASSERT_NEAR(value, 77, 1e-3);
}

TEST(PhantomScanner, NoiseIsAsStrongAsAskedAndGrainyOnlyInSmallVoxels) {
  for (const double voxel : {0.75, 2.5}) {
    std::vector<float> image(kCount, 0);
    scan(image, kSize, {.voxel_mm = voxel, .noise_hu = 10, .seed = 4});
    double square = 0, neighbour = 0, count = 0;
    for (int k = 3; k < 28; ++k)
      for (int j = 3; j < 28; ++j)
        for (int i = 3; i < 27; ++i) {
          const std::size_t at = static_cast<std::size_t>(i + 31 * (j + 31 * k));
          square += image[at] * image[at], neighbour += image[at] * image[at + 1], ++count;
        }
    EXPECT_NEAR(std::sqrt(square / count), 10, 0.5) << voxel;
    EXPECT_NEAR(neighbour / square, std::exp(-voxel * voxel / (4 * kPointSpreadMm * kPointSpreadMm)), 0.06) << voxel;
  }
}

TEST(PhantomScanner, ASeedIsANoise) {
  std::vector<float> one(kCount, 0), same = one, other = one;
  scan(one, kSize, {.seed = 1});
  scan(same, kSize, {.seed = 1});
  scan(other, kSize, {.seed = 2});
  EXPECT_EQ(one, same);
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace trocar::phantom::scanner_test
