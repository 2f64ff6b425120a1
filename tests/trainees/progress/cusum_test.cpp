// LC-CUSUM and CUSUM against weights worked by hand, the shortest runs and the simulated rates of
// reference/training.md, and an exact chain.
#include "trainees/progress/cusum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace trocar::cusum_test {
namespace {

using Phase = CusumPoint::Test;

constexpr CusumRule kLoose{0.10, 0.25, 1.5, 2.0}, kStrict{0.05, 0.15, 2.5, 2.0};

std::vector<bool> runs(std::initializer_list<std::pair<int, bool>> parts) {
  std::vector<bool> out;
  for (const auto& [count, passed] : parts) out.insert(out.end(), static_cast<std::size_t>(count), passed);
  return out;
}

/// Share of trainees who fail at that rate and show competence within 50 attempts, and the median of those 50 or
/// "never".
std::pair<double, int> simulated(const CusumRule& rule, double fails, int trainees = 20000) {
  std::mt19937 random(17);
  std::vector<int> shown_at;
  int shown = 0;
  for (int i = 0; i < trainees; ++i) {
    std::vector<bool> passed(50);
    for (std::size_t k = 0; k < passed.size(); ++k) passed[k] = random() / 4294967296.0 >= fails;
    const Competence c = competence_of(cusum(passed, rule));
    shown += c.first_shown ? 1 : 0;
    shown_at.push_back(c.first_shown.value_or(1000));
  }
  std::nth_element(shown_at.begin(), shown_at.begin() + trainees / 2, shown_at.end());
  return {static_cast<double>(shown) / trainees, shown_at[static_cast<std::size_t>(trainees) / 2]};
}

TEST(Cusum, WeightsAreThoseOfTheLikelihoodRatio) {
  // ln(0.9 / 0.75) = 0.18232, ln(0.1 / 0.25) = -0.91629.
  const auto points = cusum({true, true, true, true, true, true, false, true});
  EXPECT_NEAR(points[0].value, 0.18232, 1e-5);
  EXPECT_NEAR(points[5].value, 6 * 0.18232, 1e-4);
  EXPECT_NEAR(points[6].value, 6 * 0.18232 - 0.91629, 1e-4);
  EXPECT_NEAR(points[7].value, 7 * 0.18232 - 0.91629, 1e-4);
}

TEST(Cusum, NeverFallsBelowNothing) {
  for (const CusumPoint& point : cusum({false, false, false})) EXPECT_EQ(point.value, 0);
  EXPECT_NEAR(cusum({false, false, true}).back().value, 0.18232, 1e-5) << "many failures are forgiven like one";
}

TEST(Cusum, ShortestRunsArePublishedOnes) {
  EXPECT_EQ(shortest_run(kLoose), 9);
  EXPECT_EQ(shortest_run(), 14);
  EXPECT_EQ(shortest_run(kStrict), 23);
  for (const CusumRule& rule : {kLoose, CusumRule{}, kStrict}) {
    const int n = shortest_run(rule);
    EXPECT_FALSE(competence_of(cusum(runs({{n - 1, true}}), rule)).shown);
    EXPECT_EQ(competence_of(cusum(runs({{n, true}}), rule)).first_shown, n);
  }
}

TEST(Cusum, SimulatedRatesAreThoseOfTheReference) {
  struct Row {
    CusumRule rule;
    double fails, declared;
  };
  for (const Row& row : {Row{kLoose, 0.25, 0.68},
                         {kLoose, 0.10, 0.995},
                         {kLoose, 0.5, 0.043},
                         {{}, 0.25, 0.23},
                         {{}, 0.10, 0.937},
                         {{}, 0.5, 0.002},
                         {kStrict, 0.15, 0.15},
                         {kStrict, 0.05, 0.80}})
    EXPECT_NEAR(simulated(row.rule, row.fails).first, row.declared, 0.012) << row.rule.shown_at << " at " << row.fails;
  EXPECT_NEAR(simulated(kLoose, 0.10).second, 12, 1);
  EXPECT_NEAR(simulated({}, 0.10).second, 22, 2);
}

TEST(Cusum, AfterCompetenceFailuresCountAndPassesCalm) {
  std::vector<bool> passed = runs({{14, true}, {1, false}, {2, true}});
  const auto points = cusum(passed);
  EXPECT_EQ(points[13].test, Phase::kLearning);
  EXPECT_TRUE(points[13].decided);
  EXPECT_EQ(points[14].test, Phase::kKeeping);
  EXPECT_NEAR(points[14].value, 0.91629, 1e-5);
  EXPECT_NEAR(points[16].value, 0.91629 - 2 * 0.18232, 1e-5);
  EXPECT_TRUE(competence_of(points).shown);
}

TEST(Cusum, ThreeFailuresInARowAreARelapseAndCompetenceIsShownAnew) {
  std::vector<bool> passed = runs({{14, true}, {3, false}});
  Competence c = competence_of(cusum(passed));
  EXPECT_FALSE(c.shown);
  EXPECT_EQ(c.relapses, 1);
  EXPECT_EQ(c.first_shown, 14);
  passed.insert(passed.end(), 13, true);
  EXPECT_FALSE(competence_of(cusum(passed)).shown);
  passed.push_back(true);
  EXPECT_TRUE(competence_of(cusum(passed)).shown);
}

TEST(Cusum, RelapsesAreSeenInTimeAndSeldomInVain) {
  const auto alarms = [](double fails, std::size_t within) {
    std::mt19937 random(23);
    int seen = 0;
    for (int i = 0; i < 5000; ++i) {
      std::vector<bool> passed(14, true);
      for (std::size_t k = 0; k < within; ++k) passed.push_back(random() / 4294967296.0 >= fails);
      seen += competence_of(cusum(passed)).relapses > 0 ? 1 : 0;
    }
    return seen / 5000.0;
  };
  EXPECT_NEAR(alarms(0.4, 15), 0.92, 0.02);
  EXPECT_LT(alarms(0.1, 15), 0.15);
}

TEST(Cusum, EachPointDependsOnThePastAlone) {
  std::mt19937 random(4);
  std::vector<bool> passed;
  for (int i = 0; i < 200; ++i) passed.push_back(random() % 5 != 0);
  const auto all = cusum(passed);
  for (const std::size_t n : {1u, 20u, 77u, 150u}) {
    const auto part = cusum({passed.begin(), passed.begin() + static_cast<long>(n)});
    ASSERT_EQ(part.size(), n);
    EXPECT_EQ(part.back().value, all[n - 1].value);
    EXPECT_EQ(part.back().test, all[n - 1].test);
  }
}

TEST(Cusum, NothingAndNonsense) {
  EXPECT_TRUE(cusum({}).empty());
  EXPECT_FALSE(competence_of({}).shown);
  for (const CusumRule& rule :
       {CusumRule{0.25, 0.10, 2, 2}, CusumRule{0, 0.2, 2, 2}, CusumRule{0.1, 1, 2, 2}, CusumRule{0.1, 0.2, 0, 2}})
    EXPECT_THROW(cusum({true}, rule), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::cusum_test
