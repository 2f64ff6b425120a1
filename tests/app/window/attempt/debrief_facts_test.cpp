// What the debrief says: the one reason, points that add up, caps and gates, missing values, units. By a grader of the
// test's own.
#include "app/window/attempt/debrief_facts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "app/window/attempt/cut_off.h"
#include "app/window/attempt/debrief_reason.h"
#include "tests/app/window/attempt/attempt_samples.h"

namespace trocar::debrief_facts_test {
namespace {

using testing_support::event;
using testing_support::graded;
using testing_support::past_run;
using testing_support::put_caps;
using testing_support::shipped_exercise;

class DebriefFactsTest : public ::testing::Test {
 protected:
  static double all_lost(const DebriefFacts& facts) {
    return facts.lost_to_caps + std::accumulate(facts.rows.begin(), facts.rows.end(), 0.0,
                                                [](double sum, const DebriefRow& r) { return sum + r.lost; });
  }
  static const DebriefRow& row(const DebriefFacts& facts, const std::string& metric) {
    for (const DebriefRow& r : facts.rows)
      if (r.metric == metric) return r;
    throw std::runtime_error("no row of " + metric);
  }
  DebriefFacts facts(const AttemptResult& result, const DebriefPast& past = {}) const {
    return debrief_facts(words_, result, touch_, past);
  }

