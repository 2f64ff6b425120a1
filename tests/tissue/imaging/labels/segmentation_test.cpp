#include "tissue/imaging/labels/segmentation.h"

#include <cmath>
#include <random>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/labels/itk_region.h"
#include "tissue/imaging/labels/label_grid.h"

namespace trocar::segmentation_test {
namespace {

using Shape = double (*)(const Eigen::Vector3d&);

/// Value by a function of the place, voxels of unequal edges, the middle at the patient's origin.
template <typename Value>
ImageVolume image_of(const std::array<int, 3>& size, const Eigen::Vector3d& edges, Value value) {
  ImageVolume image;
  image.size = size;
  image.index_to_ras_mm.linear() = edges.asDiagonal();
  for (int axis = 0; axis < 3; ++axis)
    image.index_to_ras_mm.translation()[axis] = -0.5 * edges[axis] * (size[static_cast<std::size_t>(axis)] - 1);
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        image.values.push_back(
            static_cast<float>(value(Eigen::Vector3d(image.index_to_ras_mm * Eigen::Vector3d(i, j, k)))));
  return image;
}

const Eigen::Vector3d kEdges(1, 1, 2.5);
const std::array<int, 3> kSize{60, 50, 24};

/// An organ of 100, a smaller one beside it, a thin bridge between them, fat of -100 round them.
double two_balls(const Eigen::Vector3d& p) {
  if ((p - Eigen::Vector3d(-10, 0, 0)).norm() < 14) return 100;
  if ((p - Eigen::Vector3d(18, 0, 0)).norm() < 8) return 100;
  if (p.x() > -10 && p.x() < 18 && std::hypot(p.y(), p.z()) < 1.6) return 100;
  return -100;
}

LabelVolume truth(const ImageVolume& image, const Eigen::Vector3d& centre, double radius) {
  LabelVolume map{.size = image.size, .labels = {}, .index_to_ras_mm = image.index_to_ras_mm, .notes = {}};
  for (int k = 0; k < image.size[2]; ++k)
    for (int j = 0; j < image.size[1]; ++j)
      for (int i = 0; i < image.size[0]; ++i)
        map.labels.push_back((image.index_to_ras_mm * Eigen::Vector3d(i, j, k) - centre).norm() < radius ? 1 : 0);
  return map;
}

SegmentationOptions window(double low, double high) {
  SegmentationOptions options;
  options.low = low, options.high = high;
  return options;
}

TEST(Segmentation, LargestPieceOfAWindow) {
  const ImageVolume image =
      image_of(kSize, kEdges, [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 2 ? -100 : two_balls(p); });
  const LabelVolume result = segment(image, window(50, 150));
  std::size_t wanted = 0;
  for (std::size_t voxel = 0; voxel < image.values.size(); ++voxel) {
    const auto i = static_cast<int>(voxel % 60);
    wanted += image.values[voxel] > 0 && i < 30 ? 1 : 0;
    EXPECT_EQ(result.labels[voxel], image.values[voxel] > 0 && i < 30 ? 1 : 0);
  }
  EXPECT_EQ(result.label_counts().at(1), wanted);
  EXPECT_TRUE(test::has_note(result.notes, "not by anatomy"));
  EXPECT_TRUE(test::has_note(result.notes, "largest of 2"));
  SegmentationOptions all = window(50, 150);
  all.keep = Keep::kAll;
  EXPECT_GT(segment(image, all).label_counts().at(1), wanted);
}

TEST(Segmentation, OpeningCutsAThinBridge) {
  const ImageVolume image = image_of(kSize, kEdges, two_balls);
  const LabelVolume big = truth(image, {-10, 0, 0}, 14), small = truth(image, {18, 0, 0}, 8);
  SegmentationOptions options = window(50, 150);
  options.seed_ras_mm = Eigen::Vector3d(18, 0, 0);
  EXPECT_LT(dice(segment(image, options), 1, small, 1), 0.5);  // leaks through the bridge
  options.opening_mm = 3;
  const LabelVolume cut = segment(image, options);
  EXPECT_GT(dice(cut, 1, small, 1), 0.93);
  EXPECT_TRUE(test::has_note(cut.notes, "opened by a ball of 3 mm"));
  options.seed_ras_mm.reset();
  EXPECT_GT(dice(segment(image, options), 1, big, 1), 0.97);
  options.opening_mm = 20;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { segment(image, options); }), "nothing is left");
}

