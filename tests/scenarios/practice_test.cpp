// Construct validity in the kinematic closed loop: better hands score better, dangerous ones never pass.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "scenarios/hands/make_hand.h"
#include "tests/scenarios/support/practice_world.h"

namespace trocar::practice_test {
namespace {

constexpr int kRuns = 20;

const PracticeRoom& room() {
  static const PracticeRoom the_room;
  return the_room;
}

struct Cohort {
  std::vector<Grade> grades;

  std::vector<double> scores() const {
    std::vector<double> values;
    for (const Grade& grade : grades) values.push_back(grade.score.value_or(-1));
    return values;
  }
  double mean() const {
    double sum = 0;
    for (const double value : scores()) sum += value;
    return sum / static_cast<double>(grades.size());
  }
  int passes() const {
    return static_cast<int>(std::count_if(grades.begin(), grades.end(), [](const Grade& g) { return g.passed; }));
  }
};

/// Twenty attempts of a hand, each with its own seed and board; run once for all tests.
const Cohort& cohort(const std::string& hand) {
  static std::map<std::string, Cohort> cohorts;
  Cohort& result = cohorts[hand];
  for (int i = static_cast<int>(result.grades.size()); i < kRuns; ++i)
    result.grades.push_back(practise(room(), hand, i, static_cast<std::uint64_t>(i) + 1).grade);
  return result;
}

/// Share of pairs in which a beats b, minus share in which b beats a.
double cliffs_delta(const Cohort& a, const Cohort& b) {
  double sum = 0;
  for (const double x : a.scores())
    for (const double y : b.scores()) sum += (x > y) - (x < y);
  return sum / static_cast<double>(a.grades.size() * b.grades.size());
}

TEST(Practice, ExpertsPassEveryTimeWithoutReachingTheCeiling) {
  const Cohort& experts = cohort("expert");
  EXPECT_GE(experts.mean(), 85);
  EXPECT_EQ(experts.passes(), kRuns);
  for (const double score : experts.scores()) EXPECT_LT(score, 100);
}

TEST(Practice, SkillOrdersTheScores) {
  EXPECT_GE(cohort("expert").mean() - cohort("intermediate").mean(), 5);
  EXPECT_GE(cohort("intermediate").mean() - cohort("novice").mean(), 15);
  EXPECT_GE(cohort("novice").mean() - cohort("clumsy").mean(), 5);
  EXPECT_GE(cliffs_delta(cohort("expert"), cohort("intermediate")), 0.6);
  EXPECT_GE(cliffs_delta(cohort("intermediate"), cohort("novice")), 0.8);
}

TEST(Practice, NovicesSeldomPassAndTheClumsyNever) {
  EXPECT_LE(cohort("novice").passes(), kRuns / 10);
  EXPECT_EQ(cohort("clumsy").passes(), 0);
  EXPECT_LE(cohort("clumsy").mean(), 50);
}

TEST(Practice, NeitherHasteNorAHeavyHandPasses) {
  EXPECT_EQ(cohort("speed-runner").passes(), 0);
  EXPECT_LE(cohort("speed-runner").mean(), 40);
  EXPECT_EQ(cohort("heavy-handed").passes(), 0);
  for (const Grade& grade : cohort("heavy-handed").grades) EXPECT_LE(*grade.score, 59);
}

TEST(Practice, ForgivingForceWouldLiftAHeavyHandOverTheCap) {
  Rubric uncapped = room().exercise.rubric;
  uncapped.gate_cap = uncapped.critical_cap = uncapped.unfinished_cap = 100;
  const PracticeAttempt attempt = practise(room(), "heavy-handed", 0, 1);
  ASSERT_FALSE(attempt.grade.caps.empty());
  Rubric lenient = uncapped;
  for (SubscoreRule& rule : lenient.subscores) rule.weight = rule.gate ? 0 : rule.weight / 0.45;
  const Grade grade = score_attempt(attempt.trace, attempt.events, lenient, attempt.context);
  EXPECT_GT(*grade.score, room().exercise.rubric.gate_cap) << "without gates speed and place would buy back the damage";
}

TEST(Practice, IdlingEarnsNothing) {
  const PracticeAttempt attempt = practise(room(), "idle", 0, 1);
  EXPECT_EQ(attempt.grade.status, AttemptStatus::kTimeout);
  ASSERT_TRUE(attempt.grade.score);
  EXPECT_EQ(*attempt.grade.score, 0);
  EXPECT_FALSE(metric(attempt.grade, "time_s"));
}

TEST(Practice, AnExpertNeedsThreeQuartersOfAMinuteAndStaysGentle) {
  double time = 0;
  for (const Grade& grade : cohort("expert").grades) {
    time += *metric(grade, "time_s") / kRuns;
    EXPECT_LT(*metric(grade, "force_max_n"), room().exercise.hard_force_n);
    EXPECT_GT(*metric(grade, "object_in_band_share"), 0.9) << "pressing and holding is enough for nearly full marks";
    EXPECT_EQ(*metric(grade, "wrong_places"), 0);
  }
  // full_at of the time ramp is 0.7 of the expert's time: the calibration in the file must be this world's.
  EXPECT_NEAR(room().exercise.rubric.subscores[0].full_at / 0.7, time, 0.03 * time);
}

TEST(Practice, AnchoringFullMarksAtTheExpertsMeanWouldLeaveNoHeadroom) {
  Rubric known_bad = room().exercise.rubric;
  known_bad.subscores[0].full_at /= 0.7;
  int at_ceiling = 0;
  for (const Grade& grade : cohort("expert").grades)
    at_ceiling += subscore_value(known_bad.subscores[0], metric(grade, "time_s")) > 0.99;
  EXPECT_GT(at_ceiling, kRuns / 4);
  for (const Grade& grade : cohort("expert").grades) EXPECT_LT(grade.subscores[0].value, 0.95);
}

TEST(Practice, SameSeedSameEventsSameScore) {
  const PracticeAttempt one = practise(room(), "novice", 3, 42), two = practise(room(), "novice", 3, 42);
  ASSERT_EQ(one.events.size(), two.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].type, two.events[i].type);
    EXPECT_EQ(one.events[i].t_s, two.events[i].t_s);
    EXPECT_EQ(one.events[i].value, two.events[i].value);
  }
  EXPECT_EQ(*one.grade.score, *two.grade.score);
  const PracticeAttempt other = practise(room(), "novice", 3, 43);
  EXPECT_NE(*metric(one.grade, "path_m"), *metric(other.grade, "path_m"));
}

