// Labels carried between grids and segments cut out of images: identities, invariance, and oracles that look at every
// voxel one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/labels/segmentation.h"

namespace trocar::grid_segmentation_more_test {
namespace {

Eigen::Affine3d random_frame(std::mt19937_64& engine, const Eigen::Vector3d& edges) {
  std::normal_distribution<double> normal;
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  const Eigen::Quaterniond turn(normal(engine), normal(engine), normal(engine), normal(engine));
  frame.linear() = turn.normalized().toRotationMatrix() * edges.asDiagonal();
  frame.translation() = 20 * Eigen::Vector3d(normal(engine), normal(engine), normal(engine));
  return frame;
}

LabelVolume random_labels(std::mt19937_64& engine, const std::array<int, 3>& size, const Eigen::Affine3d& frame) {
  LabelVolume volume{.size = size, .labels = {}, .index_to_ras_mm = frame, .notes = {}};
  volume.labels.resize(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (std::uint16_t& voxel : volume.labels) voxel = static_cast<std::uint16_t>(engine() % 5);
  return volume;
}

/// Blobs: waves of random direction, thresholds cut pieces of many sizes out of them.
ImageVolume waves(std::uint64_t seed, const std::array<int, 3>& size = {14, 12, 10}) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> even(-1, 1);
  ImageVolume image;
  image.size = size;
  image.index_to_ras_mm.linear() = Eigen::Vector3d(1, 1.5, 2).asDiagonal();
  std::array<Eigen::Vector3d, 4> wave;
  for (Eigen::Vector3d& each : wave) each = 1.3 * Eigen::Vector3d(even(engine), even(engine), even(engine));
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        double value = 0;
        for (const Eigen::Vector3d& each : wave) value += std::sin(each.dot(Eigen::Vector3d(i, j, k)) + 9 * each.x());
        image.values.push_back(static_cast<float>(100 * value));
      }
  return image;
}

/// Pieces of the voxels in the window, over faces: the number of each voxel's piece, 0 outside; sizes by number.
struct Pieces {
  std::vector<std::size_t> number, size{0};
};

Pieces pieces_of(const ImageVolume& image, const SegmentationOptions& options) {
  Pieces pieces;
  pieces.number.assign(image.values.size(), 0);
  const auto in = [&](std::size_t at) { return image.values[at] >= options.low && image.values[at] <= options.high; };
  const std::array<std::size_t, 3> stride{1, image.offset(0, 1, 0), image.offset(0, 0, 1)};
  for (std::size_t start = 0; start < image.values.size(); ++start) {
    if (!in(start) || pieces.number[start] != 0) continue;
    std::vector<std::size_t> open{start};
    pieces.number[start] = pieces.size.size();
    for (std::size_t n = 0; n < open.size(); ++n)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t index = open[n] / stride[axis] % static_cast<std::size_t>(image.size[axis]);
        for (const bool up : {false, true}) {
          if (up ? index + 1 == static_cast<std::size_t>(image.size[axis]) : index == 0) continue;
          const std::size_t next = up ? open[n] + stride[axis] : open[n] - stride[axis];
          if (!in(next) || pieces.number[next] != 0) continue;
          pieces.number[next] = pieces.number[start];
          open.push_back(next);
        }
      }
    pieces.size.push_back(open.size());
  }
  return pieces;
}

SegmentationOptions plain_window(double low, double high, Keep keep) {
  SegmentationOptions options;
  options.low = low, options.high = high, options.keep = keep, options.fill_holes = false;
  return options;
}

TEST(LabelGridIdentities, ShiftsByWholeVoxelsMoveLabelsByWholeVoxels) {
  std::mt19937_64 engine(1);
  for (int round = 0; round < 20; ++round) {
    const Eigen::Affine3d frame = random_frame(engine, {1.5, 2, 3});
    const LabelVolume volume = random_labels(engine, {7, 6, 5}, frame);
    const Eigen::Array3i shift(static_cast<int>(engine() % 7) - 3, static_cast<int>(engine() % 7) - 3,
                               static_cast<int>(engine() % 7) - 3);
    VoxelGrid grid = grid_of(volume);
    grid.index_to_ras_mm.translation() = frame * shift.cast<double>().matrix();
    const LabelVolume moved = resampled_to(volume, grid);
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 7; ++i) {
          const Eigen::Array3i from = Eigen::Array3i(i, j, k) + shift;
          const bool inside = (from >= 0).all() && from[0] < 7 && from[1] < 6 && from[2] < 5;
          EXPECT_EQ(moved.labels[moved.offset(i, j, k)],
                    inside ? volume.labels[volume.offset(from[0], from[1], from[2])] : 0);
        }
  }
}

