// Variance components and reliability against closed forms, a published table and drawn scores.
#include "scenarios/scoring/validity/reliability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "scenarios/hands/hand_random.h"

namespace trocar::reliability_test {
namespace {

constexpr std::size_t kP = kPersonFacet, kB = kBoardFacet, kA = kAttemptFacet;

TEST(Reliability, IccOfShroutAndFleiss1979) {
  // Psychol Bull 86:420, table 2: six targets, four judges; ICC(2,1) is .29 in table 4.
  const std::vector<std::vector<double>> ratings{{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                                 {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  EXPECT_NEAR(icc_agreement(ratings), 0.29, 0.005);
}

TEST(Reliability, MeanSquaresOfShroutAndFleiss1979) {
  // Table 3: between targets 11.24, between judges 32.49, residual 1.02.
  const double ratings[6][4] = {{9, 2, 5, 8}, {6, 1, 3, 2}, {8, 4, 6, 8}, {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  ScoreCube cube(6, 4, 1);
  for (std::size_t p = 0; p < 6; ++p) {
    for (std::size_t b = 0; b < 4; ++b) cube.at(p, b, 0) = ratings[p][b];
  }
  const VarianceComponents found = variance_components(cube);
  EXPECT_NEAR(found.mean_square[kP], 11.24, 0.005);
  EXPECT_NEAR(found.mean_square[kB], 32.49, 0.005);
  EXPECT_NEAR(found.mean_square[kP | kB], 1.02, 0.005);
  EXPECT_NEAR(found.estimate[kP], (11.24 - 1.02) / 4, 0.01);
  EXPECT_EQ(found.estimate[kA], 0) << "attempts do not vary";
}

TEST(Reliability, ComponentsOfOrthogonalEffects) {
  // Two levels each, coded -1 and 1: a coefficient c has the mean square 8 c^2.
  ScoreCube cube(2, 2, 2);
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t b = 0; b < 2; ++b) {
      for (std::size_t a = 0; a < 2; ++a) {
        const double x = p ? 1 : -1, y = b ? 1 : -1, z = a ? 1 : -1;
        cube.at(p, b, a) = 70 + 4 * x + 2 * y + z + 1.5 * x * y + 0.5 * x * z + 0.25 * y * z + 0.5 * x * y * z;
      }
    }
  }
  const VarianceComponents found = variance_components(cube);
  EXPECT_NEAR(found.mean_square[kP], 128, 1e-9);
  EXPECT_NEAR(found.mean_square[kB | kA], 0.5, 1e-9);
  EXPECT_NEAR(found.estimate[kP | kB | kA], 2, 1e-9);
  EXPECT_NEAR(found.estimate[kP | kB], 8, 1e-9);
  EXPECT_NEAR(found.estimate[kP | kA], 0, 1e-9);
  EXPECT_NEAR(found.estimate[kB | kA], -0.75, 1e-9);
  EXPECT_NEAR(found.estimate[kP], 27.5, 1e-9);
  EXPECT_NEAR(found.estimate[kB], 3.875, 1e-9);
  EXPECT_NEAR(found.estimate[kA], 1.875, 1e-9);
  EXPECT_EQ(found.variance(kB | kA), 0) << "a negative estimate is no variance";
  EXPECT_NEAR(found.error(), 2 + 8 + 3.875 + 1.875, 1e-9);
  EXPECT_NEAR(found.standard_error(), std::sqrt(15.75), 1e-9);
}

TEST(Reliability, DrawnComponentsAreFoundAgain) {
  constexpr std::size_t kPersons = 150, kBoards = 8, kAttempts = 6;
  HandRandom random(20);
  ScoreCube cube(kPersons, kBoards, kAttempts);
  std::vector<double> person(kPersons), board(kBoards), attempt(kAttempts);
  for (double& effect : person) effect = 10 * random.normal();
  for (double& effect : board) effect = 3 * random.normal();
  for (double& effect : attempt) effect = 2 * random.normal();
  for (std::size_t p = 0; p < kPersons; ++p) {
    for (std::size_t b = 0; b < kBoards; ++b) {
      const double both = 4 * random.normal();
      for (std::size_t a = 0; a < kAttempts; ++a)
        cube.at(p, b, a) = 60 + person[p] + board[b] + attempt[a] + both + 5 * random.normal();
    }
  }
  const VarianceComponents found = variance_components(cube);
  EXPECT_NEAR(found.variance(kP), 100, 25);
  EXPECT_NEAR(found.variance(kP | kB), 16, 2);
  EXPECT_NEAR(found.variance(kP | kB | kA), 25, 1);
  EXPECT_NEAR(found.variance(kP | kA), 0, 0.5);
}

TEST(Reliability, MoreAttemptsAreMoreDependable) {
  VarianceComponents found;
  found.estimate[kP] = 50;
  found.estimate[kP | kA] = 50;
  EXPECT_DOUBLE_EQ(found.dependability(1), 0.5);
  EXPECT_DOUBLE_EQ(found.dependability(4), 0.8);  // Spearman and Brown
  EXPECT_EQ(found.attempts_for(0.8), 4);
  EXPECT_EQ(found.attempts_for(0.81), 5);
  EXPECT_EQ(VarianceComponents().attempts_for(0.8), 0) << "nobody differs";
  EXPECT_EQ(VarianceComponents().dependability(1), 0);
}

TEST(Reliability, RefusesWhatHasNothingToCompare) {
  EXPECT_THROW(variance_components(ScoreCube(1, 4, 2)), std::invalid_argument);
  EXPECT_THROW(variance_components(ScoreCube(4, 1, 1)), std::invalid_argument);
  EXPECT_THROW(icc_agreement({{1, 2}, {3}}), std::invalid_argument);
  EXPECT_EQ(icc_agreement({{5, 5}, {5, 5}}), 0);
}

TEST(Reliability, FacetsInWords) {
  EXPECT_EQ(facet_words(kP), "person");
  EXPECT_EQ(facet_words(kP | kB | kA), "person x board x attempt");
}

}  // namespace
}  // namespace trocar::reliability_test
