// One thing to try next: chosen by rule, never by chance, and there is a sentence for every part of every exercise.
#include "app/window/attempt/advice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "app/window/attempt/debrief_reason.h"
#include "tests/app/window/attempt/attempt_samples.h"

namespace trocar::advice_test {
namespace {

using Kind = DebriefCause::Kind;
using testing_support::event;
using testing_support::graded;
using testing_support::put_caps;
using testing_support::shipped_exercise;

class AdviceTest : public ::testing::Test {
 protected:
  DebriefCause topic(const AttemptResult& result) const { return debrief_facts(words_, result, touch_).cause; }
  std::string said(const AttemptResult& result, const Exercise& exercise) const {
    return advice(words_, result, debrief_facts(words_, result, exercise), exercise);
  }
  const Translator words_;
  const Exercise touch_ = shipped_exercise("surface-touch");
};

TEST_F(AdviceTest, CriticalBeforeGateBeforeLargestLoss) {
  AttemptResult result = graded(touch_, "L1", {{"excess_events", 4}, {"time_s", 1000}, {"wrong_places", 6}});
  EXPECT_EQ(topic(result).kind, Kind::kGate);
  EXPECT_EQ(topic(result).metric, "excess_events") << "13 points, though time took 15 and places 20";
  result.events = {event(4, "CRITICAL_FORCE", Severity::kCritical, 5, "N")};
  EXPECT_EQ(topic(result).kind, Kind::kCritical);
  EXPECT_EQ(topic(graded(touch_, "L1", {{"time_s", 1000}, {"wrong_places", 6}})).metric, "wrong_places")
      << "20 against 15 points";
}

TEST_F(AdviceTest, EqualLossesGoToSafetyFirst) {
  // A third of 0.20 each: excess_events (safety) and wrong_places (accuracy).
  const DebriefCause t = topic(graded(touch_, "L1", {{"excess_events", 2}, {"wrong_places", 2}}));
  EXPECT_EQ(t.kind, Kind::kLoss);
  EXPECT_EQ(t.metric, "excess_events");
}

TEST_F(AdviceTest, TheTopicIsAlwaysTheLargestLossWhenNothingFailed) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.5, 1);
  for (int i = 0; i < 200; ++i) {
    std::map<std::string, double> values;
    double worst = 0;
    for (const SubscoreRule& rule : touch_.levels[0].rubric.subscores) {
      const double s = share(random);
      values[rule.metric] = std::lerp(rule.zero_at, rule.full_at, s);
      worst = std::max(worst, 100 * rule.weight * (1 - s));
    }
    const AttemptResult result = graded(touch_, "L1", values);
    const DebriefFacts facts = debrief_facts(words_, result, touch_);
    const DebriefCause& t = facts.cause;
    const auto row = std::find_if(facts.rows.begin(), facts.rows.end(),
                                  [&](const DebriefRow& r) { return r.subscore == t.subscore; });
    ASSERT_NE(row, facts.rows.end());
    EXPECT_NEAR(row->lost, worst, 1e-6);
  }
}

TEST_F(AdviceTest, NothingLostLeadsOnward) {
  EXPECT_EQ(topic(graded(touch_, "L1")).kind, Kind::kOnward);
  EXPECT_EQ(topic(graded(touch_, "L1", {{"path_ratio", 1.05}})).kind, Kind::kOnward) << "less than half a point";
}

TEST_F(AdviceTest, EveryPartOfEveryLevelHasASentenceOfItsOwn) {
  for (const char* id : {"surface-touch", "limited-grasp", "reach-and-orient", "ring-on-wire", "clip-and-cut",
                         "needle-driving", "bleeders-and-hook", "palpation", "gauze-cut"}) {
    const Exercise exercise = shipped_exercise(id);
    for (const ExerciseLevel& level : exercise.levels) {
      std::set<std::string> sentences;
      for (const SubscoreRule& rule : level.rubric.subscores) {
        const std::string text = said(graded(exercise, level.name, {{rule.metric, rule.zero_at}}), exercise);
        EXPECT_NE(text.find("Try next: "), std::string::npos) << text;
        EXPECT_EQ(text.find(", now "), std::string::npos) << "only the stand-in says it so: " << text;
        EXPECT_LE(text.size(), 150u) << text;
        sentences.insert(text);
      }
      EXPECT_EQ(sentences.size(), level.rubric.subscores.size()) << id << " " << level.name;
    }
  }
}

}  // namespace
}  // namespace trocar::advice_test