  const Translator words_;
  const Exercise touch_ = shipped_exercise("surface-touch"), grasp_ = shipped_exercise("limited-grasp"),
                 reach_ = shipped_exercise("reach-and-orient");
};

TEST_F(DebriefFactsTest, PointsLostAddUpToWhatIsMissing) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  for (const Exercise* exercise : {&touch_, &grasp_, &reach_}) {
    for (int i = 0; i < 300; ++i) {
      const ExerciseLevel& level = exercise->levels[static_cast<std::size_t>(i) % exercise->levels.size()];
      std::map<std::string, double> values;
      for (const SubscoreRule& rule : level.rubric.subscores)
        values[rule.metric] = std::lerp(rule.zero_at, rule.full_at, share(random));
      AttemptResult result = graded(*exercise, level.name, values);
      if (i % 5 == 0) result.events.push_back(event(9, "CRITICAL_FORCE", Severity::kCritical, 5, "N"));
      put_caps(result, *exercise, i % 7 == 0 ? 5 : -1);
      const DebriefFacts f = debrief_facts(words_, result, *exercise);
      EXPECT_NEAR(all_lost(f), 100 - *f.score, 1e-9) << exercise->id << " " << level.name;
      EXPECT_GE(f.lost_to_caps, 0);
      EXPECT_FALSE(f.reason.empty());
      for (const DebriefRow& r : f.rows) EXPECT_LE(r.lost, r.possible + 1e-9);
    }
  }
}

TEST_F(DebriefFactsTest, RowsGoFromSafetyToTime) {
  for (const Exercise* exercise : {&touch_, &grasp_, &reach_}) {
    const DebriefFacts f = debrief_facts(words_, graded(*exercise, "L1", {{"time_s", 500}}), *exercise);
    EXPECT_EQ(f.rows.size(), exercise->rubric.subscores.size());
    EXPECT_TRUE(std::is_sorted(f.rows.begin(), f.rows.end(),
                               [](const DebriefRow& a, const DebriefRow& b) { return a.group < b.group; }));
    EXPECT_EQ(f.rows.back().metric, "time_s") << "although it cost most";
  }
  EXPECT_EQ(row(facts(graded(touch_, "L1")), "object_in_band_share").group, ScoreGroup::kSafety);
  EXPECT_EQ(row(facts(graded(touch_, "L1")), "wrong_places").group, ScoreGroup::kAccuracy);
  EXPECT_EQ(row(facts(graded(touch_, "L1")), "path_ratio").group, ScoreGroup::kMotion);
}

TEST_F(DebriefFactsTest, APassSaysTheScoreAndWhereMostWent) {
  const DebriefFacts f = facts(graded(touch_, "L1", {{"object_in_band_share", 0.8}}));
  EXPECT_EQ(f.outcome, Outcome::kPass);
  EXPECT_EQ(f.verdict, "PASS");
  EXPECT_EQ(f.reason, "90.0 of 100 points, a pass needs 75. Most points were lost on: Force in band.");
  EXPECT_EQ(facts(graded(touch_, "L1")).reason, "100.0 of 100 points, a pass needs 75.");
}

TEST_F(DebriefFactsTest, TheFailedGateIsTheReasonWhateverTimeCost) {
  AttemptResult result = graded(touch_, "L1", {{"excess_events", 4}, {"time_s", 1000}});
  put_caps(result, touch_);
  const DebriefFacts f = facts(result);
  EXPECT_EQ(f.outcome, Outcome::kNotYet);
  EXPECT_EQ(f.reason, "Excess force: 4; a pass needs at most 3.");
  EXPECT_TRUE(row(f, "excess_events").failed);
  EXPECT_TRUE(f.more.empty());
}

TEST_F(DebriefFactsTest, WhatHelpedIsSaid) {
  AttemptResult result = graded(touch_, "L1");
  result.assists = "height plumb";
  ASSERT_EQ(facts(result).more.size(), 1u);
  EXPECT_EQ(facts(result).more[0], "Helped at this level: the tip kept its height, a line showed what lies below it.");
}

TEST_F(DebriefFactsTest, OfTwoFailedGatesTheCostlierComesFirstAndTheOtherIsNotHidden) {
  AttemptResult result = graded(touch_, "L1", {{"excess_events", 4}, {"object_in_band_share", 0.4}});
  put_caps(result, touch_);
  const DebriefFacts f = facts(result);
  EXPECT_EQ(f.reason, "Force in band: 40 %; a pass needs at least 65 %.");
  EXPECT_EQ(f.more, (std::vector<std::string>{"Excess force: 4; a pass needs at most 3."}));
}

TEST_F(DebriefFactsTest, ACriticalEventComesBeforeEveryGate) {
  AttemptResult result = graded(touch_, "L1", {{"excess_events", 6}});
  result.events = {event(2, "START"), event(14.25, "CRITICAL_FORCE", Severity::kCritical, 5.1, "N")};
  put_caps(result, touch_, 7, 12);
  const DebriefFacts f = facts(result);
  EXPECT_EQ(f.reason, "5.10 N at 12.2 s: above the critical limit of 4.7 N.");
  ASSERT_EQ(f.more.size(), 2u);
  EXPECT_EQ(f.more[0], "Excess force: 6; a pass needs at most 3.");
  EXPECT_EQ(f.more[1], "Not finished: 7 of 12 done.");
}

TEST_F(DebriefFactsTest, LostAndCrushedBlocksAreNamed) {
  AttemptResult result = graded(grasp_, "L1");
  result.events = {event(1, "START"), event(21, "LOST", Severity::kCritical, 0.02, "m")};
  put_caps(result, grasp_);
  EXPECT_EQ(debrief_facts(words_, result, grasp_).reason, "Lost at 20.0 s: it lies outside the field.");
  result.events[1].type = "CRUSH";
  EXPECT_EQ(debrief_facts(words_, result, grasp_).reason, "Too many blocks crushed, the last one at 20.0 s.");
  result.events[1].type = "SOMETHING_NEW";
  EXPECT_EQ(debrief_facts(words_, result, grasp_).reason, "A critical event at 20.0 s: SOMETHING_NEW.");
}

TEST_F(DebriefFactsTest, TimeOutSaysHowMuchWasDone) {
  AttemptResult result = graded(touch_, "L1", {{"time_s", 120}});
  result.grade.status = AttemptStatus::kTimeout;
  result.events = {event(2, "START")};
  put_caps(result, touch_, 7, 12);
  EXPECT_EQ(facts(result).reason, "Time ran out: 7 of 12 done.");
  EXPECT_GT(facts(result).lost_to_caps, 50);
}

TEST_F(DebriefFactsTest, WhatCapsTheScoreIsSaidInTheLanguage) {
  const Translator german(TROCAR_SOURCE_DIR "/assets/languages", "de");
  AttemptResult result = graded(touch_, "L1", {{"excess_events", 4}});
  put_caps(result, touch_, 7, 12);
  const DebriefFacts f = debrief_facts(german, result, touch_);
  EXPECT_EQ(f.reason, "Zu viel Kraft: 4; zum Bestehen: höchstens 3.");
  EXPECT_EQ(f.more, (std::vector<std::string>{"Nicht fertig: 7 von 12 geschafft."}));
}

TEST_F(DebriefFactsTest, BelowThePassLineTheLargestLossIsTheReason) {
  const AttemptResult result = graded(touch_, "L1", {{"wrong_places", 6}, {"object_in_band_share", 0.7}});
  const DebriefFacts f = facts(result);
  EXPECT_EQ(f.outcome, Outcome::kNotYet);
  EXPECT_EQ(f.reason, "65.0 of 100 points, a pass needs 75. Most points were lost on: Place.");
}

TEST_F(DebriefFactsTest, AMetricWithoutAValueEarnsNothingAndSaysSo) {
  const DebriefFacts f = facts(graded(touch_, "L1", {{"path_ratio", NAN}}));
  EXPECT_EQ(row(f, "path_ratio").value, "n/a");
  EXPECT_DOUBLE_EQ(row(f, "path_ratio").lost, 10);
  EXPECT_EQ(row(f, "path_ratio").against_median, 0);
}

TEST_F(DebriefFactsTest, EndsWithoutAGradeAreHonestPages) {
  AttemptResult result;
  result.exercise_id = touch_.id;
  result.level = "L1";
  const auto said = [&](AttemptStatus status) {
    result.grade.status = status;
    return facts(result);
  };
  EXPECT_EQ(said(AttemptStatus::kAborted).verdict, "STOPPED");
  EXPECT_EQ(said(AttemptStatus::kAborted).reason,
            "You left before the clock began, so there is no score. It counts as not passed.");
  result.events = {event(2, "START"), event(9, "TARGET_HELD")};
  EXPECT_EQ(said(AttemptStatus::kAborted).reason,
            "You left the attempt, so there is no score. It counts as not passed.");
  result.integrity = "tick 7 is missing";
  EXPECT_EQ(said(AttemptStatus::kVoid).verdict, "VOID");
  EXPECT_EQ(said(AttemptStatus::kVoid).more, (std::vector<std::string>{"tick 7 is missing"}));
  result.device.fault = "encoder-jump";
  result.device.fault_channel = 2;
  const DebriefFacts fault = said(AttemptStatus::kFault);
  EXPECT_EQ(fault.verdict, "DEVICE STOPPED");
  EXPECT_NE(fault.reason.find("passes in a row begin anew"), std::string::npos);
  ASSERT_EQ(fault.more.size(), 1u);
  EXPECT_NE(fault.more[0].find("encoder-jump on channel 2"), std::string::npos) << fault.more[0];
  for (const auto status : {AttemptStatus::kAborted, AttemptStatus::kVoid, AttemptStatus::kFault}) {
    EXPECT_TRUE(said(status).rows.empty());
    EXPECT_FALSE(said(status).score);
  }
}

TEST_F(DebriefFactsTest, ForceThatTheDeviceCouldNotGiveIsSaidEvenOnAPass) {
  AttemptResult result = graded(touch_, "L1");
  result.device.saturated_contact_share = 0.12;
  ASSERT_EQ(facts(result).more.size(), 1u);
  EXPECT_NE(facts(result).more[0].find("12 % of the contact time"), std::string::npos);
}

TEST_F(DebriefFactsTest, OwnBestAndMedianPointTheRightWay) {
  const AttemptResult result =
      graded(touch_, "L1", {{"time_s", 50}, {"object_in_band_share", 0.7}, {"wrong_places", 2}});
  DebriefPast past;
  for (int n = 0; n < 3; ++n)
    past.own.push_back(past_run(result, n, 70, false,
                                {{"time_s", 60.0 + n}, {"object_in_band_share", 0.8 + 0.05 * n}, {"wrong_places", 2}}));
  past.expert = {{"time_s", 37.1}};
  const DebriefFacts f = facts(result, past);
  EXPECT_EQ(row(f, "time_s").best, "60.0 s");
  EXPECT_EQ(row(f, "time_s").median, "61.0 s");
  EXPECT_EQ(row(f, "time_s").expert, "37.1 s");
  EXPECT_EQ(row(f, "time_s").against_median, 1) << "quicker is better";
  EXPECT_EQ(row(f, "object_in_band_share").best, "90 %");
  EXPECT_EQ(row(f, "object_in_band_share").against_median, -1);
  EXPECT_EQ(row(f, "wrong_places").against_median, 0) << "the same";
  EXPECT_EQ(row(f, "wrong_places").expert, "");
}

TEST_F(DebriefFactsTest, AnotherVersionOfTheExerciseStillAddsUp) {
  AttemptResult result = graded(touch_, "L1", {{"time_s", 90}});
  result.level = "L9";
  result.grade.subscores[1].name = "renamed";
  const DebriefFacts f = facts(result);
  EXPECT_NEAR(all_lost(f), 100 - *f.score, 1e-9);
  EXPECT_EQ(f.pass_at, 75);
  EXPECT_EQ(f.rows.back().name, "Time");
}

TEST_F(DebriefFactsTest, EveryPartOfEveryExerciseIsExplainedWithItsAnchorsAndWeight) {
  for (const Exercise* exercise : {&touch_, &grasp_, &reach_}) {
    const AttemptResult result = graded(*exercise, "L2", {{"time_s", 60}});
    for (const DebriefRow& r : debrief_facts(words_, result, *exercise).rows) {
      const auto sentences = explained(words_, r, result, *exercise);
      ASSERT_GE(sentences.size(), 4u) << r.name;
      EXPECT_TRUE(sentences[0].starts_with("Measured: ")) << sentences[0];
      for (const std::string& part : {r.full, r.none, words_.number(r.possible, 0)})
        EXPECT_NE(sentences[1].find(part), std::string::npos) << sentences[1];
      EXPECT_EQ(sentences.back(), "Its name in exports: " + r.metric + ".");
      const bool gate = std::any_of(sentences.begin(), sentences.end(),
                                    [](const std::string& s) { return s.starts_with("Safety gate: "); });
      EXPECT_EQ(gate, r.gate) << r.name;
    }
  }
}

TEST_F(DebriefFactsTest, EventsThatOnlyDirectTheTaskAreNotShown) {
  for (const char* type :
       {"START", "TARGET_LIT", "TARGET_TOUCHED", "GRIP_OFFERED", "DEVICE_LIMIT", "LIFTED", "SET_DOWN", "DONE"})
    EXPECT_EQ(event_words(words_, event(1, type)), "") << type;
  for (const char* type : {"EXCESS_FORCE", "WRONG_PLACE", "TARGET_HELD", "CRUSH", "DROP", "TIMEOUT", "DEVICE_FAULT"})
    EXPECT_NE(event_words(words_, event(1, type)), "") << type;
}

TEST(MetricText, ReadsInTheUnitsOfPeople) {
  const Translator w;
  const auto text = [&](const char* metric, double value, const char* unit) {
    return metric_text(w, metric, value, unit);
  };
  EXPECT_EQ(text("position_error_m", 0.00234, "m"), "2.3 mm");
  EXPECT_EQ(text("path_m", 1.234, "m"), "1234 mm");
  EXPECT_EQ(text("object_in_band_share", 0.654, "1"), "65 %");
  EXPECT_EQ(text("excess_events", 3, "1"), "3");
  EXPECT_EQ(text("excess_events", 2.5, "1"), "2.5") << "a median of counts";
  EXPECT_EQ(text("path_ratio", 1.3456, "1"), "1.35");
  EXPECT_EQ(text("angle_error_deg", 5.25, "deg"), "5.2\u00b0");
  EXPECT_EQ(text("time_s", 61.46, "s"), "61.5 s");
  EXPECT_EQ(text("force_max_n", 1.5, "N"), "1.50 N");
  EXPECT_EQ(text("speed_mean_mps", 0.0512, "m/s"), "51 mm/s");
  EXPECT_EQ(text("time_s", NAN, "s"), "n/a");
  EXPECT_EQ(metric_text(w, "time_s", {}, "s"), "n/a");
}

TEST(DebriefPauses, AreSaidWithTimeCountAndLength) {
  const Exercise touch = shipped_exercise("surface-touch");
  AttemptResult result = graded(touch, "L1");
  result.events = {event(3.0, "START")};
  const auto said = [&](const std::string& realtime) {
    result.device.realtime = realtime;
    const DebriefFacts f = debrief_facts(Translator(), result, touch);
    return f.more.empty() ? "" : f.more.back();
  };
  EXPECT_EQ(said(R"({"lanes":{}})"), "");
  EXPECT_EQ(said(R"({"pauses":[{"at_s":15.5,"seconds":12.2}]})"), "Paused once, at 12.5 s, for 12 s.");
  EXPECT_EQ(said(R"({"pauses":[{"at_s":1,"seconds":2},{"at_s":20,"seconds":3.5}]})"),
            "Paused 2 times, first at 0.0 s, 5.5 s in all.");
  EXPECT_EQ(said("not json"), "");
  EXPECT_EQ(said(R"({"pauses":[1,{"at_s":"x"}]})"), "");
}

TEST(DebriefPauses, ALoopWithoutRightsIsSaidOfAScoredAttempt) {
  const Exercise touch = shipped_exercise("surface-touch");
  AttemptResult result = graded(touch, "L1");
  result.device.backend = "simulated";
  result.device.realtime = R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  const auto marks = [&] {
    const std::vector<std::string> more = debrief_facts(Translator(), result, touch).more;
    return std::count_if(more.begin(), more.end(),
                         [](const std::string& line) { return line.starts_with("Soft real time: "); });
  };
  EXPECT_EQ(marks(), 1);
  result.device.backend = "pointer";
  EXPECT_EQ(marks(), 0) << "nothing was felt";
}

TEST(DebriefCutOff, SaysThatTheProgramEndedNotThatThePersonLeft) {
  const Exercise touch = shipped_exercise("surface-touch");
  AttemptResult result;
  result.level = "L1";
  result.grade.status = AttemptStatus::kAborted;
  result.cut_off = true;
  EXPECT_EQ(debrief_facts(Translator(), result, touch).reason,
            "The attempt was cut off with its program, so there is no score. It counts as not passed.");
}

TEST(CutOff, LocalTimeNamesTheDayOnlyWhenItIsAnotherOne) {
  ::setenv("TZ", "UTC", 1);
  ::tzset();
  EXPECT_EQ(local_time("2026-11-22T14:32:05Z", 1795350000), "14:32");
  EXPECT_EQ(local_time("2026-11-20T14:32:05.123Z", 1795350000), "2026-11-20 14:32");
  EXPECT_EQ(local_time("?", 0), "?");
}

}  // namespace
}  // namespace trocar::debrief_facts_test
