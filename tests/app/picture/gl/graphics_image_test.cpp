#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/picture/gl/canvas.h"
#include "app/picture/gl/image.h"
#include "haptics/input_error.h"

namespace trocar::graphics_image_test {
namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(x * 7);
      p[1] = static_cast<std::uint8_t>(y * 5);
      p[2] = static_cast<std::uint8_t>(x ^ y);
    }
  return image;
}

TEST(Png, ReadsBackPixelForPixel) {
  const Image image = gradient(67, 41);
  const auto path = std::filesystem::temp_directory_path() / "trocar_png_test.png";
  write_png(path, image);
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&reader, path.c_str()));
  reader.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(reader));
  ASSERT_TRUE(png_image_finish_read(&reader, nullptr, back.data(), 0, nullptr));
  EXPECT_EQ(reader.width, 67U);
  EXPECT_EQ(reader.height, 41U);
  EXPECT_EQ(back, image.rgb);
  std::filesystem::remove(path);
}

TEST(Png, SamePictureSameBytes) { EXPECT_EQ(encode_png(gradient(50, 50)), encode_png(gradient(50, 50))); }

TEST(Png, UnwritableFileIsAnEnvironmentErrorThatNamesIt) {
  try {
    write_png("/nonexistent-folder/a.png", gradient(4, 4));
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent-folder/a.png"), std::string::npos);
  }
}

TEST(Canvas, ShapesCoverTheirAreaWithSoftEdges) {
  Image image(100, 100);
  Canvas canvas(image);
  canvas.disc(50, 50, 20, {255, 255, 255, 1});
  double sum = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) sum += image.pixel(x, y)[0] / 255.0;
  EXPECT_NEAR(sum, 3.14159265 * 400, 8);  // one-pixel edge ramps integrate to the area
  EXPECT_EQ(image.pixel(50, 50)[0], 255);
  EXPECT_EQ(image.pixel(75, 50)[0], 0);
}

TEST(Canvas, TriangleWorksInBothWindings) {
  for (const bool turned : {false, true}) {
    Image image(40, 40);
    Canvas canvas(image);
    if (turned)
      canvas.triangle(5, 5, 5, 35, 35, 5, {255, 0, 0, 1});
    else
      canvas.triangle(5, 5, 35, 5, 5, 35, {255, 0, 0, 1});
    EXPECT_EQ(image.pixel(12, 12)[0], 255);
    EXPECT_EQ(image.pixel(30, 30)[0], 0);
  }
}

TEST(Canvas, ShapesBeyondTheEdgeAreCut) {
  Image image(20, 20);
  Canvas canvas(image);
  canvas.box({-50, -50, 200, 200}, {10, 20, 30, 1});
  canvas.line(-10, 10, 500, 10, 2, {200, 200, 200, 0.5});
  EXPECT_EQ(image.pixel(0, 0)[2], 30);
  EXPECT_EQ(image.pixel(19, 19)[1], 20);
}

TEST(Canvas, HatchLeavesGaps) {
  Image image(60, 60);
  Canvas canvas(image);
  canvas.hatch({0, 0, 60, 60}, 8, 2, {255, 255, 255, 1});
  int lit = 0;
  for (int i = 0; i < 3600; ++i) lit += image.rgb[static_cast<std::size_t>(i) * 3] > 127;
  EXPECT_NEAR(lit / 3600.0, 0.25, 0.06);  // 2 px of every 8
}

}  // namespace
}  // namespace trocar::graphics_image_test