TEST(Practice, HoldsOverArmsFromSoftToFirm) {
  for (const double stiffness : {130.0, 200.0, 400.0}) {
    WorldTuning tuning;
    tuning.hand_stiffness_n_per_m = stiffness;
    const PracticeAttempt attempt = practise(room(), "expert", 1, 5, tuning);
    EXPECT_TRUE(attempt.grade.passed) << stiffness << " N/m: " << attempt.grade.score.value_or(-1);
    EXPECT_EQ(*metric(attempt.grade, "excess_events"), 0) << stiffness;
  }
}

TEST(Practice, OneCriticalEventCapsAPerfectRun) {
  PracticeAttempt attempt = practise(room(), "expert", 2, 7);
  Event event;
  event.type = "CRITICAL_FORCE";
  event.severity = Severity::kCritical;
  event.t_s = attempt.events.back().t_s;
  attempt.events.insert(attempt.events.end() - 1, event);
  const Grade grade = score_attempt(attempt.trace, attempt.events, room().exercise.rubric, attempt.context);
  EXPECT_LE(*grade.score, 49);
  EXPECT_FALSE(grade.passed);
}

/// Does as an expert until the first disc is held, then rests for good.
class GivesUp : public Hand {
 public:
  explicit GivesUp(std::unique_ptr<Hand> hand) : hand_(std::move(hand)) {}
  HandIntent update(const Percept& percept, double dt_s) override {
    if (percept.target_index < 1) last_ = hand_->update(percept, dt_s);
    return last_;
  }

 private:
  std::unique_ptr<Hand> hand_;
  HandIntent last_;
};

TEST(Practice, OneDiscAndStopEarnsAtMostItsShare) {
  GivesUp hand(make_hand("expert", 1, std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/hands"));
  const PracticeAttempt attempt = practise(room(), hand, 0, 1);
  EXPECT_EQ(attempt.grade.status, AttemptStatus::kTimeout);
  EXPECT_EQ(attempt.context.objects_done, 1);
  EXPECT_LE(*attempt.grade.score, 49.0 / 13 + 1e-12);
}

}  // namespace
}  // namespace trocar::practice_test
