// Voxels put in their places: all storage orders, component axes and averaging, against places worked out one voxel at
// a time.
#include "tissue/imaging/volumes/volume_assembly.h"

#include <algorithm>
#include <limits>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar::volume_assembly_test {
namespace {

/// The axes of a 4 x 3 x 2 volume turned and flipped; edges 1, 2 and 3 mm along x, y and z.
Eigen::Affine3d turned_frame(const std::array<int, 3>& world, int flips) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear().setZero();
  for (int n = 0; n < 3; ++n) {
    const int row = world[static_cast<std::size_t>(n)];
    frame.linear()(row, n) = (flips >> n & 1) != 0 ? -(row + 1) : row + 1;
  }
  frame.translation() = Eigen::Vector3d(-5, 7, 11);
  return frame;
}

VolumeHeader header_of(const std::filesystem::path& file, const Eigen::Affine3d& frame) {
  VolumeHeader header;
  header.size = {4, 3, 2};
  header.index_to_ras_mm = frame;
  header.block.file = file;
  return header;
}

TEST(Assembly, AllFortyEightOrdersPutEveryVoxelInItsPlace) {
  test::TemporaryFolder folder;
  const auto file = folder.write("voxels", test::packed<std::uint8_t>(test::told_indices()));
  std::array<int, 3> world{0, 1, 2};
  int orders = 0;
  do {
    for (int flips = 0; flips < 8; ++flips, ++orders) {
      const Eigen::Affine3d frame = turned_frame(world, flips);
      const ImageVolume image = assemble_image(header_of(file, frame), {});
      test::expect_told_indices(image, frame);
      const LabelMap map = assemble_labels(header_of(file, frame), {});
      ASSERT_EQ(map.layers.size(), 1U);
      EXPECT_TRUE(same_grid(grid_of(map.layers[0]), grid_of(image), 0));
      for (std::size_t voxel = 0; voxel < image.values.size(); ++voxel)
        EXPECT_EQ(map.layers[0].labels[voxel], image.values[voxel]);
    }
  } while (std::next_permutation(world.begin(), world.end()));
  EXPECT_EQ(orders, 48);
}

// The component axis may be any of the four; the layers must come out the same.
TEST(Assembly, ComponentsMayLieAlongAnyAxis) {
  test::TemporaryFolder folder;
  const std::array<int, 3> size{4, 3, 2};
  for (int component_axis = 0; component_axis < 4; ++component_axis) {
    std::array<int, 4> extent{};
    for (int axis = 0, spatial = 0; axis < 4; ++axis)
      extent[static_cast<std::size_t>(axis)] = axis == component_axis ? 2 : size[static_cast<std::size_t>(spatial++)];
    std::vector<double> values;
    std::array<int, 4> at{};
    for (at[3] = 0; at[3] < extent[3]; ++at[3])
      for (at[2] = 0; at[2] < extent[2]; ++at[2])
        for (at[1] = 0; at[1] < extent[1]; ++at[1])
          for (at[0] = 0; at[0] < extent[0]; ++at[0]) {
            std::vector<int> place;
            for (int axis = 0; axis < 4; ++axis)
              if (axis != component_axis) place.push_back(at[static_cast<std::size_t>(axis)]);
            const int layer = at[static_cast<std::size_t>(component_axis)];
            values.push_back(1 + place[0] + 4 * place[1] + 12 * place[2] + 100 * layer);
          }
    VolumeHeader header =
        header_of(folder.write("voxels", test::packed<std::uint8_t>(values)), Eigen::Affine3d::Identity());
    header.components = 2, header.component_axis = component_axis, header.segmentation = true;
    const LabelMap map = assemble_labels(header, {});
    ASSERT_EQ(map.layers.size(), 2U);
    for (std::size_t layer = 0; layer < 2; ++layer)
      for (std::size_t voxel = 0; voxel < 24; ++voxel)
        EXPECT_EQ(map.layers[layer].labels[voxel], 1 + voxel + 100 * layer) << "component axis " << component_axis;
    EXPECT_EQ(map.segments.size(), 48U);
  }
}

// Oracle: the mean over the stored voxels whose centres lie in the larger voxel.
TEST(Assembly, AveragesAreMeansOverThePlacesTheyCover) {
  test::TemporaryFolder folder;
  const auto file = folder.write("voxels", test::packed<std::uint8_t>(test::told_indices()));
  std::array<int, 3> world{0, 1, 2};
  do {
    const Eigen::Affine3d frame = turned_frame(world, 5);
    const ImageVolume whole = assemble_image(header_of(file, frame), {});
    const ImageVolume image = assemble_image(header_of(file, frame), {}, 12);
    ASSERT_LE(image.values.size(), 12U);
    EXPECT_TRUE(test::has_note(image.notes, "averaged over"));
    std::size_t voxel = 0;
    for (int k = 0; k < image.size[2]; ++k)
      for (int j = 0; j < image.size[1]; ++j)
        for (int i = 0; i < image.size[0]; ++i, ++voxel) {
          double sum = 0;
          int count = 0;
          std::size_t fine = 0;
          for (int c = 0; c < whole.size[2]; ++c)
            for (int b = 0; b < whole.size[1]; ++b)
              for (int a = 0; a < whole.size[0]; ++a, ++fine) {
                const Eigen::Vector3d index =
                    image.index_to_ras_mm.inverse() * whole.index_to_ras_mm * Eigen::Vector3d(a, b, c);
                if ((index - Eigen::Vector3d(i, j, k)).cwiseAbs().maxCoeff() > 0.499) continue;
                sum += whole.values[fine];
                ++count;
              }
          EXPECT_GT(count, 0);
          EXPECT_NEAR(image.values[voxel], sum / count, 1e-4);
        }
  } while (std::next_permutation(world.begin(), world.end()));
}

