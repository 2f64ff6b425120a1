// The 48 storage orders and oblique frames: no voxel moves in patient space, whatever the order.
#include "tissue/imaging/volumes/axis_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar::axis_order_test {
namespace {

Eigen::Matrix3d random_turn(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond turn(normal(engine), normal(engine), normal(engine), normal(engine));
  return turn.normalized().toRotationMatrix();
}

/// A signed permutation of the axes with edges of 1, 2 and 3 mm.
Eigen::Matrix3d signed_axes(const std::array<int, 3>& world, int flips) {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 3; ++n) linear(world[static_cast<std::size_t>(n)], n) = (flips >> n & 1) != 0 ? -(n + 1) : n + 1;
  return linear;
}

ImageVolume told_volume(const std::array<int, 3>& size, const Eigen::Matrix3d& linear) {
  ImageVolume volume;
  volume.size = size;
  volume.index_to_ras_mm.linear() = linear;
  volume.index_to_ras_mm.translation() = Eigen::Vector3d(-31, 17, 5);
  volume.values.resize(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  std::iota(volume.values.begin(), volume.values.end(), 1.0F);
  return volume;
}

/// Every stored voxel must be found again at its place in patient space.
void expect_unmoved(const ImageVolume& before, const ImageVolume& after) {
  ASSERT_EQ(before.values.size(), after.values.size());
  const Eigen::Affine3d to_index = after.index_to_ras_mm.inverse() * before.index_to_ras_mm;
  for (int k = 0; k < before.size[2]; ++k)
    for (int j = 0; j < before.size[1]; ++j)
      for (int i = 0; i < before.size[0]; ++i) {
        const Eigen::Vector3d index = to_index * Eigen::Vector3d(i, j, k);
        const Eigen::Array3i at = index.array().round().cast<int>();
        ASSERT_LT((index - at.matrix().cast<double>()).norm(), 1e-9);
        ASSERT_TRUE((at >= 0).all() && at[0] < after.size[0] && at[1] < after.size[1] && at[2] < after.size[2]);
        EXPECT_EQ(after.values[after.offset(at[0], at[1], at[2])], before.values[before.offset(i, j, k)]);
      }
}

TEST(AxisOrder, NamesTheStoredAxisOfEveryWorldAxisInAllFortyEightOrders) {
  std::array<int, 3> world{0, 1, 2};
  do {
    for (int flips = 0; flips < 8; ++flips) {
      const AxisOrder order = ras_order(signed_axes(world, flips));
      for (int n = 0; n < 3; ++n) {
        const auto row = static_cast<std::size_t>(world[static_cast<std::size_t>(n)]);
        EXPECT_EQ(order.stored[row], n);
        EXPECT_EQ(order.flipped[row], (flips >> n & 1) != 0);
      }
    }
  } while (std::next_permutation(world.begin(), world.end()));
}

TEST(AxisOrder, ObliqueAxesAreEachUsedOnceAndRunTheRightWay) {
  std::mt19937_64 engine(1);
  for (int n = 0; n < 500; ++n) {
    const Eigen::Matrix3d turn = random_turn(engine);
    const AxisOrder order = ras_order(turn);
    std::array<int, 3> used = order.stored;
    std::sort(used.begin(), used.end());
    EXPECT_EQ(used, (std::array<int, 3>{0, 1, 2}));
    for (std::size_t world = 0; world < 3; ++world)
      EXPECT_EQ(order.flipped[world], turn(static_cast<int>(world), order.stored[world]) < 0);
  }
}

// Oracle: no other assignment of axes lies closer to the patient's.
TEST(AxisOrder, NoOtherOrderLiesCloserToThePatientsAxes) {
  std::mt19937_64 engine(2);
  for (int n = 0; n < 300; ++n) {
    const Eigen::Matrix3d turn = random_turn(engine);
    const AxisOrder order = ras_order(turn);
    double chosen = 0, best = 0;
    for (int world = 0; world < 3; ++world)
      chosen += std::abs(turn(world, order.stored[static_cast<std::size_t>(world)]));
    std::array<int, 3> trial{0, 1, 2};
    do best = std::max(best, std::abs(turn(0, trial[0])) + std::abs(turn(1, trial[1])) + std::abs(turn(2, trial[2])));
    while (std::next_permutation(trial.begin(), trial.end()));
    EXPECT_NEAR(chosen, best, 1e-8);
  }
}

TEST(AxisOrder, EdgeLengthsDoNotDecideTheOrder) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> edge(0.1, 20);
  for (int n = 0; n < 200; ++n) {
    const Eigen::Matrix3d turn = random_turn(engine);
    const Eigen::Vector3d edges(edge(engine), edge(engine), edge(engine));
    const AxisOrder plain = ras_order(turn), stretched = ras_order(turn * edges.asDiagonal());
    EXPECT_EQ(plain.stored, stretched.stored);
    EXPECT_EQ(plain.flipped, stretched.flipped);
  }
}

TEST(AxisOrder, VoxelsOfObliqueVolumesStayWhereTheyAre) {
  std::mt19937_64 engine(4);
  for (int n = 0; n < 40; ++n) {
    const Eigen::Matrix3d linear = random_turn(engine) * Eigen::Vector3d(0.7, 1.3, 5).asDiagonal();
    const ImageVolume before = told_volume({5, 4, 3}, linear), after = in_ras_order(before);
    expect_unmoved(before, after);
    const AxisOrder again = ras_order(after.index_to_ras_mm.linear());
    EXPECT_EQ(again.stored, (std::array<int, 3>{0, 1, 2}));
    EXPECT_EQ(again.flipped, (std::array<bool, 3>{}));
  }
}