TEST(Segmentation, ReachKeepsALeakSmallAndSaysSo) {
  const ImageVolume image = image_of(kSize, kEdges, [](const Eigen::Vector3d&) { return 40.0; });
  SegmentationOptions options = window(0, 80);
  options.seed_ras_mm = Eigen::Vector3d(2, 1, 0);
  options.reach_mm = 12;
  const LabelVolume ball = segment(image, options);
  EXPECT_EQ(ball.labels, truth(image, *options.seed_ras_mm, 12 + 1e-9).labels);
  EXPECT_TRUE(test::has_note(ball.notes, "warning: it fills up to its reach"));
  options.reach_mm = 0;
  const LabelVolume whole = segment(image, options);
  EXPECT_TRUE(test::has_note(whole.notes, "touches the border"));
  EXPECT_TRUE(test::has_note(whole.notes, "warning: more than 15 % of the image"));
}

TEST(Segmentation, HolesAreFilledWhenAsked) {
  const ImageVolume image =
      image_of(kSize, kEdges, [](const Eigen::Vector3d& p) { return p.norm() < 15 && p.norm() > 6 ? 100.0 : 0.0; });
  SegmentationOptions options = window(50, 150);
  const LabelVolume filled = segment(image, options);
  EXPECT_EQ(filled.labels, truth(image, {0, 0, 0}, 15).labels);
  EXPECT_TRUE(test::has_note(filled.notes, "filled holes"));
  options.fill_holes = false;
  EXPECT_LT(segment(image, options).label_counts().at(1), filled.label_counts().at(1));
}

TEST(Segmentation, SmoothingOvercomesNoise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 45);
  ImageVolume image = image_of(kSize, kEdges, [](const Eigen::Vector3d& p) { return p.norm() < 15 ? 100.0 : -100.0; });
  for (float& value : image.values) value += static_cast<float>(noise(random));
  const LabelVolume ball = truth(image, {0, 0, 0}, 15);
  SegmentationOptions options = window(0, 300);
  const double rough = dice(segment(image, options), 1, ball, 1);
  options.smooth = true;
  const double smooth = dice(segment(image, options), 1, ball, 1);
  EXPECT_GT(smooth, 0.97);
  EXPECT_GT(smooth, rough);
}

TEST(Segmentation, SameImageSameLabels) {
  const ImageVolume image = image_of(kSize, kEdges, two_balls);
  SegmentationOptions options = window(50, 150);
  options.opening_mm = 2, options.closing_mm = 3, options.smooth = true;
  EXPECT_EQ(segment(image, options).labels, segment(image, options).labels);
}

TEST(Segmentation, TellsTheShareOfTheBody) {
  ImageVolume image = image_of({20, 20, 20}, {1, 1, 1}, [](const Eigen::Vector3d& p) {
    return p.x() > 0 ? -1000.0 : p.y() > 0 ? 50.0 : 0.0;
  });
  const LabelVolume result = segment(image, window(40, 60));
  EXPECT_TRUE(test::has_note(result.notes, "2000 voxels, 2 mL, 25 % of the image and 50 % of the body"));
}

TEST(Segmentation, ShearedImagesGiveStraightLabels) {
  ImageVolume image =
      image_of({40, 40, 20}, {1, 1, 2}, [](const Eigen::Vector3d& p) { return p.norm() < 12 ? 100.0 : 0.0; });
  image.index_to_ras_mm.linear()(1, 2) = 0.5;
  const LabelVolume result = segment(image, window(50, 150));
  EXPECT_LT(skew_of(result.index_to_ras_mm), 1e-12);
  EXPECT_TRUE(test::has_note(result.notes, "straightened"));
}

