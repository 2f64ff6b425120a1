// Quartiles by attempt number, and reliability against the variances that scores were drawn from.
#include "trainees/progress/cohort_bands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trainees/progress/judgement.h"

namespace trocar::cohort_bands_test {
namespace {

using Scores = std::vector<std::vector<double>>;

/// Trainees of that true spread, with runs of that error.
Scores drawn(unsigned seed, std::size_t trainees, std::size_t runs, double between_sd, double within_sd) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Scores out(trainees);
  for (auto& scores : out) {
    const double own = 70 + between_sd * normal(random);
    for (std::size_t k = 0; k < runs; ++k) scores.push_back(own + within_sd * normal(random));
  }
  return out;
}

TEST(Spread, ByHand) {
  EXPECT_FALSE(spread_of({}));
  EXPECT_FALSE(spread_of({1}));
  const auto s = spread_of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(s->mean, 5);
  EXPECT_NEAR(s->sd, std::sqrt(32.0 / 7), 1e-12);
  EXPECT_EQ(s->n, 8);
}

TEST(CohortCurve, IsTheQuartilesOfThoseWhoGotSoFar) {
  const auto curve = cohort_curve({{10, 20, 30}, {20, 30}, {30, 40, 50}, {}, {40, 50, 70}});
  ASSERT_EQ(curve.size(), 3u);
  EXPECT_EQ(curve[0].attempt, 1);
  EXPECT_EQ(curve[0].people, 4);
  EXPECT_DOUBLE_EQ(curve[0].scores.median, 25);
  EXPECT_DOUBLE_EQ(curve[0].scores.low, 17.5);
  EXPECT_EQ(curve[2].people, 3);
  EXPECT_DOUBLE_EQ(curve[2].scores.median, 50);
}

TEST(CohortCurve, ShowsNoSinglePeople) {
  EXPECT_TRUE(cohort_curve({}).empty());
  EXPECT_TRUE(cohort_curve({{10, 20}, {20, 30}}).empty());
  EXPECT_EQ(cohort_curve({{10, 20}, {20, 30}, {30}}).size(), 1u);
}

TEST(BetweenVariance, IsWhatTheScoresWereDrawnFrom) {
  EXPECT_NEAR(*between_variance(drawn(1, 4000, 10, 8, 5), 10), 64, 4);
  EXPECT_NEAR(*between_variance(drawn(2, 4000, 10, 2, 10), 10), 4, 1.5) << "mostly chance";
  EXPECT_LT(*between_variance(drawn(3, 4000, 10, 0, 10), 10), 1) << "chance alone";
}

TEST(BetweenVariance, LooksAtTheNewestScoresAndWantsSomePeople) {
  Scores scores = drawn(4, 500, 10, 8, 5);
  const double before = *between_variance(scores, 10);
  for (auto& own : scores) own.insert(own.begin(), 5, 0.0);
  EXPECT_DOUBLE_EQ(*between_variance(scores, 10), before);
  EXPECT_FALSE(between_variance({{1, 2, 3}, {2, 3, 4}}, 10));
  EXPECT_FALSE(between_variance({{1, 2, 3}, {2, 3, 4}, {5, 6}}, 10)) << "two scores tell no spread";
  EXPECT_EQ(*between_variance({{1, 9, 1, 9}, {9, 1, 9, 1}, {1, 9, 9, 1}}, 10), 0) << "never below nothing";
}

TEST(Reliability, IsTheShareOfTrueVariance) {
  // Ten scores of variance 40: variance of the mean 4; between 12: 12 / 16.
  std::vector<double> scores;
  for (int k = 0; k < 5; ++k) scores.insert(scores.end(), {70 + 6.0, 70 - 6.0});  // sum of squares 360, / 9
  EXPECT_NEAR(*reliability(scores, 12), 0.75, 1e-12);
  EXPECT_FALSE(reliability(scores, 0));
  EXPECT_FALSE(reliability({70}, 12));
  EXPECT_NEAR(*reliability({70, 70, 70}, 12), 1, 1e-12);
}

TEST(Reliability, IsTheSquaredCorrelationOfMeanAndTruth) {
  // True SD 6, error SD 9, ten runs: 36 / (36 + 8.1) = 0.816.
  double sum = 0;
  const Scores scores = drawn(6, 3000, 10, 6, 9);
  const double between = *between_variance(scores, 10);
  for (const auto& own : scores) sum += *reliability(own, between);
  EXPECT_NEAR(sum / 3000, 0.816, 0.015);
}

}  // namespace
}  // namespace trocar::cohort_bands_test
