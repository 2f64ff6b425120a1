// Tunnels against shapes whose number is known, and the work on noise; pieces and holes are tested in
// itk_region_test.cpp.
#include "tissue/imaging/labels/mask_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/segmentation.h"

namespace trocar::mask_pieces_test {
namespace {

template <typename Inside>
std::vector<std::uint8_t> drawn(const RegionShape& shape, Inside inside) {
  std::vector<std::uint8_t> mask;
  for (int k = 0; k < shape.size[2]; ++k)
    for (int j = 0; j < shape.size[1]; ++j)
      for (int i = 0; i < shape.size[0]; ++i) mask.push_back(inside(i, j, k) ? 1 : 0);
  return mask;
}

const RegionShape kShape{{31, 27, 15}, {1, 1, 1}};

TEST(Tunnels, ABallHasNoneARingOneAFrameAsManyAsItsWindows) {
  EXPECT_EQ(
      tunnels_of(drawn(kShape, [](int i, int j, int k) { return std::hypot(i - 15, j - 13, k - 7) < 6; }), kShape), 0);
  const auto ring = [](int i, int j, int k) {
    return std::abs(std::hypot(i - 15, j - 13) - 9) < 2 && std::abs(k - 7) < 2;
  };
  EXPECT_EQ(tunnels_of(drawn(kShape, ring), kShape), 1);
  const auto ladder = [](int i, int j, int k) {
    return k == 3 && j >= 2 && j <= 12 && (i == 2 || i == 20 || j % 5 == 2) && i >= 2 && i <= 20;
  };
  EXPECT_EQ(tunnels_of(drawn(kShape, ladder), kShape), 2);
}

TEST(Tunnels, SurfacesOfTheBlockCountAsAnyOther) {
  const auto plate_with_holes = [](int i, int j, int) { return !(i % 6 == 3 && j % 6 == 3); };
  EXPECT_EQ(tunnels_of(drawn(kShape, plate_with_holes), kShape), 5 * 4);  // i = 3, 9 ... 27; j = 3, 9, 15, 21
}

TEST(Pieces, ProgressMayStopALongFlood) {
  const RegionShape shape{{128, 128, 80}, {1, 1, 1}};
  std::vector<std::uint8_t> mask(128 * 128 * 80, 1);
  const Progress stop = [](std::string_view, double) { throw EnvironmentError("stopped"); };
  EXPECT_THROW(keep_largest(mask, shape, stop), EnvironmentError);
}

ImageVolume noise(int extent, double deviation) {
  std::mt19937 random(3);
  std::normal_distribution<float> values(40, static_cast<float>(deviation));
  ImageVolume image;
  image.size = {extent, extent, extent};
  image.modality = "CT";
  for (int n = 0; n < extent * extent * extent; ++n) image.values.push_back(values(random));
  return image;
}

std::string refusal(const ImageVolume& image, double low, double high) {
  SegmentationOptions options;
  options.low = low, options.high = high;
  return test::message_of<InputError>([&] { segment(image, options); });
}

TEST(NoisyWindows, MostOfTheImageIsNoOrgan) {
  const std::string message = refusal(noise(32, 10), 20, 80);
  EXPECT_CONTAINS(message, "--threshold 20 80: 9");
  EXPECT_CONTAINS(message, "% of the image's voxels hold such values");
  EXPECT_CONTAINS(message, "--seed-point");
}

// Nearly half of the voxels hang together (above the threshold of percolation, 31 %): a tunnel for every two dozen
// voxels.
TEST(NoisyWindows, ASpongeIsRefusedWithWhatToDo) {
  const std::string message = refusal(noise(80, 20), 42, 200);
  EXPECT_CONTAINS(message, "is a sponge with about");
  EXPECT_CONTAINS(message, "--smooth, --opening 3");
}

}  // namespace
}  // namespace trocar::mask_pieces_test
