// Where the plumb line's foot lies while something is touched, and where words stand by what is lit.
#include "app/window/run/tip_guide.h"

#include <gtest/gtest.h>

#include <random>

namespace trocar::tip_guide_test {
namespace {

TEST(TipGuide, TheFootLiesWhereTheTipTouchesAndNotWhereTheShaftLeans) {
  const Vec3 tip_T(0.02, 0.01, 0.03);
  StylusState stylus;
  stylus.X_TI.p = tip_T;
  EXPECT_FALSE(touched_at(stylus, tip_T)) << "touches nothing";
  stylus.contact = true;
  stylus.contact_point_T = tip_T - Vec3(0, 0, 0.003);
  ASSERT_TRUE(touched_at(stylus, tip_T));
  EXPECT_EQ(*touched_at(stylus, tip_T), stylus.contact_point_T);
  stylus.contact_point_T = tip_T + Vec3(0.03, 0, 0.04);  // a peg beside the way, half up the shaft
  EXPECT_FALSE(touched_at(stylus, tip_T));
}

TEST(TipGuide, WordsByTheBallLieUnderNoMessageAndOutsideOfNothing) {
  const HudBox window{0, 0, 1280, 720}, words{0, 0, 240, 26}, ball{600, 100, 40, 40};
  const auto meets = [](const HudBox& a, const HudBox& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
  };
  const Eigen::Vector2d aside(100, 600), below(620, 150);
  const auto plain = place_words(ball, words, aside, window, {});
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->y, ball.bottom());
  EXPECT_EQ(plain->x + 0.5 * plain->width, 620) << "below its middle";
  EXPECT_EQ(place_words(ball, words, below, window, {})->y, ball.y - words.height) << "the tip is there";
  // A notice where it would stand then: beside the ball, the tip still to be seen.
  const HudBox notice{500, 70, 300, 28};
  const auto beside = place_words(ball, words, below, window, {notice});
  ASSERT_TRUE(beside);
  EXPECT_FALSE(meets(*beside, notice) || meets(*beside, ball));
  // Messages anywhere, the ball anywhere: over none of them, never out of the window.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(0, 1000), down(0, 650), wide(50, 700);
  for (int i = 0; i < 2000; ++i) {
    const HudBox lit{across(random), down(random), 60, 60};
    const std::vector<HudBox> messages{{across(random), down(random), wide(random), 50},
                                       {across(random), down(random), wide(random), 120}};
    const auto at = place_words(lit, words, Eigen::Vector2d(across(random), down(random)), window, messages);
    if (!at) continue;
    EXPECT_FALSE(meets(*at, messages[0]) || meets(*at, messages[1]));
    EXPECT_GE(std::min(at->x, at->y), 0);
    EXPECT_LE(at->right(), window.right());
    EXPECT_LE(at->bottom(), window.bottom());
  }
  EXPECT_FALSE(place_words(ball, words, aside, window, {window})) << "no room";
}

}  // namespace
}  // namespace trocar::tip_guide_test
