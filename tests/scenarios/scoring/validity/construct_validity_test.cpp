// The statistics that say whether a score tells skill apart, against hand-computed groups, and scorers known to be bad.
#include "scenarios/scoring/validity/construct_validity.h"

#include <gtest/gtest.h>

namespace trocar::construct_validity_test {
namespace {

HandOutcomes group(std::vector<double> scores, int passes = 0) { return {std::move(scores), passes, 0, 0}; }

std::map<std::string, HandOutcomes> sound() {
  return {{"expert", group({90, 92, 91}, 3)},
          {"intermediate", group({80, 82, 81}, 3)},
          {"novice", group({55, 57, 59})},
          {"clumsy", group({20, 25, 30})},
          {"speed-runner", group({0, 10, 20})},
          {"heavy-handed", group({59, 49, 59})},
          {"idle", group({0, 0, 0})}};
}

std::vector<std::string> failures(const std::map<std::string, HandOutcomes>& outcomes,
                                  const ValidityScope& scope = {}) {
  std::vector<std::string> names;
  for (const ValidityCheck& check : check_validity(outcomes, scope)) {
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
  EXPECT_TRUE(failures(outcomes, {true, true}).empty());
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"novice passes"});
}

TEST(ConstructValidity, AnAttemptWithoutANumberIsFound) {
  auto outcomes = sound();
  outcomes["expert"].without_score = 1;
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"attempts without a score"});
}

TEST(ConstructValidity, HandsThatDidNotRunAreNotAskedAbout) {
  EXPECT_EQ(check_validity({{"idle", group({0})}}).size(), 2u);
}

/// The check of that name; one without a name when it is missing.
ValidityCheck check_named(const std::vector<ValidityCheck>& checks, const std::string& name) {
  for (const ValidityCheck& check : checks) {
    if (check.name == name) return check;
  }
  return {};
}

TEST(ConstructValidity, AHeavyHandMayPassWhereForceIsNotJudged) {
  auto outcomes = sound();
  outcomes["heavy-handed"] = group({90, 91, 92}, 3);
  EXPECT_TRUE(failures(outcomes, {false, false}).empty());
  const auto checks = check_validity(outcomes, {true, false});
  EXPECT_EQ(check_named(checks, "heavy-handed passes").not_asked, "the exercise judges no force");
  EXPECT_EQ(check_named(checks, "novice passes").not_asked, "not asked at the first level");
  EXPECT_EQ(check_named(checks, "clumsy passes").not_asked, "");
}

TEST(ConstructValidity, TheRubricSaysWhetherForceIsJudged) {
  const auto with = [](const std::string& metric) {
    Rubric rubric;
    rubric.subscores = {{"time", "time_s", 0.5, 0, 1}, {"it", metric, 0.5, 0, 1}};
    return judges_force(rubric);
  };
  for (const char* metric : {"force_max_n", "impulse_ns", "grip_mean_n", "force_rate_max_n_per_s", "in_band_share",
                             "excess_events", "grip_window_share", "crushed"}) {
    EXPECT_TRUE(with(metric)) << metric;
  }
  for (const char* metric : {"path_ratio", "normalised_jerk", "position_error_m", "objects_done_share", "drops", "?"}) {
    EXPECT_FALSE(with(metric)) << metric;
  }
}

TEST(ConstructValidity, ASpeedRunnerStoppedByTheDeviceEarnsNothingAndIsNoFailure) {
  auto outcomes = sound();
  HandOutcomes& fast = outcomes["speed-runner"];
  fast = {{70}, 0, 1, 1};
  EXPECT_TRUE(failures(outcomes).empty()) << "a mean of 35";
  EXPECT_DOUBLE_EQ(check_named(check_validity(outcomes), "speed-runner mean").value, 35);
  EXPECT_DOUBLE_EQ(pass_share(fast), 0);
  fast = {{}, 0, 3, 3};
  EXPECT_TRUE(failures(outcomes).empty());
  fast.without_score = 4;
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"attempts without a score"}) << "one ended otherwise";
  fast = {{90}, 1, 1, 1};
  EXPECT_EQ(failures(outcomes), (std::vector<std::string>{"speed-runner mean", "speed-runner passes"}));
  outcomes = sound();
  outcomes["novice"].without_score = outcomes["novice"].too_fast = 1;
  EXPECT_EQ(failures(outcomes), std::vector<std::string>{"attempts without a score"}) << "of no other hand";
}

}  // namespace
}  // namespace trocar::construct_validity_test
