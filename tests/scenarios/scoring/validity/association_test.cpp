// Correlations against published examples, and groups told apart by hand-made points.
#include "scenarios/scoring/validity/association.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trocar::association_test {
namespace {

TEST(Association, CorrelationOfAnscombesFirstSet) {
  // Am Stat 27:17 (1973): r = .816
  EXPECT_NEAR(correlation({10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5},
                          {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68}),
              0.816, 0.0005);
}

TEST(Association, CorrelationOfLinesAndOfNothing) {
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {2, 4, 6}), 1);
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {3, 2, 1}), -1);
  EXPECT_EQ(correlation({1, 2, 3}, {5, 5, 5}), 0);
  EXPECT_EQ(correlation({1}, {1}), 0);
}

TEST(Association, RanksWithoutTiesFollowSpearmansFormula) {
  // 1 - 6 sum d^2 / (n (n^2 - 1)) with the squares of the rank differences summing to 194: -29/165
  EXPECT_NEAR(rank_correlation({86, 97, 99, 100, 101, 103, 106, 110, 112, 113}, {2, 20, 28, 27, 50, 29, 7, 17, 6, 12}),
              -29.0 / 165, 1e-12);
}

TEST(Association, TiesShareTheirMeanRank) {
  // Ranks 1.5 1.5 3 4 and 1 2 3 4: covariance 4.5, squares 4.5 and 5.
  EXPECT_NEAR(rank_correlation({7, 7, 8, 9}, {1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5), 1e-12);
}

TEST(Association, IntervalByFishersZ) {
  const auto [low, high] = correlation_interval(0.5, 28);  // atanh .5 = .5493, standard error 1/5
  EXPECT_NEAR(low, std::tanh(0.549306 - 0.2 * 1.959964), 1e-5);
  EXPECT_NEAR(high, std::tanh(0.549306 + 0.2 * 1.959964), 1e-5);
  EXPECT_EQ(correlation_interval(0.9, 3), (std::pair<double, double>(-1, 1)));
  EXPECT_LE(correlation_interval(1, 10).second, 1);
}

TEST(LeaveOneOut, AStrayPointIsTakenForItsNeighbours) {
  std::vector<GroupedPoint> points;
  for (const double x : {0, 1, 2, 9}) points.push_back({"a", {x}});
  for (const double x : {10, 11, 12, 3}) points.push_back({"b", {x}});
  const LeftOut found = leave_one_out(points);
  EXPECT_EQ(found.right, 6);
  EXPECT_EQ(found.all, 8);
  EXPECT_DOUBLE_EQ(found.share(), 0.75);
  EXPECT_EQ(found.taken_for.at("a").at("b"), 1);
  EXPECT_EQ(found.taken_for.at("b").at("a"), 1);
}

TEST(LeaveOneOut, ANoisyValueDoesNotDrownAQuietOne) {
  // The first value says nothing and varies by tens; the second tells the groups apart by one.
  std::vector<GroupedPoint> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({"a", {17.0 * (i % 4), 0.1 * (i % 3)}});
    points.push_back({"b", {11.0 + 17.0 * (i % 4), 1 + 0.1 * (i % 3)}});
  }
  EXPECT_EQ(leave_one_out(points).right, 16);
}

TEST(LeaveOneOut, ValuesThatNeverChangeAreNoHindrance) {
  std::vector<GroupedPoint> points;
  for (int i = 0; i < 4; ++i) {
    points.push_back({"a", {1, 0.01 * i}});
    points.push_back({"b", {1, 1 + 0.01 * i}});
    points.push_back({"c", {1, 2 + 0.01 * i}});
  }
  EXPECT_EQ(leave_one_out(points).right, 12);
  EXPECT_EQ(leave_one_out({}).share(), 0);
}

}  // namespace
}  // namespace trocar::association_test