TEST(AxisOrder, ShearedVolumesStayWhereTheyAre) {
  Eigen::Matrix3d tilted;
  tilted << 0, -0.8, 0.1, 0, 0.2, -2.5, -0.9, 0, 0.7;
  const ImageVolume before = told_volume({3, 5, 4}, tilted), after = in_ras_order(before);
  EXPECT_EQ(after.size, (std::array<int, 3>{5, 4, 3}));
  expect_unmoved(before, after);
}

TEST(AxisOrder, OrderingTwiceIsOrderingOnce) {
  std::mt19937_64 engine(5);
  for (int n = 0; n < 40; ++n) {
    const ImageVolume once = in_ras_order(told_volume({4, 6, 2}, random_turn(engine))), twice = in_ras_order(once);
    EXPECT_EQ(once.size, twice.size);
    EXPECT_EQ(once.values, twice.values);
    EXPECT_EQ(once.index_to_ras_mm.matrix(), twice.index_to_ras_mm.matrix());
  }
}

TEST(AxisOrder, FlippingAnAxisMovesTheOriginToItsOtherEnd) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = Eigen::Vector3d(-2, 3, -0.5).asDiagonal();
  frame.translation() = Eigen::Vector3d(100, 20, 7);
  const std::array<int, 3> size{11, 6, 5};
  const AxisOrder order = ras_order(frame.linear());
  const Eigen::Affine3d turned = reordered_frame(frame, size, order);
  EXPECT_EQ(turned.translation(), Eigen::Vector3d(80, 20, 5));
  EXPECT_EQ(turned.linear(), Eigen::Matrix3d(Eigen::Vector3d(2, 3, 0.5).asDiagonal()));
  EXPECT_EQ(reordered_size(size, order), size);
}

TEST(AxisOrder, ReorderedKeepsEveryValueOfAnyTypeOnce) {
  std::vector<std::string> words;
  for (int n = 0; n < 24; ++n) words.push_back("voxel " + std::to_string(n));
  AxisOrder order;
  order.stored = {2, 0, 1}, order.flipped = {true, false, true};
  std::vector<std::string> turned = reordered(words, {2, 3, 4}, order);
  EXPECT_EQ(reordered_size({2, 3, 4}, order), (std::array<int, 3>{4, 2, 3}));
  // New (0, 0, 0) is the last along stored axes 2 and 1, the first along stored axis 0.
  EXPECT_EQ(turned.front(), words[2 * 2 + 6 * 3]);
  EXPECT_EQ(turned[1], words[2 * 2 + 6 * 2]);
  std::sort(turned.begin(), turned.end()), std::sort(words.begin(), words.end());
  EXPECT_EQ(turned, words);
}

TEST(AxisOrder, ImagesAndLabelsAreTurnedAlike) {
  std::mt19937_64 engine(6);
  const Eigen::Matrix3d linear = random_turn(engine) * 1.5;
  ImageVolume image = told_volume({4, 5, 6}, linear);
  image.modality = "MR", image.notes = {"odd"};
  LabelVolume labels{.size = image.size, .labels = {}, .index_to_ras_mm = image.index_to_ras_mm, .notes = {"odd"}};
  for (const float value : image.values) labels.labels.push_back(static_cast<std::uint16_t>(value));
  const ImageVolume turned = in_ras_order(image);
  const LabelVolume turned_labels = in_ras_order(labels);
  EXPECT_EQ(turned.modality, "MR");
  EXPECT_EQ(turned.notes, image.notes);
  EXPECT_EQ(turned_labels.notes, labels.notes);
  EXPECT_EQ(turned.size, turned_labels.size);
  EXPECT_EQ(turned.index_to_ras_mm.matrix(), turned_labels.index_to_ras_mm.matrix());
  for (std::size_t n = 0; n < turned.values.size(); ++n) EXPECT_EQ(turned.values[n], turned_labels.labels[n]);
}

TEST(LabelVolumeCounts, VolumeAndCountsDoNotDependOnTheOrder) {
  std::mt19937_64 engine(7);
  for (int n = 0; n < 20; ++n) {
    LabelVolume volume;
    volume.size = {6, 5, 4};
    volume.index_to_ras_mm.linear() = random_turn(engine) * Eigen::Vector3d(2, 3, 5).asDiagonal();
    std::map<int, std::size_t> wanted;
    for (int voxel = 0; voxel < 120; ++voxel) {
      const auto label = static_cast<std::uint16_t>(engine() % 4 == 0 ? 65535 : engine() % 3);
      volume.labels.push_back(label);
      if (label != 0) ++wanted[label];
    }
    const LabelVolume turned = in_ras_order(volume);
    EXPECT_EQ(volume.label_counts(), wanted);
    EXPECT_EQ(turned.label_counts(), wanted);
    EXPECT_NEAR(volume.voxel_volume_ml(), 0.030, 1e-12);
    EXPECT_NEAR(turned.voxel_volume_ml(), 0.030, 1e-12);
  }
}

}  // namespace
}  // namespace trocar::axis_order_test