TEST(Segmentation, MistakesAreRefusedByOption) {
  const ImageVolume image = image_of({10, 10, 10}, {1, 1, 1}, [](const Eigen::Vector3d& p) { return p.x(); });
  const auto refused = [&](const SegmentationOptions& options) {
    return test::message_of<InputError>([&] { segment(image, options); });
  };
  EXPECT_CONTAINS(refused(window(5, 1)), "--threshold");
  EXPECT_CONTAINS(refused(window(std::nan(""), 1)), "--threshold");
  EXPECT_CONTAINS(refused(window(900, 1000)), "the image has -4.5 to 4.5");
  SegmentationOptions options = window(0, 10);
  options.keep = Keep::kSeeded;
  EXPECT_CONTAINS(refused(options), "a seed is wanted");
  options.seed_ras_mm = Eigen::Vector3d(900, 0, 0);
  EXPECT_CONTAINS(refused(options), "outside the image, which reaches from (-4.5, -4.5, -4.5)");
  options.seed_ras_mm = Eigen::Vector3d(-4.4, 0, 0);
  EXPECT_CONTAINS(refused(options), "its voxel holds -4.5, outside the window 0 to 10, and so do its neighbours");
  options.seed_ras_mm = Eigen::Vector3d(-0.6, 0.1, 0.1);
  EXPECT_TRUE(test::has_note(segment(image, options).notes, "holds -0.5, outside the window; a neighbour"));
  options = window(0, 10), options.opening_mm = -1;
  EXPECT_CONTAINS(refused(options), "opening");
}

// Oracle: the distance between all pairs of voxel centres.
TEST(Region, BallsAreMeasuredInMillimetresOnUnequalEdges) {
  const RegionShape shape{{11, 12, 9}, {1, 0.7, 2.5}};
  std::mt19937_64 random(4);
  for (const double radius : {0.8, 2.5, 4.0}) {
    std::vector<std::uint8_t> mask(11 * 12 * 9, 0);
    for (std::uint8_t& voxel : mask) voxel = random() % 40 == 0 ? 1 : 0;
    std::vector<std::uint8_t> grown = mask, shrunk = mask;
    for (std::uint8_t& voxel : shrunk) voxel = 1 - voxel;
    dilate(grown, shape, radius);
    erode(shrunk, shape, radius);
    std::size_t voxel = 0;
    for (int k = 0; k < 9; ++k)
      for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 11; ++i, ++voxel) {
          double least = 1e9;
          std::size_t other = 0;
          for (int c = 0; c < 9; ++c)
            for (int b = 0; b < 12; ++b)
              for (int a = 0; a < 11; ++a, ++other)
                if (mask[other] != 0) least = std::min(least, std::hypot(1.0 * (i - a), 0.7 * (j - b), 2.5 * (k - c)));
          EXPECT_EQ(grown[voxel], least <= radius + 1e-6 ? 1 : 0);
          EXPECT_EQ(shrunk[voxel], 1 - grown[voxel]);
        }
  }
}

TEST(Region, EmptyAndFullMasksStayAsTheyAre) {
  const RegionShape shape{{4, 4, 4}, {1, 1, 1}};
  std::vector<std::uint8_t> empty(64, 0), full(64, 1);
  dilate(empty, shape, 2), erode(full, shape, 2);
  EXPECT_EQ(empty, std::vector<std::uint8_t>(64, 0));
  EXPECT_EQ(full, std::vector<std::uint8_t>(64, 1));  // beyond the image is no background
}

TEST(Dice, CountsTheOverlap) {
  LabelVolume a, b;
  a.size = b.size = {4, 1, 1};
  a.labels = {1, 1, 0, 0}, b.labels = {0, 2, 2, 0};
  EXPECT_DOUBLE_EQ(dice(a, 1, b, 2), 0.5);
  EXPECT_DOUBLE_EQ(dice(a, 7, b, 7), 1);
  b.size = {2, 2, 1};
  EXPECT_THROW(dice(a, 1, b, 2), InputError);
}

}  // namespace
}  // namespace trocar::segmentation_test
