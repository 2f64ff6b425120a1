#include "tissue/imaging/labels/label_grid.h"

#include <random>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/shapes.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar::label_grid_test {
namespace {

TEST(LabelGrid, ResamplingToTheOwnGridChangesNothing) {
  const LabelVolume ball = test::ball_volume(20, 1.5, {1, 2, 3}, 9);
  const LabelVolume same = resampled_to(ball, grid_of(ball));
  EXPECT_EQ(same.labels, ball.labels);
  EXPECT_TRUE(same_grid(grid_of(ball), grid_of(same), 0));
}

// Oracle: the nearest of all voxel centres, looked for one by one.
TEST(LabelGrid, TakesTheNearestVoxelOnAnObliqueGrid) {
  std::mt19937_64 random(5);
  LabelVolume volume;
  volume.size = {5, 6, 7};
  volume.index_to_ras_mm.linear() = Eigen::Vector3d(2, 2, 2).asDiagonal();
  for (int n = 0; n < 5 * 6 * 7; ++n) volume.labels.push_back(static_cast<std::uint16_t>(1 + random() % 9));
  VoxelGrid grid{{9, 8, 7}, Eigen::Affine3d::Identity()};
  grid.index_to_ras_mm.linear() =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 1, 2).normalized()).toRotationMatrix() * 1.1;
  grid.index_to_ras_mm.translation() = Eigen::Vector3d(1, 0.3, 2);
  const LabelVolume result = resampled_to(volume, grid);
  std::size_t outside = 0;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 9; ++i) {
        const Eigen::Vector3d place = grid.index_to_ras_mm * Eigen::Vector3d(i, j, k);
        double least = 1e9;
        int nearest = 0;
        for (int c = 0; c < 7; ++c)
          for (int b = 0; b < 6; ++b)
            for (int a = 0; a < 5; ++a) {
              const double distance = (volume.index_to_ras_mm * Eigen::Vector3d(a, b, c) - place).norm();
              if (distance < least) least = distance, nearest = volume.labels[volume.offset(a, b, c)];
            }
        const Eigen::Array3d index = place.array() / 2;
        const bool inside = (index > -0.5).all() && index[0] < 4.5 && index[1] < 5.5 && index[2] < 6.5;
        EXPECT_EQ(result.labels[result.offset(i, j, k)], inside ? nearest : 0);
        outside += inside ? 0 : 1;
      }
  EXPECT_GT(outside, 0U);
}

TEST(LabelGrid, AgreementIsJudgedAtTheCorners) {
  VoxelGrid a{{100, 100, 100}, Eigen::Affine3d::Identity()};
  VoxelGrid b = a;
  b.index_to_ras_mm.translation().x() = 0.009;
  EXPECT_TRUE(same_grid(a, b));
  b.index_to_ras_mm.translation().x() = 0.011;
  EXPECT_FALSE(same_grid(a, b));
  b = a, b.index_to_ras_mm.linear()(2, 2) = 1.001;  // a tenth of a millimetre at the far end
  EXPECT_FALSE(same_grid(a, b));
  b = a, b.size[2] = 99;
  EXPECT_FALSE(same_grid(a, b));
}

TEST(LabelGrid, CutOutsOfOneImageHaveACommonGrid) {
  VoxelGrid a{{10, 11, 12}, Eigen::Affine3d::Identity()};
  a.index_to_ras_mm.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) *
                               Eigen::Matrix3d(Eigen::Vector3d(0.7, 0.8, 2.5).asDiagonal());
  VoxelGrid b{{4, 20, 3}, a.index_to_ras_mm};
  b.index_to_ras_mm.translation() = a.index_to_ras_mm * Eigen::Vector3d(-3, 5, 30);
  const std::optional<VoxelGrid> both = common_grid(a, b), turned = common_grid(b, a);
  ASSERT_TRUE(both && turned);
  EXPECT_EQ(both->size, (std::array<int, 3>{13, 25, 33}));
  EXPECT_LT((both->index_to_ras_mm.translation() - a.index_to_ras_mm * Eigen::Vector3d(-3, 0, 0)).norm(), 1e-9);
  EXPECT_TRUE(same_grid(*both, *turned, 1e-9));
  EXPECT_TRUE(same_grid(*common_grid(a, a), a, 1e-9));
  b.index_to_ras_mm.translation().x() += 0.3;
  EXPECT_FALSE(common_grid(a, b)) << "between the voxels";
  b = a, b.index_to_ras_mm.linear().col(1) *= 1.01;
  EXPECT_FALSE(common_grid(a, b)) << "other spacing";
  b = a, b.index_to_ras_mm.translation() = a.index_to_ras_mm * Eigen::Vector3d(1e5, 1e5, 1e5);
  EXPECT_FALSE(common_grid(a, b)) << "too large";
  b.index_to_ras_mm.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(common_grid(a, b));
}

