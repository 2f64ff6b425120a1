// Other rubrics over known attempts, scorers that must be noticed, and what a population shows.
#include "scenarios/scoring/validity/cell_validity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenarios/scoring/score.h"

namespace trocar::cell_validity_test {
namespace {

/// Time counts most; without the gate of force a heavy hand would pass.
Rubric time_and_force() {
  Rubric rubric;
  rubric.subscores = {{"time", "time_s", 0.8, 10, 60, false, 0.5},
                      {"force in band", "in_band_share", 0.2, 0.9, 0.1, true, 0.5}};
  return rubric;
}

ScoredAttempt attempt_of(const std::string& hand, double time_s, double in_band, std::int64_t seed) {
  ScoredAttempt attempt;
  attempt.hand = hand;
  attempt.seed = attempt.board = seed;
  attempt.grade = grade_metrics({{"time_s", time_s, "s"}, {"in_band_share", in_band, ""}, {"critical_events", 0, ""}},
                                time_and_force(), {});
  return attempt;
}

std::vector<ScoredAttempt> sound_attempts() {
  std::vector<ScoredAttempt> attempts;
  for (int i = 0; i < 6; ++i) {
    const double wave = 0.1 * i;
    attempts.push_back(attempt_of("expert", 12 + 5 * wave, 0.85 - 0.1 * wave, i));
    attempts.push_back(attempt_of("intermediate", 19 + 6 * wave, 0.75 - 0.1 * wave, i));
    attempts.push_back(attempt_of("novice", 33 + 12 * wave, 0.60 - 0.1 * wave, i));
    attempts.push_back(attempt_of("heavy-handed", 12 + 5 * wave, 0.20, i));
  }
  return attempts;
}

ScoredAttempt person(int number, double skill, double score, std::int64_t board, std::int64_t seed) {
  ScoredAttempt attempt;
  attempt.hand = "population#" + std::to_string(number);
  attempt.skill = skill;
  attempt.board = board;
  attempt.seed = seed;
  attempt.grade.score = score;
  return attempt;
}

const ValidityCheck* check_of(const CellValidity& cell, const std::string& name) {
  const auto found =
      std::find_if(cell.checks.begin(), cell.checks.end(), [&](const ValidityCheck& c) { return c.name == name; });
  return found == cell.checks.end() ? nullptr : &*found;
}

TEST(CellValidity, AnotherRubricNeedsNoOtherRun) {
  Grade grade = grade_metrics({{"time_s", 35, "s"}, {"in_band_share", 0.5, ""}}, time_and_force(), {});
  EXPECT_DOUBLE_EQ(*grade.score, 100 * (0.8 * 0.5 + 0.2 * 0.5));
  EXPECT_DOUBLE_EQ(*regrade(grade, time_and_force()).score, *grade.score);
  Rubric strict = time_and_force();
  strict.subscores[1].gate_below = 0.6;
  strict.gate_cap = 40;
  EXPECT_DOUBLE_EQ(*regrade(grade, strict).score, 40);
  grade = grade_metrics(grade.metrics, time_and_force(), {AttemptStatus::kTimeout, 3, 12});
  EXPECT_DOUBLE_EQ(*regrade(grade, time_and_force()).score, 49 * 0.25) << "the caps ask how it ended";
  EXPECT_FALSE(regrade(void_grade("no samples"), time_and_force()).score);
}

TEST(CellValidity, ASoundRubricMeetsItsChecksAndEveryBadScorerIsNoticed) {
  const CellValidity cell = cell_validity(sound_attempts(), time_and_force(), {});
  for (const ValidityCheck& check : cell.checks) EXPECT_TRUE(check.met) << check.name << " " << check.value;
  ASSERT_EQ(cell.bad_scorers.size(), 3u);
  const auto noticed_by = [&](std::size_t which, const std::string& check) {
    const std::vector<std::string>& lost = cell.bad_scorers[which].lost;
    return std::find(lost.begin(), lost.end(), check) != lost.end();
  };
  EXPECT_TRUE(noticed_by(0, "expert - intermediate"));
  EXPECT_TRUE(noticed_by(1, "heavy-handed passes"));
  EXPECT_TRUE(noticed_by(2, "expert at the best time"));
  EXPECT_FALSE(cell.population);
}

TEST(CellValidity, CapsAreMissedEvenWhereNoHandMeetsOne) {
  std::vector<ScoredAttempt> attempts = sound_attempts();
  std::erase_if(attempts, [](const ScoredAttempt& a) { return a.hand == "heavy-handed"; });
  const std::vector<std::string> lost = try_bad_scorers(attempts, time_and_force(), {})[1].lost;
  EXPECT_EQ(lost,
            (std::vector<std::string>{"expert with a critical event, highest", "expert with half undone, highest"}));
}

TEST(CellValidity, ABadScorerThatNobodyNoticesFails) {
  // Experts whose time no anchor can spoil: it lies beyond full marks already.
  Rubric rubric = time_and_force();
  std::vector<ScoredAttempt> attempts = sound_attempts();
  for (SubscoreRule& rule : rubric.subscores) std::swap(rule.full_at, rule.zero_at);
  for (ScoredAttempt& attempt : attempts) attempt.grade = regrade(attempt.grade, rubric);
  const CellValidity cell = cell_validity(attempts, rubric, {});
  const ValidityCheck* check = check_of(cell, "checks that notice: labels of expert and novice swapped");
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->met) << "a rubric turned round has nothing to lose by swapped labels";
}

TEST(CellValidity, AWeightThatDecidesShows) {
  const std::vector<WeightTrial> trials = try_weights(sound_attempts(), time_and_force(), {});
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].subscore, "time");
  EXPECT_DOUBLE_EQ(trials[0].alone_delta, 1);
  EXPECT_DOUBLE_EQ(trials[1].without_delta, 1) << "time alone tells experts and novices apart";
  Rubric useless = time_and_force();
  useless.subscores.push_back({"noise", "speed_peaks", 0.0, 0, 1, false, 0.5});
  std::vector<ScoredAttempt> attempts = sound_attempts();
  for (ScoredAttempt& attempt : attempts) attempt.grade = regrade(attempt.grade, useless);
  const WeightTrial noise = try_weights(attempts, useless, {})[2];
  EXPECT_EQ(noise.alone_delta, 0);
  EXPECT_EQ(noise.less_changes + noise.more_changes, 0);
  EXPECT_TRUE(noise.lost.empty());
}