TEST(LabelGridIdentities, SevenTimesFinerAndBackIsTheSameMap) {
  std::mt19937_64 engine(2);
  for (int round = 0; round < 10; ++round) {
    const LabelVolume volume = random_labels(engine, {6, 5, 4}, random_frame(engine, {3, 2, 4}));
    VoxelGrid fine = grid_of(volume);
    for (int& extent : fine.size) extent *= 7;
    fine.index_to_ras_mm.linear() /= 7;
    fine.index_to_ras_mm.translation() = volume.index_to_ras_mm * Eigen::Vector3d::Constant(-3.0 / 7);
    const LabelVolume finer = resampled_to(volume, fine);
    const auto coarse_counts = volume.label_counts();
    for (const auto& [label, count] : finer.label_counts()) EXPECT_EQ(count, 343 * coarse_counts.at(label));
    EXPECT_EQ(resampled_to(finer, grid_of(volume)).labels, volume.labels);
  }
}

TEST(LabelGridIdentities, MovingThePatientChangesNoLabel) {
  std::mt19937_64 engine(3);
  for (int round = 0; round < 10; ++round) {
    LabelVolume volume = random_labels(engine, {6, 7, 5}, random_frame(engine, {2, 2, 3}));
    VoxelGrid grid{{8, 6, 7}, random_frame(engine, {1.7, 1.9, 2.3})};
    grid.index_to_ras_mm.translation() = volume.index_to_ras_mm.translation();
    const LabelVolume here = resampled_to(volume, grid);
    const Eigen::Affine3d move = random_frame(engine, {1, 1, 1});
    volume.index_to_ras_mm = move * volume.index_to_ras_mm;
    grid.index_to_ras_mm = move * grid.index_to_ras_mm;
    EXPECT_EQ(resampled_to(volume, grid).labels, here.labels);
  }
}

TEST(LabelGridIdentities, AgreementAndGapAreMutual) {
  std::mt19937_64 engine(4);
  for (int round = 0; round < 200; ++round) {
    const VoxelGrid a{{5, 9, 4}, random_frame(engine, {2, 1, 3})}, b{{8, 3, 6}, random_frame(engine, {1, 2, 2})};
    EXPECT_EQ(gap_mm(a, b), gap_mm(b, a));
    EXPECT_EQ(gap_mm(a, a), 0);
    EXPECT_TRUE(same_grid(a, a, 0));
    EXPECT_FALSE(same_grid(a, b));
    VoxelGrid near = a;
    near.index_to_ras_mm.translation() += Eigen::Vector3d(0.3, -0.4, 0);
    EXPECT_TRUE(same_grid(a, near, 0.51) && same_grid(near, a, 0.51));
    EXPECT_FALSE(same_grid(a, near, 0.49) || same_grid(near, a, 0.49));
    near.index_to_ras_mm.translation().x() = std::nan("");
    EXPECT_FALSE(same_grid(a, near, 1e9));
  }
}

TEST(LabelGridIdentities, GapGrowsByAsMuchAsBoxesPart) {
  const VoxelGrid a{{10, 10, 10}, Eigen::Affine3d::Identity()};
  for (double gap = 0; gap < 50; gap += 3.7)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1.0, -1.0}) {
        VoxelGrid b = a;
        b.index_to_ras_mm.translation()[axis] = side * (10 + gap);
        EXPECT_NEAR(gap_mm(a, b), gap, 1e-12);
      }
}

