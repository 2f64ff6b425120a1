#include "tissue/imaging/labels/label_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_table.h"

namespace trocar::label_volume_test {
namespace {

LabelVolume random_volume() {
  LabelVolume volume;
  volume.size = {4, 3, 5};
  volume.index_to_ras_mm.linear() = Eigen::Vector3d(2, 3, 1.5).asDiagonal();
  volume.index_to_ras_mm.translation() = Eigen::Vector3d(-7, 11, 40);
  std::mt19937_64 random(3);
  for (int n = 0; n < 60; ++n) volume.labels.push_back(static_cast<std::uint16_t>(random() % 9));
  return volume;
}

/// The same anatomy stored along other axes.
LabelVolume stored_otherwise(const LabelVolume& volume, const std::array<int, 3>& axes, int flips) {
  LabelVolume other;
  for (std::size_t n = 0; n < 3; ++n) {
    other.size[n] = volume.size[static_cast<std::size_t>(axes[n])];
    const Eigen::Vector3d step = volume.index_to_ras_mm.linear().col(axes[n]);
    const bool flip = (flips >> n & 1) != 0;
    other.index_to_ras_mm.linear().col(static_cast<int>(n)) = flip ? Eigen::Vector3d(-step) : step;
    if (n == 0) other.index_to_ras_mm.translation() = volume.index_to_ras_mm.translation();
    if (flip) other.index_to_ras_mm.translation() += step * (other.size[n] - 1);
  }
  for (int k = 0; k < other.size[2]; ++k)
    for (int j = 0; j < other.size[1]; ++j)
      for (int i = 0; i < other.size[0]; ++i) {
        std::array<int, 3> place{};
        const std::array<int, 3> index{i, j, k};
        for (std::size_t n = 0; n < 3; ++n)
          place[static_cast<std::size_t>(axes[n])] = (flips >> n & 1) != 0 ? other.size[n] - 1 - index[n] : index[n];
        other.labels.push_back(volume.labels[volume.offset(place[0], place[1], place[2])]);
      }
  return other;
}

TEST(LabelVolume, AllFortyEightStorageOrdersBecomeOneArray) {
  const LabelVolume volume = random_volume();
  std::array<int, 3> axes{0, 1, 2};
  int orders = 0;
  do {
    for (int flips = 0; flips < 8; ++flips, ++orders) {
      const LabelVolume back = in_ras_order(stored_otherwise(volume, axes, flips));
      EXPECT_EQ(back.size, volume.size);
      EXPECT_EQ(back.labels, volume.labels);
      EXPECT_TRUE(back.index_to_ras_mm.isApprox(volume.index_to_ras_mm, 1e-14));
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(orders, 48);
}

TEST(LabelVolume, EveryNumberTypeGivesTheSameLabels) {
  test::TemporaryFolder folder;
  test::NiftiFixture file;
  file.at(1, 2, 3) = 5;
  file.at(0, 0, 0) = 120;
  const LabelVolume wanted = test::read_label_volume(folder.write("u8.nii", file.bytes()));
  const auto same = [&](std::int16_t code, std::int16_t bits, const auto& bytes_of) {
    file.type(code, bits);
    const LabelVolume volume = test::read_label_volume(folder.write("typed.nii", bytes_of()));
    EXPECT_EQ(volume.labels, wanted.labels) << "datatype " << code;
  };
  same(4, 16, [&] { return file.bytes_as<std::int16_t>(); });
  same(8, 32, [&] { return file.bytes_as<std::int32_t>(); });
  same(16, 32, [&] { return file.bytes_as<float>(); });
  same(64, 64, [&] { return file.bytes_as<double>(); });
  same(256, 8, [&] { return file.bytes_as<std::int8_t>(); });
  same(512, 16, [&] { return file.bytes_as<std::uint16_t>(); });
  same(768, 32, [&] { return file.bytes_as<std::uint32_t>(); });
}

TEST(LabelVolume, RefusesWhatIsNoLabelMap) {
  test::TemporaryFolder folder;
  const auto refused = [&](float value) {
    test::NiftiFixture file;
    file.type(16, 32);
    std::string bytes = file.bytes_as<float>();
    std::memcpy(bytes.data() + 352 + 4 * 17, &value, sizeof value);
    return test::message_of<InputError>([&] { test::read_label_volume(folder.write("map.nii", bytes)); });
  };
  EXPECT_CONTAINS(refused(0), "empty");
  EXPECT_CONTAINS(refused(1.5F), "voxel 17 holds 1.5");
  EXPECT_CONTAINS(refused(-1024), "not a label map");
  EXPECT_CONTAINS(refused(1e30F), "not a label map");
  EXPECT_CONTAINS(refused(std::numeric_limits<float>::quiet_NaN()), "not a finite number");
}

TEST(LabelVolume, RoundsTheNoiseOfResampledMaps) {
  test::TemporaryFolder folder;
  test::NiftiFixture file;
  file.type(16, 32);
  std::string bytes = file.bytes_as<float>();
  const float almost = 4.9999F;
  std::memcpy(bytes.data() + 352, &almost, sizeof almost);
  EXPECT_EQ(test::read_label_volume(folder.write("map.nii", bytes)).label_counts(),
            (std::map<int, std::size_t>{{5, 1}}));
}

TEST(LabelTable, OneNumberMeansDifferentOrgansInDifferentTables) {
  EXPECT_EQ(label_table("totalsegmentator-v1").name_of(7), "aorta");
  EXPECT_EQ(label_table("totalsegmentator-v2").name_of(7), "pancreas");
  EXPECT_EQ(label_table("totalsegmentator-mr").number_of("colon"), 15);
  EXPECT_EQ(label_table("totalsegmentator-v1").number_of("liver"), 5);
  EXPECT_FALSE(label_table("totalsegmentator-v1").number_of("tail").has_value());
  EXPECT_FALSE(label_table("totalsegmentator-v1").name_of(999).has_value());
  EXPECT_CONTAINS(test::message_of<InputError>([] { label_table("mine"); }), "totalsegmentator-v2");
}

TEST(LabelTable, NamesAndNumbersAreUniqueInEachTable) {
  for (const std::string& name : label_table_names()) {
    const LabelTable& table = label_table(name);
    for (const LabelName& entry : table.labels) {
      EXPECT_EQ(table.number_of(entry.name), entry.number) << name;
      EXPECT_EQ(table.name_of(entry.number), entry.name) << name;
    }
  }
}

}  // namespace
}  // namespace trocar::label_volume_test
