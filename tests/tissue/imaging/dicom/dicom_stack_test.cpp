// Slices as a grid, and contours' grids: the geometry without any file.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/byte_source.h"
#include "tissue/imaging/dicom/contour_grid.h"
#include "tissue/imaging/dicom/pixel_codes.h"
#include "tissue/imaging/dicom/rt_structures.h"
#include "tissue/imaging/dicom/slice_stack.h"
#include "tissue/imaging/dicom/slice_volume.h"

namespace trocar::test::dicom_stack_test {
namespace {

std::vector<StackSlice> pile(int count, const Eigen::Vector3d& step) {
  std::vector<StackSlice> slices;
  for (int k = 0; k < count; ++k) {
    SlicePlace place;
    place.position = Eigen::Vector3d(1, 2, 3) + k * step;
    slices.push_back({place, 4, 5, "f" + std::to_string(k)});
  }
  return slices;
}

TEST(SliceStack, StepShiftAndTiltOfAShearedPile) {
  const SliceStack stack = stacked(pile(9, {0.3, -0.4, 2}), "in");
  EXPECT_NEAR(stack.slice_step, 2, 1e-12);
  EXPECT_NEAR(stack.shift.x(), 0.3, 1e-12);
  EXPECT_NEAR(stack.shift.y(), -0.4, 1e-12);
  EXPECT_NEAR(stack.tilt_deg, std::atan(0.25) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(stack.order.front(), 0U);
}

TEST(SliceStack, OrderFollowsTheNormalNotTheFiles) {
  auto slices = pile(5, {0, 0, -3});
  std::swap(slices[1], slices[3]);
  const SliceStack stack = stacked(slices, "in");
  EXPECT_EQ(stack.order, (std::vector<std::size_t>{4, 1, 2, 3, 0}));
  EXPECT_NEAR(stack.origin.z(), 3 - 12, 1e-12);
  EXPECT_EQ(stack.tilt_deg, 0);
}

TEST(SliceStack, ASmallUnevennessIsTakenALargeOneNot) {
  auto slices = pile(6, {0, 0, 5});
  slices[2].place.position.z() += 0.4;
  EXPECT_NEAR(stacked(slices, "in").slice_step, 5, 1e-12);
  slices[2].place.position.z() += 0.2;
  EXPECT_CONTAINS(message_of<InputError>([&] { stacked(slices, "in"); }),
                  "f2: lies 0.6 mm from where evenly spaced slices (5 mm)");
}

TEST(SliceStack, SlicesInOnePlaneButNotInOnePlaceAreToldApart) {
  auto slices = pile(4, {0, 0, 5});
  slices[3].place.position = slices[1].place.position + Eigen::Vector3d(40, 0, 0);
  EXPECT_CONTAINS(message_of<InputError>([&] { stacked(slices, "in"); }),
                  "f1 and f3 lie in the same plane, side by side");
  slices[3].place.position = slices[1].place.position;
  slices.push_back(slices[0]);
  EXPECT_CONTAINS(message_of<InputError>([&] { stacked(slices, "in"); }),
                  "lie in the same place, and so do 1 other pairs");
  EXPECT_CONTAINS(message_of<InputError>([&] { stacked({}, "in"); }), "in: holds no images");
}

/// The shear moves whole pixels here, so values must come out as they went in.
TEST(SliceVolume, AShiftByWholePixelsMovesValuesExactly) {
  auto slices = pile(3, {1, 0, 2});
  const SliceStack stack = stacked(slices, "in");
  SliceVolume volume(stack, -7, "in");
  std::vector<float> values(20);
  for (std::size_t n = 0; n < 20; ++n) values[n] = static_cast<float>(n);
  for (std::size_t k = 0; k < 3; ++k) volume.put(k, values);
  const ImageVolume image = volume.take();
  ASSERT_EQ(image.size, (std::array<int, 3>{7, 4, 3}));
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 7; ++i) {
        const Eigen::Vector3d ras = image.index_to_ras_mm * Eigen::Vector3d(i, j, k);
        const long column = std::lround(-ras.x() - 1 - k), row = std::lround(-ras.y() - 2);
        const float expected = column >= 0 && column < 5 ? static_cast<float>(5 * row + column) : -7;
        EXPECT_EQ(image.values[image.offset(i, j, k)], expected) << i << " " << j << " " << k;
      }
}

TEST(SliceVolume, AShearThatWouldNeedTooManyVoxelsIsRefused) {
  auto slices = pile(300, {1000, 1000, 1});
  const SliceStack stack = stacked(slices, "in");
  EXPECT_CONTAINS(message_of<InputError>([&] { const SliceVolume volume(stack, 0, "in"); }),
                  "more than an import may hold");
}

ImageVolume grid_of(const std::array<int, 3>& size) {
  ImageVolume image;
  image.size = size;
  image.index_to_ras_mm.linear() = Eigen::Vector3d(2, 3, 4).asDiagonal();
  return image;
}

Structure structure_in_plane(int normal_axis, double at) {
  Structure structure{1, "a", {}, 0};
  Contour contour;
  for (const auto& [u, v] : {std::pair(1.0, 1.0), std::pair(9.0, 1.0), std::pair(9.0, 7.0), std::pair(1.0, 7.0)}) {
    Eigen::Vector3d point = Eigen::Vector3d::Constant(at);
    point[(normal_axis + 1) % 3] = u, point[(normal_axis + 2) % 3] = v;
    contour.push_back(point);
  }
  structure.closed.push_back(contour);
  return structure;
}

TEST(ContourGrid, TheAxisThatContoursAreNormalToComesLast) {
  for (int axis = 0; axis < 3; ++axis) {
    const ImageVolume image = grid_of({10, 20, 30});
    const ContourGrid grid = image_contour_grid(image, {structure_in_plane(axis, 4)}, "f");
    EXPECT_EQ(grid.size[2], image.size[static_cast<std::size_t>(axis)]);
    EXPECT_DOUBLE_EQ(grid.step_mm(2), 2.0 + axis);
    EXPECT_EQ(grid.size[0] * grid.size[1] * grid.size[2], 6000);
    const Eigen::Vector3d lps(4, 4, 4);
    EXPECT_NEAR(grid.index_of(lps).z(), (axis == 2 ? 4.0 : -4.0) / (2.0 + axis), 1e-12);
  }
}

TEST(ContourGrid, AnOwnGridHoldsEveryPointAndResolvesTheSmallest) {
  std::vector<Structure> structures{structure_in_plane(2, 10), structure_in_plane(2, 16), structure_in_plane(2, 12)};
  const ContourGrid grid = own_contour_grid(structures, "f");
  EXPECT_EQ(grid.size[2], 4 + 2) << "an empty slice at either end";
  EXPECT_NEAR(grid.step_mm(2), 2, 1e-12);
  EXPECT_NEAR(grid.step_mm(0), 0.25, 1e-12) << "8 mm across would be 60 pixels of 0.13 mm: the finest is 0.25";
  for (const Structure& structure : structures)
    for (const Eigen::Vector3d& point : structure.closed[0]) {
      const Eigen::Vector3d at = grid.index_of(point);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(at[axis], -0.01);
        EXPECT_LT(at[axis], grid.size[static_cast<std::size_t>(axis)] - 0.99);
      }
    }
}

TEST(ContourGrid, WhatMakesNoGridIsRefused) {
  EXPECT_CONTAINS(message_of<InputError>([] { own_contour_grid({structure_in_plane(2, 1)}, "f"); }), "single plane");
  EXPECT_CONTAINS(
      message_of<InputError>([] {
        own_contour_grid({structure_in_plane(2, 1), structure_in_plane(2, 2), structure_in_plane(2, 3.5)}, "f");
      }),
      "not evenly spaced");
  EXPECT_CONTAINS(message_of<InputError>([] {
                    own_contour_grid({structure_in_plane(2, 1), structure_in_plane(1, 2)}, "f");
                  }),
                  "parallel planes");
  Structure line{1, "line", {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, 0};
  EXPECT_CONTAINS(message_of<InputError>([&] { own_contour_grid({line}, "f"); }), "enclose no area");
  Structure wide{
      1, "wide", {{{0, 0, 0}, {90000, 0, 0}, {90000, 90000, 0}}, {{0, 0, 1}, {90000, 0, 1}, {90000, 90000, 1}}}, 0};
  EXPECT_CONTAINS(message_of<InputError>([&] { own_contour_grid({wide}, "f"); }),
                  "more voxels than an import may hold");
}

TEST(ContourGrid, ContoursThatWindWithoutEndAreRefused) {
  const TemporaryFolder folder;
  StructureFixture winding;
  for (const double z : {0.0, 1.0, 2.0}) {
    std::vector<Eigen::Vector3d> points{{-60, 0, z}, {-60, -270, z}};
    for (int n = 0; n < 34000; ++n) points.emplace_back(n % 100 - 50, n % 2 == 0 ? -260 : 260, z);
    points.emplace_back(60, -270, z), points.emplace_back(60, 0, z);
    winding.contours.push_back(points);
  }
  const auto file = folder.write("rt", dicom_file(structure_set({winding})));
  EXPECT_CONTAINS(message_of<InputError>([&] { read_rtstruct(file); }),
                  "wind to and fro more often than any drawing does");
}

TEST(ByteSource, ReadsInsideAndNothingOutside) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int n = 0; n < 40000; ++n) bytes += static_cast<char>(n * 7);
  ByteSource file(folder.write("f", bytes), "f"), memory(bytes, "m");
  for (ByteSource* source : {&file, &memory}) {
    ASSERT_EQ(source->size(), 40000U);
    for (const std::size_t at :
         {std::size_t{0}, std::size_t{16380}, std::size_t{39990}, std::size_t{5}, std::size_t{20000}})
      EXPECT_EQ(source->bytes(at, 10), bytes.substr(at, 10)) << at;
    EXPECT_EQ(source->bytes(100, 39000), bytes.substr(100, 39000));
    char one = 0;
    EXPECT_TRUE(source->read(40000, &one, 0));
    EXPECT_FALSE(source->read(40000, &one, 1));
    EXPECT_FALSE(source->read(~std::uint64_t{0}, &one, 1));
    EXPECT_FALSE(source->read(1, &one, ~std::size_t{0}));
    EXPECT_THROW(source->bytes(39999, 2), InputError);
  }
  EXPECT_CONTAINS(message_of<InputError>([&] { const ByteSource none(folder / "none", "none"); }),
                  "none: cannot be opened as a file");
  EXPECT_CONTAINS(message_of<InputError>([&] { const ByteSource none(folder.path(), "folder"); }),
                  "folder: cannot be opened as a file");
}