TEST(SquaredGrids, OfShearedGridsAreStraightAndLoseNoVoxel) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> even(-0.4, 0.4);
  for (int round = 0; round < 50; ++round) {
    VoxelGrid sheared{{7, 6, 9}, random_frame(engine, {0.8, 0.9, 2.5})};
    sheared.index_to_ras_mm.linear().col(2) +=
        even(engine) * sheared.index_to_ras_mm.linear().col(1) + even(engine) * sheared.index_to_ras_mm.linear().col(0);
    const VoxelGrid squared = squared_grid(sheared);
    EXPECT_LT(skew_of(squared.index_to_ras_mm), 1e-9);
    const Eigen::Affine3d map = squared.index_to_ras_mm.inverse() * sheared.index_to_ras_mm;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3d at =
          (map * Eigen::Vector3d((corner & 1) * 6, (corner >> 1 & 1) * 5, (corner >> 2 & 1) * 8)).array();
      EXPECT_TRUE((at >= -1e-6).all() && at[0] <= squared.size[0] - 1 + 1e-6 && at[1] <= squared.size[1] - 1 + 1e-6 &&
                  at[2] <= squared.size[2] - 1 + 1e-6);
    }
    const VoxelGrid again = squared_grid(squared);
    EXPECT_EQ(again.size, squared.size);
    EXPECT_TRUE(same_grid(again, squared, 1e-6));
  }
}

TEST(SquaredGrids, SkewIsTheCosineBetweenAxesWhateverTheirLengths) {
  for (double degrees = 50; degrees <= 130; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180;
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    frame.linear().col(1) = 3.5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    EXPECT_NEAR(skew_of(frame), std::abs(std::cos(angle)), 1e-12);
  }
}

// Oracle: pieces found by flooding, voxel by voxel.
TEST(SegmentationOracle, AllLargestAndSeededPiecesAreThoseOfAFlood) {
  std::mt19937_64 engine(6);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ImageVolume image = waves(seed);
    SegmentationOptions options = plain_window(40, 400, Keep::kAll);
    const Pieces pieces = pieces_of(image, options);
    const LabelVolume all = segment(image, options);
    for (std::size_t n = 0; n < all.labels.size(); ++n) EXPECT_EQ(all.labels[n] != 0, pieces.number[n] != 0);
    options.keep = Keep::kLargest;
    const std::size_t most = *std::max_element(pieces.size.begin(), pieces.size.end());
    const LabelVolume largest = segment(image, options);
    EXPECT_EQ(largest.label_counts().at(1), most);
    std::size_t start = engine() % image.values.size();
    while (pieces.number[start] == 0) start = (start + 1) % image.values.size();
    const auto ni = static_cast<std::size_t>(image.size[0]), nj = static_cast<std::size_t>(image.size[1]);
    options.keep = Keep::kSeeded;
    options.seed_ras_mm =
        image.index_to_ras_mm * Eigen::Vector3d(static_cast<double>(start % ni), static_cast<double>(start / ni % nj),
                                                static_cast<double>(start / (ni * nj)));
    const LabelVolume seeded = segment(image, options);
    for (std::size_t n = 0; n < seeded.labels.size(); ++n)
      EXPECT_EQ(seeded.labels[n] != 0, pieces.number[n] == pieces.number[start]);
  }
}

TEST(SegmentationOracle, WindowsAreInclusiveAndWiderOnesHoldNarrowerOnes) {
  const ImageVolume image = waves(3);
  std::vector<float> sorted = image.values;
  std::sort(sorted.begin(), sorted.end());
  const float low = sorted[sorted.size() / 2], high = sorted[sorted.size() * 3 / 4];
  const LabelVolume exact = segment(image, plain_window(low, high, Keep::kAll));
  const auto wanted = std::count_if(sorted.begin(), sorted.end(), [&](float v) { return v >= low && v <= high; });
  EXPECT_EQ(exact.label_counts().at(1), static_cast<std::size_t>(wanted));
  const LabelVolume wider = segment(image, plain_window(low - 30, high + 30, Keep::kAll));
  for (std::size_t n = 0; n < exact.labels.size(); ++n) EXPECT_LE(exact.labels[n], wider.labels[n]);
}

TEST(SegmentationInvariance, MovingThePatientMovesTheSegmentWithHim) {
  const ImageVolume image = waves(4);
  SegmentationOptions options = plain_window(40, 400, Keep::kLargest);
  options.opening_mm = 1.1, options.closing_mm = 2.1, options.fill_holes = true;
  const LabelVolume here = segment(image, options);
  ImageVolume moved = image;
  moved.index_to_ras_mm.translation() += Eigen::Vector3d(-300, 41.5, 700);
  const LabelVolume there = segment(moved, options);
  EXPECT_EQ(there.labels, here.labels);
  EXPECT_EQ(there.index_to_ras_mm.matrix(), moved.index_to_ras_mm.matrix());
  EXPECT_EQ(there.notes, here.notes);
}

