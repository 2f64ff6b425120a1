#include "app/picture/gl/frame_target.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include "tests/support/headless_fixture.h"

namespace trocar::frame_target_test {
namespace {

/// Two rows of two px, lowest first: red green / blue white.
class FrameTargetTest : public testing_support::HeadlessFixture {
 protected:
  unsigned four_colours() {
    constexpr std::array<std::uint8_t, 16> kTexels{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    unsigned texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, kTexels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
  }
  static std::array<int, 3> at(const Image& image, int x, int y) {
    const std::uint8_t* p = image.pixel(x, y);
    return {p[0], p[1], p[2]};
  }
  using Rgb3 = std::array<int, 3>;
};

TEST_F(FrameTargetTest, BeginClearsToTheGround) {
  FrameTarget target(*context_, false);
  target.begin(80, 60);
  const Image image = target.read();
  EXPECT_EQ(image.width, 80);
  EXPECT_EQ(image.height, 60);
  EXPECT_EQ(at(image, 0, 0), (Rgb3{0, 0, 0}));
  EXPECT_EQ(at(image, 79, 59), (Rgb3{0, 0, 0}));
}

TEST_F(FrameTargetTest, PlacesLowestRowFirstAndYDown) {
  FrameTarget target(*context_, false);
  target.begin(100, 80);
  target.place(four_colours(), {10, 20, 40, 20}, 0);
  const Image image = target.read();
  EXPECT_EQ(at(image, 12, 22), (Rgb3{0, 0, 255})) << "upper left is the texture's upper row";
  EXPECT_EQ(at(image, 47, 22), (Rgb3{255, 255, 255}));
  EXPECT_EQ(at(image, 12, 38), (Rgb3{255, 0, 0}));
  EXPECT_EQ(at(image, 47, 38), (Rgb3{0, 255, 0}));
  EXPECT_EQ(at(image, 9, 30), (Rgb3{0, 0, 0})) << "nothing outside its part";
  EXPECT_EQ(at(image, 50, 30), (Rgb3{0, 0, 0}));
  EXPECT_EQ(at(image, 30, 19), (Rgb3{0, 0, 0}));
  EXPECT_EQ(at(image, 30, 40), (Rgb3{0, 0, 0}));
}

TEST_F(FrameTargetTest, DimsDownToBlack) {
  FrameTarget target(*context_, false);
  const unsigned texture = four_colours();
  target.begin(64, 48);
  target.place(texture, {0, 0, 64, 48}, 0.5);
  EXPECT_NEAR(at(target.read(), 60, 4)[0], 128, 1);
  target.begin(64, 48);
  target.place(texture, {0, 0, 64, 48}, 1);
  EXPECT_EQ(at(target.read(), 60, 4), (Rgb3{0, 0, 0}));
}

TEST_F(FrameTargetTest, FollowsTheSizeFromFrameToFrame) {
  FrameTarget target(*context_, false);
  for (const auto& [width, height] :
       {std::pair{200, 100}, std::pair{64, 48}, std::pair{3840, 2160}, std::pair{640, 480}}) {
    target.begin(width, height);
    target.place(four_colours(), {0, 0, width, height}, 0);
    const Image image = target.read();
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(at(image, width - 1, height - 1), (Rgb3{0, 255, 0}));
  }
}

TEST_F(FrameTargetTest, RefusesWhatHasNoPicture) {
  FrameTarget target(*context_, false);
  EXPECT_THROW(target.begin(63, 480), std::invalid_argument);
  EXPECT_THROW(target.begin(640, 47), std::invalid_argument);
  EXPECT_THROW(target.read(), std::logic_error);
  EXPECT_THROW(target.place(0, {0, 0, 10, 10}, 0), std::logic_error);
}

}  // namespace
}  // namespace trocar::frame_target_test
