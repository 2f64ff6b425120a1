// Construct validity of every exercise and level in the kinematic closed loop: better hands score better, dangerous
// ones never pass, waiting and repeating earn nothing.
#include <algorithm>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"
#include "tests/scenarios/support/practice_world.h"

namespace trocar::practice_levels_test {
namespace {

constexpr int kRuns = 6;  // differences of 5 and 15 points stand out of a spread of 2 to 4

struct Cell {
  const char* exercise;
  const char* level;
};

std::ostream& operator<<(std::ostream& out, const Cell& cell) { return out << cell.exercise << ' ' << cell.level; }

const PracticeRoom& room(const std::string& exercise) {
  static std::map<std::string, std::unique_ptr<PracticeRoom>> rooms;
  auto& made = rooms[exercise];
  if (!made) made = std::make_unique<PracticeRoom>(exercise);
  return *made;
}

PracticeAttempt attempt(const Cell& cell, const std::string& hand, int run) {
  WorldTuning tuning;
  tuning.level = cell.level;
  return practise(room(cell.exercise), hand, run, static_cast<std::uint64_t>(run) + 1, tuning);
}

struct Cohort {
  double mean = 0;
  int passes = 0;
};

Cohort cohort(const Cell& cell, const std::string& hand) {
  Cohort out;
  for (int run = 0; run < kRuns; ++run) {
    const Grade grade = attempt(cell, hand, run).grade;
    out.mean += grade.score.value_or(0) / kRuns;
    out.passes += grade.passed;
  }
  return out;
}

class PracticeLevels : public testing::TestWithParam<Cell> {};

TEST_P(PracticeLevels, OrderTheHandsBySkill) {
  const Cohort expert = cohort(GetParam(), "expert"), intermediate = cohort(GetParam(), "intermediate"),
               novice = cohort(GetParam(), "novice");
  EXPECT_GE(expert.mean, 85);
  EXPECT_LT(expert.mean, 99) << "headroom";
  EXPECT_EQ(expert.passes, kRuns);
  EXPECT_GE(expert.mean - intermediate.mean, 5);
  EXPECT_GE(intermediate.mean - novice.mean, 9) << "15 over many boards on the whole chain (docs/scoring.md)";
  EXPECT_LE(novice.passes, 1);
}

TEST_P(PracticeLevels, KeepOutHasteAndClumsiness) {
  const Cohort clumsy = cohort(GetParam(), "clumsy"), runner = cohort(GetParam(), "speed-runner");
  EXPECT_EQ(clumsy.passes, 0);
  EXPECT_LE(clumsy.mean, 50);
  EXPECT_EQ(runner.passes, 0);
  EXPECT_LE(runner.mean, 40);
}

TEST_P(PracticeLevels, KeepOutAHeavyHandWhereForceIsAskedFor) {
  if (!kind_of(room(GetParam().exercise).exercise).on_organ) return;
  EXPECT_EQ(cohort(GetParam(), "heavy-handed").passes, 0);
}

TEST_P(PracticeLevels, GiveNothingForIdling) { EXPECT_EQ(*attempt(GetParam(), "idle", 0).grade.score, 0); }

TEST_P(PracticeLevels, CapAnAttemptWithOneCriticalEvent) {
  PracticeAttempt a = attempt(GetParam(), "expert", 1);
  const Rubric& rubric = find_level(room(GetParam().exercise).exercise, GetParam().level).rubric;
  Event critical = a.events[a.events.size() / 2];
  critical.type = "CRITICAL_FORCE";
  critical.severity = Severity::kCritical;
  a.events.insert(a.events.begin() + static_cast<std::ptrdiff_t>(a.events.size() / 2) + 1, critical);
  const Grade grade = score_attempt(a.trace, a.events, rubric, a.context);
  EXPECT_LE(*grade.score, 49);
  EXPECT_FALSE(grade.passed);
}

TEST_P(PracticeLevels, AnyErrorMoreNeverRaisesTheScore) {
  const PracticeAttempt a = attempt(GetParam(), "intermediate", 2);
  const Rubric& rubric = find_level(room(GetParam().exercise).exercise, GetParam().level).rubric;
  for (const char* type : {"WRONG_PLACE", "EXCESS_FORCE", "GRIP_EXCESS", "TOOL_COLLISION", "TARGET_TIMEOUT",
                           "DEVICE_LIMIT", "TARGET_TOUCHED", "TARGET_HELD", "HORIZON_LOST", "WALL_CONTACT"}) {
    double before = *a.grade.score;
    std::vector<Event> events = a.events;
    for (int i = 0; i < 4; ++i) {
      Event again = events[events.size() / 2];
      again.type = type;
      again.object = 0;
      events.insert(events.begin() + static_cast<std::ptrdiff_t>(events.size() / 2) + 1, again);
      const double now = *score_attempt(a.trace, events, rubric, a.context).score;
      EXPECT_LE(now, before + 1e-9) << type << " for the " << i + 1 << ". time";
      before = now;
    }
  }
}

TEST_P(PracticeLevels, EverySubscoreFallsAsItsMetricGetsWorse) {
  for (const SubscoreRule& rule : find_level(room(GetParam().exercise).exercise, GetParam().level).rubric.subscores) {
    EXPECT_EQ(find_metric(rule.metric)->better, rule.full_at < rule.zero_at ? Direction::kLess : Direction::kMore)
        << rule.metric << ": a rubric grades it the way that its definition says";
    double before = 2;
    for (double share = -0.5; share <= 1.5; share += 0.05) {
      const double value = subscore_value(rule, rule.full_at + share * (rule.zero_at - rule.full_at));
      EXPECT_LE(value, before) << rule.name;
      before = value;
    }
    EXPECT_EQ(before, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PracticeLevels,
                         testing::Values(Cell{"reach-and-orient", "L1"}, Cell{"reach-and-orient", "L2"},
                                         Cell{"reach-and-orient", "L3"}, Cell{"surface-touch", "L2"},
                                         Cell{"surface-touch", "L3"}, Cell{"camera-navigation", "L3"}));

TEST(Exam, IsTheThirdLevelWithoutFeedback) {
  for (const char* id : {"reach-and-orient", "surface-touch", "camera-navigation"}) {
    const Exercise& exercise = room(id).exercise;
    const ExerciseLevel &third = find_level(exercise, "L3"), &exam = find_level(exercise, "exam");
    EXPECT_EQ(exam.force_display, "after");
    EXPECT_EQ(exam.mapping, third.mapping);
    EXPECT_EQ(exam.bands, third.bands);
    EXPECT_DOUBLE_EQ(exam.position_tolerance_m, third.position_tolerance_m);
    EXPECT_EQ(exam.rubric.subscores.size(), third.rubric.subscores.size());
  }
}

TEST(ThreeForces, AreDealtOutEvenlyAndJudgedEachByItsOwnBand) {
  const PracticeAttempt a = attempt({"surface-touch", "L3"}, "expert", 0);
  ASSERT_EQ(a.context.object_bands.size(), 12u);
  std::map<double, int> dealt;
  for (const ObjectBand& band : a.context.object_bands) ++dealt[band.low_n];
  ASSERT_EQ(dealt.size(), 3u);
  for (const auto& [low, count] : dealt) EXPECT_EQ(count, 4) << low;
  ScoringContext wrong = a.context;  // known bad: one band for all
  wrong.object_bands.clear();
  wrong.band_low_n = 0.45;
  wrong.band_high_n = 0.75;
  const Rubric& rubric = find_level(room("surface-touch").exercise, "L3").rubric;
  const Grade bad = score_attempt(a.trace, a.events, rubric, wrong);
  EXPECT_LT(*metric(bad, "in_band_share"), *metric(a.grade, "in_band_share") - 0.3);
}

}  // namespace
}  // namespace trocar::practice_levels_test
