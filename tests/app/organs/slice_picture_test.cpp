#include "app/organs/slice_picture.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"

namespace trocar::slice_picture_test {
namespace {

TEST(CutByPlane, ASphereGivesACircleOfTheRightRadius) {
  const TriangleSurface sphere = test::sphere(Vec3(0.01, 0.02, 0.03), 0.05, 4);
  const auto segments = cut_by_plane(sphere, 2, 60);  // 30 mm above the middle: radius 40 mm
  ASSERT_GT(segments.size(), 50U);
  double length = 0;
  for (const auto& [a, b] : segments) {
    EXPECT_NEAR((a - Vec3(10, 20, 60)).norm(), 40, 0.3);
    EXPECT_EQ(a.z(), b.z());
    length += (a - b).norm();
  }
  EXPECT_NEAR(length, 2 * M_PI * 40, 1);
  EXPECT_TRUE(cut_by_plane(sphere, 2, 100).empty());
}

/// One bright voxel in a dark image.
ImageVolume one_voxel(int i, int j, int k) {
  ImageVolume image;
  image.size = {20, 20, 20};
  image.values.assign(8000, -1000);
  image.values[image.offset(i, j, k)] = 1000;
  image.index_to_ras_mm.linear() *= 5;
  image.modality = "CT";
  return image;
}

/// Place of the brightest patch, share of width and height.
std::pair<double, double> brightest(const Image& image) {
  double x = 0, y = 0, count = 0;
  for (int row = 40; row < image.height - 40; ++row)  // away from the words
    for (int column = 0; column < image.width; ++column)
      if (image.pixel(column, row)[0] > 250) x += column, y += row, ++count;
  EXPECT_GT(count, 0);
  return {x / count / image.width, y / count / image.height};
}

TEST(SlicePicture, ShowsThePatientsRightOnTheLeft) {
  const Vec3 middle(50, 50, 50);
  const ImageVolume right = one_voxel(14, 10, 10);  // x = 70: to the patient's right of the middle
  EXPECT_LT(brightest(slice_picture({&right, nullptr}, {}, SlicePlane::kAxial, middle, 100, 300)).first, 0.4);
  EXPECT_LT(brightest(slice_picture({&right, nullptr}, {}, SlicePlane::kCoronal, middle, 100, 300)).first, 0.4);
}

TEST(SlicePicture, AnteriorAndHeadAreUp) {
  const Vec3 middle(50, 50, 50);
  const ImageVolume front = one_voxel(10, 14, 10), head = one_voxel(10, 10, 14);
  EXPECT_LT(brightest(slice_picture({&front, nullptr}, {}, SlicePlane::kAxial, middle, 100, 300)).second, 0.4);
  EXPECT_LT(brightest(slice_picture({&head, nullptr}, {}, SlicePlane::kCoronal, middle, 100, 300)).second, 0.4);
  EXPECT_LT(brightest(slice_picture({&front, nullptr}, {}, SlicePlane::kSagittal, middle, 100, 300)).first, 0.4);
}

TEST(SlicePicture, DrawsOutlinesInTheirColour) {
  const TriangleSurface sphere = test::sphere(Vec3(0.05, 0.05, 0.05), 0.03, 3);
  const Image image =
      slice_picture({}, {{&sphere, Colour{255, 0, 0, 1}}}, SlicePlane::kAxial, Vec3(50, 50, 50), 100, 300);
  const std::uint8_t* on = image.pixel(150, 150 - 90);  // 30 mm up at 3 px a millimetre
  int red = 0;
  for (int row = 55; row < 66; ++row) red += image.pixel(150, row)[0] > 200 && image.pixel(150, row)[1] < 60;
  EXPECT_GT(red, 0) << static_cast<int>(on[0]);
}

TEST(SlicePicture, WithoutAnImageTheLabelsAreTheGround) {
  LabelMap map;
  map.layers.push_back(test::ball_volume(20, 5, Eigen::Vector3d(0, 0, 0), 30));
  const Image image = slice_picture({nullptr, &map}, {}, SlicePlane::kAxial, Vec3::Zero(), 100, 200);
  EXPECT_GT(image.pixel(100, 100)[0], image.pixel(100, 20)[0]);
}

TEST(DisplayWindow, CtHasTheSoftTissueWindowAndMrItsOwn) {
  ImageVolume image = one_voxel(1, 1, 1);
  EXPECT_EQ(display_window(image), (std::array<double, 2>{-160, 240}));
  image.modality = "MR";
  for (std::size_t n = 0; n < image.values.size(); ++n) image.values[n] = static_cast<float>(n);
  const auto window = display_window(image);
  EXPECT_NEAR(window[0], 80, 2);
  EXPECT_NEAR(window[1], 7920, 2);
  image.values.assign(8000, 3);
  EXPECT_GT(display_window(image)[1], display_window(image)[0]) << "a flat image divides by nothing";
}

}  // namespace
}  // namespace trocar::slice_picture_test
