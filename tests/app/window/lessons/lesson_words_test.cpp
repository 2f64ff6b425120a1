#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <set>

#include "app/window/lessons/lesson_words.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "tests/app/window/pages/practice_bench.h"

namespace trocar::lesson_words_test {
namespace {

std::vector<Exercise> shipped() { return list_exercises(testing_support::source_assets().exercises); }

const Exercise& of(const std::vector<Exercise>& all, const std::string& id) {
  for (const Exercise& e : all)
    if (e.id == id) return e;
  throw std::runtime_error(id);
}

std::string limit(const std::vector<LessonLimit>& rows, const std::string& what) {
  for (const LessonLimit& row : rows)
    if (row.what == what) return row.value;
  return "none";
}

TEST(LessonWords, EveryLevelHasThreeToSixStepsALimitOfTimeAndMeasuresWhoseWeightsAreAll) {
  const Translator w;
  for (const Exercise& exercise : shipped()) {
    for (const ExerciseLevel& level : exercise.levels) {
      const std::string where = exercise.id + " " + level.name;
      const auto steps = lesson_steps(w, exercise, level);
      EXPECT_GE(steps.size(), 3u) << where;
      EXPECT_LE(steps.size(), 6u) << where;
      std::set<StepIcon> icons;
      for (const LessonStep& step : steps) {
        EXPECT_FALSE(step.text.empty()) << where;
        icons.insert(step.icon);
      }
      EXPECT_EQ(icons.size(), steps.size()) << where << ": no two steps look alike";
      EXPECT_NE(limit(lesson_limits(w, exercise, level), "Time"), "none") << where;
      double sum = 0;
      for (const LessonMeasure& m : lesson_measures(w, level)) {
        EXPECT_FALSE(m.meaning.empty()) << where << " " << m.name;
        EXPECT_TRUE(find_metric(m.metric)) << m.metric;
        sum += std::stod(m.weight);
      }
      EXPECT_NEAR(sum, 100, 1e-9) << where;
    }
  }
}

TEST(LessonWords, NumbersAreThoseOfTheExercise) {
  const Translator w;
  const auto all = shipped();
  const Exercise& touch = of(all, "surface-touch");
  const auto limits = lesson_limits(w, touch, find_level(touch, "L1"));
  EXPECT_EQ(limit(limits, "Time"), "2:00 min at most");
  EXPECT_EQ(limit(limits, "Wanted force"), "0.4 to 0.8 N");
  const auto third = lesson_limits(w, touch, find_level(touch, "L3"));
  EXPECT_EQ(
      std::count_if(third.begin(), third.end(), [](const LessonLimit& l) { return l.what.find("Wanted force") == 0; }),
      1)
      << "one row for all, that says whose they are";
  EXPECT_NE(limit(third, "Wanted force; the message of each disc names its own").find(" or "), std::string::npos);
  EXPECT_NE(lesson_tool(w, touch, find_level(touch, "L1")).find("Grasper"), std::string::npos)
      << "it squeezes a block at the end";
  EXPECT_EQ(limit(limits, "Too much force"), "above 1.5 N");
  EXPECT_EQ(limit(limits, "Critical force"), "above 4.7 N: no pass");
  EXPECT_EQ(limit(limits, "Discs"), "12");
  const Exercise& reach = of(all, "reach-and-orient");
  const auto steps = lesson_steps(w, reach, find_level(reach, "L3"));
  EXPECT_EQ(steps[1].text, "Bring the tip to the lit pen, to 1.5 mm or nearer.");
  EXPECT_EQ(steps[2].text, "Roll the instrument as the pen is rolled, to 4 degrees or nearer; the port leans it.");
  EXPECT_EQ(steps[3].text, "Hold still for 0.7 s; the next pen lights.");
}

TEST(LessonWords, GripOfEachFoamIsToldOnlyWhereColourTellsIt) {
  const Translator w;
  const auto all = shipped();
  const Exercise& grasp = of(all, "limited-grasp");
  const auto l1 = lesson_limits(w, grasp, find_level(grasp, "L1"));
  EXPECT_EQ(limit(l1, "Bands 1: wanted grip"), "0.6 to 1.2 N") << "slip 0.5 N and crush 1.5 N, each a fifth nearer";
  const ExerciseLevel& l3 = find_level(grasp, "L3");
  ASSERT_FALSE(l3.grasp.colour_cue);
  EXPECT_EQ(limit(lesson_limits(w, grasp, l3), "Bands 1: wanted grip"), "none");
}

TEST(LessonWords, GatesSayWhatTheyDo) {
  const Translator w;
  const auto all = shipped();
  const auto measures = lesson_measures(w, find_level(of(all, "surface-touch"), "L1"));
  int gates = 0;
  for (const LessonMeasure& m : measures) {
    if (m.gate.empty()) continue;
    ++gates;
    EXPECT_NE(m.gate.find("59"), std::string::npos) << m.gate;
  }
  EXPECT_EQ(gates, 2) << "force in band, excess force";
}

TEST(LessonWords, LengthsAreInMillimetres) {
  const Translator w;
  const auto all = shipped();
  for (const LessonMeasure& m : lesson_measures(w, find_level(of(all, "reach-and-orient"), "L1"))) {
    if (m.metric != "position_error_m") continue;
    EXPECT_NE(m.none.find("mm"), std::string::npos) << m.none;
    return;
  }
  FAIL() << "no measure of place";
}

TEST(LessonWords, EachDisplayModeSaysWhatItMeans) {
  const Translator w;
  std::set<std::string> said;
  for (const char* mode : {"always", "band", "after"}) {
    ExerciseLevel level;
    level.force_display = mode;
    for (const Exercise& exercise : shipped()) said.insert(lesson_display(w, exercise, level));
  }
  EXPECT_EQ(said.size(), 8u) << "what is watched is the force, how a pen is matched, or, always or not, the horizon";
}

TEST(LessonWords, PortTurnsTheSentenceAboutTheTip) {
  const Translator w;
  const auto all = shipped();
  const Exercise& reach = of(all, "reach-and-orient");
  EXPECT_NE(lesson_tool(w, reach, find_level(reach, "L3")).find("against the hand"), std::string::npos);
  EXPECT_NE(lesson_tool(w, reach, find_level(reach, "L1")).find("with the hand"), std::string::npos);
}

}  // namespace
}  // namespace trocar::lesson_words_test