TEST(SegmentationInvariance, OffsetAndScaleOfTheValuesGoWithTheWindow) {
  const ImageVolume image = waves(5);
  ImageVolume scaled = image;
  for (float& value : scaled.values) value = 4 * value + 64;
  const SegmentationOptions options = plain_window(32, 256, Keep::kLargest);
  EXPECT_EQ(segment(scaled, plain_window(4 * 32 + 64, 4 * 256 + 64, Keep::kLargest)).labels,
            segment(image, options).labels);
}

TEST(SegmentationSteps, OpeningOnlyTakesAwayAndClosingAndFillingOnlyAdd) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const ImageVolume image = waves(seed);
    const SegmentationOptions plain = plain_window(20, 400, Keep::kAll);
    const LabelVolume base = segment(image, plain);
    SegmentationOptions opening = plain, closing = plain, filling = plain;
    opening.opening_mm = 1.2, closing.closing_mm = 2.2, filling.fill_holes = true;
    const LabelVolume opened = segment(image, opening), closed = segment(image, closing);
    const LabelVolume filled = segment(image, filling);
    for (std::size_t n = 0; n < base.labels.size(); ++n) {
      EXPECT_LE(opened.labels[n], base.labels[n]);
      EXPECT_GE(closed.labels[n], base.labels[n]);
      EXPECT_GE(filled.labels[n], base.labels[n]);
    }
  }
}

TEST(SegmentationReach, HoldsNothingFurtherAwayAndAllThatANarrowerOneHolds) {
  ImageVolume image = waves(6);
  std::fill(image.values.begin(), image.values.end(), 7.0F);
  SegmentationOptions options = plain_window(0, 10, Keep::kSeeded);
  options.seed_ras_mm = image.index_to_ras_mm * Eigen::Vector3d(6, 6, 5);
  std::size_t before = 0;
  for (const double reach : {1.6, 3.1, 5.3, 8.9}) {
    options.reach_mm = reach;
    const LabelVolume ball = segment(image, options);
    std::size_t wanted = 0;
    for (int k = 0; k < 10; ++k)
      for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 14; ++i)
          wanted += (image.index_to_ras_mm * Eigen::Vector3d(i, j, k) - *options.seed_ras_mm).norm() <= reach ? 1 : 0;
    EXPECT_EQ(ball.label_counts().at(1), wanted) << reach;
    EXPECT_GT(wanted, before);
    before = wanted;
  }
}

TEST(DiceLaws, IsMutualBoundedAndAgreesWithCounting) {
  std::mt19937_64 engine(7);
  for (int round = 0; round < 50; ++round) {
    const LabelVolume a = random_labels(engine, {5, 6, 7}, Eigen::Affine3d::Identity());
    const LabelVolume b = random_labels(engine, {5, 6, 7}, Eigen::Affine3d::Identity());
    double both = 0, in_a = 0, in_b = 0;
    for (std::size_t n = 0; n < a.labels.size(); ++n) {
      in_a += a.labels[n] == 2, in_b += b.labels[n] == 3;
      both += a.labels[n] == 2 && b.labels[n] == 3;
    }
    EXPECT_NEAR(dice(a, 2, b, 3), 2 * both / (in_a + in_b), 1e-12);
    EXPECT_EQ(dice(a, 2, b, 3), dice(b, 3, a, 2));
    EXPECT_EQ(dice(a, 4, a, 4), 1);
    EXPECT_EQ(dice(a, 1, a, 2), 0);
  }
}

TEST(DiceLaws, OfTwoBallsFollowsFromTheirVolumes) {
  const LabelVolume large = test::ball_volume(60, 0.5, {0, 0, 0}, 12), small = test::ball_volume(60, 0.5, {0, 0, 0}, 8);
  const double v = 8.0 * 8 * 8 / (12.0 * 12 * 12);
  EXPECT_NEAR(dice(large, 1, small, 1), 2 * v / (1 + v), 0.005);
}

}  // namespace
}  // namespace trocar::grid_segmentation_more_test