TEST(Assembly, WhatIsNotFiniteBecomesTheLowestValue) {
  test::TemporaryFolder folder;
  std::vector<double> values = test::told_indices();
  values[3] = -1024.5, values[4] = -std::numeric_limits<double>::infinity(), values[5] = std::nan("");
  VolumeHeader header = header_of(folder.write("voxels", test::packed<float>(values)), Eigen::Affine3d::Identity());
  header.block.type = VoxelType::kFloat32;
  const ImageVolume image = assemble_image(header, {});
  EXPECT_EQ(*std::min_element(image.values.begin(), image.values.end()), -1024.5F);
  EXPECT_TRUE(test::has_note(image.notes, "2 voxels are not finite numbers"));
  const std::vector<double> none(24, std::nan(""));
  header.block.file = folder.write("none", test::packed<float>(none));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { assemble_image(header, {}); }),
                  "no voxel that is a finite number");
  values.assign(24, 1e300);
  header.block.type = VoxelType::kFloat64, header.block.file = folder.write("far", test::packed<double>(values));
  EXPECT_THROW(assemble_image(header, {}), InputError);  // beyond what a float holds
}

TEST(Assembly, MoreThanAFewLayersAreRefused) {
  test::TemporaryFolder folder;
  VolumeHeader header = header_of(folder.write("voxels", std::string(24 * 300, '\1')), Eigen::Affine3d::Identity());
  header.components = 300, header.component_axis = 0, header.segmentation = true;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { assemble_labels(header, {}); }), "300 layers, more than 256");
}

TEST(Frame, ImpossibleFramesAreNamed) {
  std::vector<std::string> notes;
  const auto refused = [&](const Eigen::Affine3d& frame) {
    return test::message_of<InputError>([&] { check_frame(frame, "matrix", "f.x", "; a hint", notes); });
  };
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  EXPECT_NO_THROW(check_frame(frame, "matrix", "f.x", "", notes));
  EXPECT_TRUE(notes.empty());
  frame.linear()(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_CONTAINS(refused(frame), "f.x: matrix: the transform is not finite");
  frame.linear()(0, 0) = 150;
  EXPECT_CONTAINS(refused(frame), "voxel size 150 mm along axis 1; a hint");
  frame.linear()(0, 0) = 0.009;
  EXPECT_CONTAINS(refused(frame), "voxel size 0.009 mm");
  frame.linear() << 1, 0.99, 0, 0, 0.1, 0, 0, 0, 1;
  EXPECT_CONTAINS(refused(frame), "one plane");
  frame.linear() << 1, 0.1, 0, 0, 1, 0, 0, 0, 1;
  EXPECT_NO_THROW(check_frame(frame, "matrix", "f.x", "", notes));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_CONTAINS(notes[0], "not at right angles");
}

TEST(Frame, SpacesAndUnitsByTheirNames) {
  EXPECT_EQ(ras_signs("LPS", "space", "f"), Eigen::Vector3d(-1, -1, 1));
  EXPECT_EQ(ras_signs("Left-Anterior-Superior", "space", "f"), Eigen::Vector3d(-1, 1, 1));
  EXPECT_EQ(ras_signs("ras", "space", "f"), Eigen::Vector3d(1, 1, 1));
  for (const char* other : {"", "scanner-xyz", "3D-left-handed", "RAI", "right-anterior-superior-time"})
    EXPECT_THROW(ras_signs(other, "space", "f"), InputError) << other;
  EXPECT_EQ(millimetres_in("mm", "unit", "f"), 1);
  EXPECT_EQ(millimetres_in("CM", "unit", "f"), 10);
  EXPECT_EQ(millimetres_in("dm", "unit", "f"), 100);
  EXPECT_EQ(millimetres_in("m", "unit", "f"), 1000);
  EXPECT_EQ(millimetres_in("um", "unit", "f"), 1e-3);
  EXPECT_THROW(millimetres_in("inch", "unit", "f"), InputError);
}

TEST(Frame, SizesHaveALowestAndAMost) {
  const auto refused = [](const std::array<long long, 3>& size, long long components) {
    return test::message_of<InputError>([&] { check_size(size, components, "size", "f"); });
  };
  EXPECT_NO_THROW(check_size({512, 512, 2000}, 1, "size", "f"));
  EXPECT_CONTAINS(refused({512, 512, 2000}, 2), "crop the volume");
  EXPECT_CONTAINS(refused({512, 1, 512}, 1), "1 voxels along axis 2");
  EXPECT_CONTAINS(refused({512, 5, 512}, 0), "0 values");
  EXPECT_CONTAINS(refused({1 << 20, 1 << 20, 1 << 20}, 1 << 16), "more than");
}

}  // namespace
}  // namespace trocar::volume_assembly_test