DicomImage coded(const char* syntax, int rows, int columns, int allocated) {
  DicomImage image;
  image.rows = rows, image.columns = columns, image.frames = 1;
  image.format = {allocated, allocated, allocated - 1, false};
  image.syntax = transfer_syntax(syntax);
  return image;
}

TEST(PixelCodes, WhatAFrameSaysOfItselfMustFitTheHeader) {
  constexpr const char *kJpegLossless = "1.2.840.10008.1.2.4.70", *kJpegLs = "1.2.840.10008.1.2.4.80";
  const auto jpeg = [](char marker, int bits, int rows, int columns, int parts) {
    return std::string("\xFF\xD8\xFF\xE0\0\x04xx\xFF", 9) + marker + std::string("\0\x0B", 2) +
           static_cast<char>(bits) + '\0' + static_cast<char>(rows) + '\0' + static_cast<char>(columns) +
           static_cast<char>(parts) + "\1\x11" + '\0' + std::string("data\xFF\xD9", 6);
  };
  const auto refusal = [](const std::string& bytes, const DicomImage& image) {
    return message_of<InputError>([&] { check_compressed_frame(bytes, image, "f"); });
  };
  const DicomImage image = coded(kJpegLossless, 5, 6, 16);
  check_compressed_frame(jpeg('\xC3', 16, 5, 6, 1), image, "f");
  check_compressed_frame(jpeg('\xC3', 12, 5, 6, 1) + std::string(1, '\0'), image, "f");
  check_compressed_frame(jpeg('\xF7', 16, 5, 6, 1), coded(kJpegLs, 5, 6, 16), "f");
  EXPECT_CONTAINS(refusal(jpeg('\xC3', 16, 6, 5, 1), image), "compressed pixels are 5 x 6 in 1 colours");
  EXPECT_CONTAINS(refusal(jpeg('\xC3', 16, 5, 6, 3), image), "in 3 colours");
  EXPECT_CONTAINS(refusal(jpeg('\xC3', 16, 5, 6, 1), coded(kJpegLossless, 5, 6, 8)), "have 16 bits, its header says 8");
  EXPECT_CONTAINS(refusal(jpeg('\xC3', 16, 5, 6, 1).substr(0, 24), image), "cut off");
  EXPECT_CONTAINS(refusal("", image), "are not JPEG Lossless");
  EXPECT_CONTAINS(refusal(std::string("\xFF\xD8\xFF\xE0\0\0\xFF\xD9", 8), image), "or are damaged");
  EXPECT_CONTAINS(refusal(std::string(200, '\xFF'), image), "or are damaged");
}

TEST(PixelCodes, RleMustGiveEveryByte) {
  const DicomImage image = coded(kRle, 5, 6, 16);
  const std::string whole = rle_frame(std::string(60, 'x'), 2);
  EXPECT_EQ(decode_rle_frame(whole, image, "f"), std::string(60, 'x'));
  for (std::size_t length = 0; length + 1 < whole.size(); length += 3)
    EXPECT_THROW(decode_rle_frame(whole.substr(0, length), image, "f"), InputError) << length;
  std::string wild = whole;
  wild[8] = wild[9] = static_cast<char>(0xFF);
  EXPECT_CONTAINS(message_of<InputError>([&] { decode_rle_frame(wild, image, "f"); }), "cut off or damaged");
}

}  // namespace
}  // namespace trocar::test::dicom_stack_test
