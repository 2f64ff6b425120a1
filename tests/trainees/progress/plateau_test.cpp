// Theil-Sen by hand, against its breakdown point and symmetries; flat and rising windows.
#include "trainees/progress/plateau.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace trocar::plateau_test {
namespace {

TEST(TheilSen, IsTheSlopeOfALine) {
  EXPECT_FALSE(theil_sen_slope({}));
  EXPECT_FALSE(theil_sen_slope({50}));
  EXPECT_DOUBLE_EQ(*theil_sen_slope({50, 53}), 3);
  EXPECT_DOUBLE_EQ(*theil_sen_slope({10, 12.5, 15, 17.5, 20}), 2.5);
}

TEST(TheilSen, IsTheMedianOfSlopesByHand) {
  // Pairs of 1, 4, 2: 3, 0.5, -2; median 0.5. Of 1, 4, 2, 8: 3, 0.5, 7/3, -2, 2, 6: sorted -2 0.5 2 2.33 3 6, median
  // 13/6.
  EXPECT_DOUBLE_EQ(*theil_sen_slope({1, 4, 2}), 0.5);
  EXPECT_NEAR(*theil_sen_slope({1, 4, 2, 8}), 13.0 / 6, 1e-12);
}

TEST(TheilSen, OneBadDayDoesNotBendIt) {
  EXPECT_DOUBLE_EQ(*theil_sen_slope({10, 12, 14, 16, 18, 20, 22, 24}), 2);
  EXPECT_NEAR(*theil_sen_slope({10, 12, 14, 16, 18, 20, 22, 0}), 2, 1e-12) << "least squares would say -0.2";
}

TEST(TheilSen, TurnsAndScalesWithTheScores) {
  std::mt19937 random(3);
  std::vector<double> scores(15), mirrored, scaled;
  for (double& s : scores) s = static_cast<double>(random() % 10000) / 100;
  for (const double s : scores) {
    mirrored.push_back(-s);
    scaled.push_back(7 + 3 * s);
  }
  EXPECT_NEAR(*theil_sen_slope(mirrored), -*theil_sen_slope(scores), 1e-12);
  EXPECT_NEAR(*theil_sen_slope(scaled), 3 * *theil_sen_slope(scores), 1e-12);
  std::reverse(scores.begin(), scores.end());
  EXPECT_NEAR(*theil_sen_slope(mirrored), *theil_sen_slope(scores), 1e-12);
}

TEST(Plateau, LooksAtTheNewestScoresOnly) {
  EXPECT_FALSE(plateau({60, 60, 60, 60, 60}, 6, 2)) << "too few to say";
  const auto flat = plateau({10, 20, 30, 40, 60, 61, 60, 61, 60, 61}, 6, 2);
  EXPECT_TRUE(flat->flat);
  EXPECT_EQ(flat->n, 6);
  const auto rising = plateau({60, 60, 60, 60, 60, 61, 62, 63, 64, 65}, 6, 2);
  EXPECT_FALSE(rising->flat);
  EXPECT_NEAR(rising->rise, 5, 1e-12);
  EXPECT_TRUE(plateau({70, 65, 60, 55, 50, 45}, 6, 2)->flat) << "falling is flat too";
}

TEST(Plateau, BoundIsTheRiseOverTheWindow) {
  const std::vector<double> scores{50, 50.4, 50.8, 51.2, 51.6, 52};  // 2.0 over the window
  EXPECT_FALSE(plateau(scores, 6, 1.99)->flat);
  EXPECT_TRUE(plateau(scores, 6, 2.01)->flat);
  EXPECT_FALSE(plateau(scores, 1, 2));
}

}  // namespace
}  // namespace trocar::plateau_test