TEST(CellValidity, ThreeHandsAreToldApart) {
  const CellValidity cell = cell_validity(sound_attempts(), time_and_force(), {});
  ASSERT_TRUE(cell.by_subscores);
  EXPECT_EQ(cell.by_subscores->all, 18);
  EXPECT_EQ(cell.by_score->right, 18);
  std::vector<ScoredAttempt> few = sound_attempts();
  few.resize(8);
  EXPECT_FALSE(cell_validity(few, time_and_force(), {}).by_subscores);
}

TEST(PopulationValidity, ACrossedDesignHasBoardsAndAttempts) {
  std::vector<ScoredAttempt> attempts;
  for (int p = 0; p < 5; ++p) {
    for (int b = 0; b < 3; ++b) {
      for (int s = 1; s <= 2; ++s) attempts.push_back(person(p + 1, 0.2 * p, 50 + 10 * p + b, b, s));
    }
  }
  const std::optional<PopulationValidity> found = population_validity(attempts);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->persons, 5);
  EXPECT_EQ(found->attempts, 30);
  EXPECT_EQ(found->retests, 2) << "board 0 with seed 1, board 1 with seed 2";
  EXPECT_EQ(found->design, (std::array<std::size_t, 3>{5, 3, 2}));
  EXPECT_NEAR(found->components->variance(kPersonFacet), 250, 1e-9);
  EXPECT_NEAR(found->components->variance(kBoardFacet), 1, 1e-9);
  EXPECT_NEAR(found->components->standard_error(), 1, 1e-9);
  EXPECT_NEAR(*found->icc, 250 / 250.5, 1e-9);
  EXPECT_NEAR(found->person_mean, 1, 1e-12);
  EXPECT_GT(found->one_attempt, 0.99);
}

TEST(PopulationValidity, BoardsThatSeedsDrawAreOneFacetWithThem) {
  std::vector<ScoredAttempt> attempts;
  for (int p = 0; p < 4; ++p) {
    for (int s = 1; s <= 3; ++s) attempts.push_back(person(p + 1, 0.2 * p, 50 + 10 * p, 1000 + s, s));
  }
  const std::optional<PopulationValidity> found = population_validity(attempts);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->design, (std::array<std::size_t, 3>{4, 1, 3}));
  EXPECT_EQ(found->retests, 3);
  EXPECT_NEAR(*found->icc, 1, 1e-12);
}

TEST(PopulationValidity, WhoLacksAttemptsIsLeftOutAndAFaultEarnsNothing) {
  std::vector<ScoredAttempt> attempts;
  for (int p = 0; p < 4; ++p) {
    for (int s = 1; s <= 2; ++s) attempts.push_back(person(p + 1, 0.2 * p, 50 + 10 * p, s, s));
  }
  attempts.pop_back();
  attempts[0].grade.score.reset();
  const std::optional<PopulationValidity> found = population_validity(attempts);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->incomplete, 1);
  EXPECT_EQ(found->without_number, 1);
  EXPECT_EQ(found->design[0], 3u);
  attempts.resize(4);
  EXPECT_FALSE(population_validity(attempts)) << "two persons are no population";
}

TEST(PopulationValidity, TheBarsAreAsked) {
  std::vector<ScoredAttempt> attempts;
  for (int p = 0; p < 6; ++p) {
    for (int s = 1; s <= 2; ++s) attempts.push_back(person(p + 1, 0.15 * p, p % 2 ? 80 : 40, s, s));
  }
  const CellValidity cell = cell_validity(attempts, time_and_force(), {});
  EXPECT_FALSE(check_of(cell, "correlation of skill and score")->met);
  EXPECT_TRUE(check_of(cell, "test-retest ICC(2,1)")->met) << "each person earns the same again";
  EXPECT_EQ(cell.checks.size(), 2u) << "nothing is asked of hands that did not run";
}

}  // namespace
}  // namespace trocar::cell_validity_test
