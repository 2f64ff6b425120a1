// The statistics that say whether a score tells skill apart, against hand-computed groups, and scorers known to be bad.
#include "scenarios/scoring/construct_validity.h"

#include <gtest/gtest.h>

namespace trocar {
namespace {

HandOutcomes group(std::vector<double> scores, int passes = 0) { return {std::move(scores), passes, 0}; }

std::map<std::string, HandOutcomes> sound() {
  return {{"expert", group({90, 92, 91}, 3)},   {"intermediate", group({80, 82, 81}, 3)},
          {"novice", group({55, 57, 59})},      {"clumsy", group({20, 25, 30})},
          {"speed-runner", group({0, 10, 20})}, {"heavy-handed", group({59, 49, 59})},
          {"idle", group({0, 0, 0})}};
}

std::vector<std::string> failures(const std::map<std::string, HandOutcomes>& outcomes, bool first_level = false) {
  std::vector<std::string> names;
  for (const ValidityCheck& check : check_validity(outcomes, first_level)) {
    if (!check.met) names.push_back(check.name);
  }
  return names;
}

TEST(ConstructValidity, SummaryOfAHandComputedGroup) {
  const GroupSummary s = summarise({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.count, 8);
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_NEAR(s.sd, 2.1380899, 1e-6);  // sqrt(32 / 7)
  EXPECT_EQ(s.lowest, 2);
  EXPECT_EQ(s.highest, 9);
}

TEST(ConstructValidity, SummaryOfOneAndOfNone) {
  EXPECT_EQ(summarise({3}).sd, 0);
  EXPECT_EQ(summarise({}).count, 0);
  EXPECT_EQ(summarise({}).mean, 0);
}

TEST(ConstructValidity, CliffsDeltaCountsPairs) {
  EXPECT_EQ(cliffs_delta({3, 4}, {1, 2}), 1);
  EXPECT_EQ(cliffs_delta({1, 2}, {3, 4}), -1);
  EXPECT_EQ(cliffs_delta({1, 2}, {1, 2}), 0);
  EXPECT_DOUBLE_EQ(cliffs_delta({1, 3}, {2}), 0);
  EXPECT_DOUBLE_EQ(cliffs_delta({2, 3}, {2, 1}), 0.75);  // 3 wins and one tie of 4 pairs
  EXPECT_EQ(cliffs_delta({}, {1}), 0);
}

TEST(ConstructValidity, ASoundScoreMeetsEveryCheck) { EXPECT_TRUE(failures(sound()).empty()); }

TEST(ConstructValidity, SwappedLabelsAreFound) {
  auto outcomes = sound();
  std::swap(outcomes["expert"], outcomes["novice"]);
  EXPECT_FALSE(failures(outcomes).empty());
}

TEST(ConstructValidity, ACeilingIsFound) {
  auto outcomes = sound();
  outcomes["expert"] = group({100, 100, 100}, 3);
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"expert at full marks"});
}

TEST(ConstructValidity, AHeavyHandThatPassesOnceIsFound) {
  auto outcomes = sound();
  outcomes["heavy-handed"].passes = 1;
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"heavy-handed passes"});
}

TEST(ConstructValidity, ASpeedRunnerThatGainsIsFound) {
  auto outcomes = sound();
  outcomes["speed-runner"] = group({80, 70, 90}, 2);
  EXPECT_EQ(failures(outcomes), (std::vector<std::string>{"speed-runner mean", "speed-runner passes"}));
}

TEST(ConstructValidity, MarksForIdlenessAreFound) {
  auto outcomes = sound();
  outcomes["idle"] = group({0, 0, 0.5});
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"idle highest"});
}

TEST(ConstructValidity, TheNovicePassesOnTheFirstLevelOnly) {
  auto outcomes = sound();
  outcomes["novice"].passes = 1;
  EXPECT_TRUE(failures(outcomes, true).empty());
  EXPECT_EQ(failures(outcomes, false), std::vector<std::string>{"novice passes"});
}

TEST(ConstructValidity, AnAttemptWithoutANumberIsFound) {
  auto outcomes = sound();
  outcomes["expert"].without_score = 1;
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"attempts without a score"});
}

TEST(ConstructValidity, HandsThatDidNotRunAreNotAskedAbout) {
  EXPECT_EQ(check_validity({{"idle", group({0})}}, false).size(), 2u);
}

}  // namespace
}  // namespace trocar