TEST(LabelGrid, MapOfAnotherGridGoesThroughThePatient) {
  const LabelVolume fine = test::ball_volume(40, 1, {0, 0, 0}, 12);
  ImageVolume image;
  image.size = {20, 20, 20};
  image.index_to_ras_mm.linear() *= 2;
  image.index_to_ras_mm.translation().setConstant(-19);
  image.values.assign(8000, 0);
  const LabelVolume coarse = on_grid_of(image, fine, "map.nii");
  EXPECT_TRUE(same_grid(grid_of(coarse), grid_of(image)));
  EXPECT_NEAR(static_cast<double>(coarse.label_counts().at(1)) * 8, static_cast<double>(fine.label_counts().at(1)),
              300);
  EXPECT_TRUE(test::has_note(coarse.notes, "another grid than the image"));
  LabelVolume far = fine;
  far.index_to_ras_mm.translation().x() += 500;
  const std::string message = test::message_of<InputError>([&] { on_grid_of(image, far, "map.nii"); });
  EXPECT_CONTAINS(message, "map.nii: the label map lies 468.5 mm outside the image");  // 500 - 11.5 - 20
  EXPECT_TRUE(on_grid_of(image, coarse, "map.nii").labels == coarse.labels);
}

TEST(LabelGrid, GapIsMeasuredBetweenEdges) {
  const VoxelGrid a{{10, 10, 10}, Eigen::Affine3d::Identity()};
  VoxelGrid b = a;
  b.index_to_ras_mm.translation() = Eigen::Vector3d(13, 14, 0);
  EXPECT_NEAR(gap_mm(a, b), 5, 1e-12);
  b.index_to_ras_mm.translation() = Eigen::Vector3d(9, 9, 9);
  EXPECT_EQ(gap_mm(a, b), 0);
}

TEST(LabelGrid, ImpossibleGridsAreRefused) {
  const LabelVolume ball = test::ball_volume(10, 1, {0, 0, 0}, 3);
  VoxelGrid grid = grid_of(ball);
  grid.size[0] = 0;
  EXPECT_THROW(resampled_to(ball, grid), InputError);
  grid.size = {1 << 12, 1 << 12, 1 << 12};
  EXPECT_THROW(resampled_to(ball, grid), InputError);
  grid = grid_of(ball), grid.index_to_ras_mm.linear().col(1).setZero();
  EXPECT_THROW(resampled_to(ball, grid), InputError);
}

TEST(SquaredGrid, HoldsEveryVoxelAndKeepsTheSlices) {
  VoxelGrid tilted{{20, 30, 10}, Eigen::Affine3d::Identity()};
  tilted.index_to_ras_mm.linear() << 0.7, 0, 0, 0, 0.7, -0.8, 0, 0, 2.4;
  const VoxelGrid squared = squared_grid(tilted);
  EXPECT_LT(skew_of(squared.index_to_ras_mm), 1e-12);
  EXPECT_NEAR(squared.index_to_ras_mm.linear()(2, 2), 2.4, 1e-12);
  EXPECT_EQ(squared.size[0], 20);
  EXPECT_EQ(squared.size[2], 10);
  EXPECT_EQ(squared.size[1], 30 + 11);  // the last slice slid by 9 * 0.8 mm = 10.3 voxels
  const Eigen::Affine3d back = squared.index_to_ras_mm.inverse() * tilted.index_to_ras_mm;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d index =
        back * Eigen::Vector3d((corner & 1) * 19, (corner >> 1 & 1) * 29, (corner >> 2 & 1) * 9);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(index[axis], -1e-9);
      EXPECT_LE(index[axis], squared.size[static_cast<std::size_t>(axis)] - 1 + 1e-9);
    }
  }
}

// What float32 or text storage leaves of one frame must become one frame.
TEST(SettledFrame, FloatAndTextStorageAgree) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-400, 400);
  const double spacings[] = {3, 2.5, 1.5, 0.75, 0.7421875, 0.68359375, 0.9765625};
  int apart = 0;
  for (int round = 0; round < 1000; ++round) {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    const double spacing = spacings[random() % 7];
    frame.linear() = Eigen::Vector3d(spacing, spacing, 3).asDiagonal();
    frame.translation() = Eigen::Vector3d(place(random), place(random), place(random));
    Eigen::Affine3d stored = frame;
    for (int n = 0; n < 3; ++n) stored.translation()[n] = static_cast<float>(frame.translation()[n]);
    const Eigen::Affine3d a = settled_frame(frame), b = settled_frame(stored);
    apart += a.matrix() == b.matrix() ? 0 : 1;
    EXPECT_LT((a.matrix() - b.matrix()).cwiseAbs().maxCoeff(), 1.01e-3);  // 1e-6 m even where rounding parts them
    EXPECT_LT((a.matrix() - frame.matrix()).cwiseAbs().maxCoeff(), 5e-4);
  }
  EXPECT_LT(apart, 50);  // 1.5e-5 mm of float32 against steps of 1e-3 mm, three axes
}

}  // namespace
}  // namespace trocar::label_grid_test
