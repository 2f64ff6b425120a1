// Every way to fail, at the device and at the mouse: what the debrief gives as the reason and what it advises. By the
// graders of the samples and, where one metric hides another, by scores as scoring gives them.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "app/window/attempt/advice.h"
#include "app/window/attempt/debrief_reason.h"
#include "haptics/device/backends/make_backend.h"
#include "tests/app/window/attempt/attempt_samples.h"

namespace trocar::failures_test {
namespace {

using Kind = DebriefCause::Kind;
using testing_support::event;
using testing_support::graded;
using testing_support::put_caps;
using testing_support::shipped_exercise;

constexpr double kNone = NAN;

struct Times {
  const char* type;
  int count;
  Severity severity = Severity::kMinor;
};

/// An attempt and what is said of it. Events after START, one a second, each of another object.
struct Failure {
  const char* name;
  const char* exercise;
  const char* level;
  std::map<std::string, double> values;
  std::vector<Times> happened;
  int done = -1;  ///< objects done when time ran out; -1: all
  Kind cause;
  const char* reason;
  const char* by_device;
  const char* by_mouse = by_device;
};

std::ostream& operator<<(std::ostream& out, const Failure& failure) { return out << failure.name; }

constexpr const char *kTouch = "surface-touch", *kReach = "reach-and-orient", *kGrasp = "limited-grasp";
constexpr const char* kDownThere = "Try next: stop just over the lit disc, look, then go straight down.";
constexpr const char* kSlower = "Try next: close the jaws slowly and stop as soon as the block no longer slides.";

const std::vector<Failure>& failures() {
  static const std::vector<Failure> all{
      {"ThirteenBesideAtTheRightForce",
       kTouch,
       "L1",
       {{"object_in_band_share", kNone}, {"path_ratio", kNone}, {"wrong_places", 13}, {"time_s", 120}},
       {{"WRONG_PLACE", 13}},
       0,
       Kind::kBeside,
       "13 times beside the lit disc: what is pressed there does not count.",
       kDownThere},
      {"ThirteenBesideAndOneTouchLetGo",
       kTouch,
       "L1",
       {{"object_in_band_share", 0.08}, {"wrong_places", 13}, {"time_s", 120}},
       {{"TARGET_TOUCHED", 1, Severity::kInfo}, {"WRONG_PLACE", 13}},
       0,
       Kind::kBeside,
       "13 times beside the lit disc: what is pressed there does not count.",
       kDownThere},
      {"OneBesideIsNoExcuseForTheForce",
       kTouch,
       "L1",
       {{"object_in_band_share", 0.4}, {"wrong_places", 1}},
       {{"WRONG_PLACE", 1}},
       -1,
       Kind::kGate,
       "Force in band: 40 %; a pass needs at least 65 %.",
       "In the band for 40 % of the pressing time. "
       "Try next: press to 0.4 to 0.8 N in one go, then keep still until the disc is done.",
       "In the band for 40 % of the pressing time. "
       "Try next: press until the bar reads 0.4 to 0.8 N, then let go: the force stays."},
      {"ForceOfSeveralBands",
       kTouch,
       "L3",
       {{"object_in_band_share", 0.2}},
       {},
       -1,
       Kind::kGate,
       "Force in band: 20 %; a pass needs at least 40 %.",
       "In the band for 20 % of the pressing time. "
       "Try next: press into the band in one go and then keep still until the disc is done.",
       "In the band for 20 % of the pressing time. "
       "Try next: press a little, see how far the tissue gives way, then let it stay until the disc is done."},
      {"NothingTouched",
       kTouch,
       "L1",
       {{"object_in_band_share", kNone}, {"path_ratio", kNone}, {"time_s", 120}},
       {},
       0,
       Kind::kNotTried,
       "Time ran out: 0 of 13 done. No disc was touched, so force in band cannot be judged.",
       "Try next: stop over the lit disc, then go straight down until you feel it.",
       "Try next: stop over the lit disc, then press until the force bar shows contact."},
      {"NothingTouchedAndNoBar",
       kTouch,
       "L3",
       {{"object_in_band_share", kNone}, {"path_ratio", kNone}, {"time_s", 120}},
       {},
       0,
       Kind::kNotTried,
       "Time ran out: 0 of 13 done. No disc was touched, so force in band cannot be judged.",
       "Try next: stop over the lit disc, then go straight down until you feel it.",
       "Try next: stop over the lit disc, then press until the tissue gives way."},
      {"TooHardBesideTheDiscs",
       kTouch,
       "L1",
       {{"object_in_band_share", kNone}, {"path_ratio", kNone}, {"wrong_places", 7}, {"excess_events", 5}},
       {{"WRONG_PLACE", 7}, {"EXCESS_FORCE", 5, Severity::kMajor}},
       0,
       Kind::kGate,
       "Excess force: 5; a pass needs at most 3.",
       "5 times above 1.5 N. Try next: stop as soon as you feel contact, then press; never above 1.5 N.",
       "5 times above 1.5 N. Try next: stop as soon as the force bar shows contact, then press; never above 1.5 N."},
      {"SqueezedTooHard",
       kTouch,
       "L2",
       {{"excess_events", 4}},
       {{"GRIP_EXCESS", 4, Severity::kMajor}},
       -1,
       Kind::kGate,
       "Excess force: 4; a pass needs at most 3.",
       "4 times squeezed above 2.5 N. Try next: close the jaws slowly and stop at 0.73 to 1.2 N."},
      {"CriticalForce",
       kTouch,
       "exam",
       {},
       {{"CRITICAL_FORCE", 1, Severity::kCritical}},
       -1,
       Kind::kCritical,
       "5.00 N at 1.0 s: above the critical limit of 4.7 N.",
       "Try next: stop as soon as you feel contact, then press; never above 1.5 N.",
       "Try next: stop as soon as the tissue gives way, then press little; never above 1.5 N."},
      {"TimeRanOutWithGoodForce",
       kTouch,
       "L1",
       {{"time_s", 120}},
       {{"TARGET_HELD", 7, Severity::kInfo}},
       7,
       Kind::kUndone,
       "Time ran out: 7 of 13 done.",
       "Try next: keep this care and save pauses between targets; the expert hand takes 38 s.",
       "Try next: keep this care and save pauses between targets; a practised hand takes 56 s."},
      {"Slow",
       kTouch,
       "L2",
       {{"time_s", 126}, {"object_in_band_share", 0.785}, {"wrong_places", 1}},
       {},
       -1,
       Kind::kLoss,
       "72.7 of 100 points, a pass needs 75. Most points were lost on: Time.",
       "Try next: keep this care and save pauses between targets; the expert hand takes 42 s.",
       "Try next: keep this care and save pauses between targets; a practised hand takes 56 s."},
      {"LongWay",
       kTouch,
       "L1",
       {{"path_ratio", 2.2}},
       {},
       -1,
       Kind::kLoss,
       "90.0 of 100 points, a pass needs 75. Most points were lost on: Path ratio.",
       "The tip went 2.20 times the shortest way. "
       "Try next: decide the way first, then go there in one straight move."},

      {"NoPenMatched",
       kReach,
       "L1",
       {{"matched_in_time_share", 0},
        {"position_error_m", kNone},
        {"angle_error_deg", kNone},
        {"path_ratio", kNone},
        {"time_s", 180}},
       {{"TARGET_TIMEOUT", 12}},
       0,
       Kind::kUndone,
       "Time ran out: 0 of 8 done.",
       "12 times a pen ran out of time. "
       "Try next: bring the tip to the end of the lit pen, then turn along it, then hold still."},
      {"PensOutOfTime",
       kReach,
       "L1",
       {{"matched_in_time_share", 0.25}},
       {{"TARGET_TIMEOUT", 6}, {"TARGET_HELD", 8, Severity::kInfo}},
       -1,
       Kind::kLoss,
       "73.8 of 100 points, a pass needs 75. Most points were lost on: Poses matched.",
       "6 times a pen ran out of time. "
       "Try next: turn the instrument while you travel, so that only the last millimetres are left.",
       "6 times a pen ran out of time. "
       "Try next: place the tip, then lean the shaft along the pen, and roll it last."},
      {"PlaceOfPens",
       kReach,
       "L1",
       {{"position_error_m", 0.005}, {"angle_error_deg", 12}},
       {},
       -1,
       Kind::kLoss,
       "73.5 of 100 points, a pass needs 75. Most points were lost on: Place.",
       "5.0 mm off the place on average. "
       "Try next: hold still for the whole time; rest your hand, and move only the tip.",
       "5.0 mm off the place on average. "
       "Try next: make the last millimetres in small moves, then let everything rest."},
      {"TurnOfPens",
       kReach,
       "L3",
       {{"angle_error_deg", 7.5}, {"time_s", 28}},
       {},
       -1,
       Kind::kLoss,
       "74.2 of 100 points, a pass needs 75. Most points were lost on: Turn.",
       "7.5\u00b0 off the turn on average. Try next: bring the tip to its place first, then turn about it."},

      {"NoBlockGripped",
       kGrasp,
       "L1",
       {{"object_grip_window_share", kNone}, {"objects_done_share", 0}, {"time_s", 150}},
       {},
       0,
       Kind::kNotTried,
       "Time ran out: 0 of 6 done. No block was gripped, so grip in window cannot be judged.",
       "Try next: go down with open jaws round the lit block, then close them."},
      {"NoBlockLifted",
       kGrasp,
       "L1",
       {{"object_grip_window_share", kNone}, {"objects_done_share", 0}, {"time_s", 150}},
       {{"GRASPED", 2, Severity::kInfo}, {"REGRASP", 9}},
       0,
       Kind::kNotTried,
       "Time ran out: 0 of 6 done. No block was lifted, so grip in window cannot be judged.",
       "Try next: close the jaws until the block no longer slides, then lift it 30 mm."},
      {"HeldTooLightly",
       kGrasp,
       "L1",
       {{"object_grip_window_share", 0.5}},
       {{"SLIP", 5}, {"CRUSH", 1, Severity::kMajor}},
       -1,
       Kind::kGate,
       "Grip in window: 50 %; a pass needs at least 70 %.",
       "Held too lightly: 5 times it slipped. "
       "Try next: set your grip before you lift, and hold it unchanged until the block stands."},
      {"HeldTooHard",
       kGrasp,
       "L2",
       {{"object_grip_window_share", 0.5}},
       {{"CRUSH", 1, Severity::kMajor}},
       -1,
       Kind::kGate,
       "Grip in window: 50 %; a pass needs at least 70 %.",
       "Held too hard: one block crushed. "
       "Try next: set your grip before you lift, and hold it unchanged until the block stands."},
      {"TwoCrushed",
       kGrasp,
       "L1",
       {{"crushed", 2}},
       {{"CRUSH", 2, Severity::kMajor}},
       -1,
       Kind::kGate,
       "Crushed: 2; a pass needs at most 1.",
       "2 blocks crushed. Try next: close the jaws slowly and stop as soon as the block no longer slides."},
      {"ThreeCrushed",
       kGrasp,
       "L1",
       {{"crushed", 3}},
       {{"CRUSH", 1, Severity::kCritical}},
       -1,
       Kind::kCritical,
       "Too many blocks crushed, the last one at 1.0 s.",
       kSlower},
      {"Lost",
       kGrasp,
       "L3",
       {{"objects_done_share", 0.5}},
       {{"LOST", 1, Severity::kCritical}},
       3,
       Kind::kCritical,
       "Lost at 1.0 s: it lies outside the field.",
       "Try next: stay within the board, and let go only where it belongs."},
      {"Dropped",
       kGrasp,
       "L1",
       {{"objects_done_share", 0.3}, {"time_s", 150}},
       {{"DROP", 4, Severity::kMajor}, {"MISPLACED", 1}},
       2,
       Kind::kUndone,
       "Time ran out: 2 of 6 done.",
       "4 times a block dropped. Try next: keep the jaws closed until the block stands on the board."},
      {"SetDownBeside",
       kGrasp,
       "L1",
       {{"objects_done_share", 0.3}},
       {{"MISPLACED", 3}},
       2,
       Kind::kUndone,
       "Time ran out: 2 of 6 done.",
       "3 times set down outside the ring. "
       "Try next: bring the block over the middle of its ring, lower it until it stands, then let go."},
      {"LeftUndone",
       kGrasp,
       "L1",
       {{"objects_done_share", 0.5}},
       {{"PLACED", 3, Severity::kInfo}},
       3,
       Kind::kUndone,
       "Time ran out: 3 of 6 done.",
       "3 of 6 blocks placed. "
       "Try next: set each block down whole within its ring before you take the next one."},
      {"Regrasped",
       kGrasp,
       "L1",
       {{"block_regrasps", 9}, {"time_s", 150}},
       {{"REGRASP", 9}},
       -1,
       Kind::kLoss,
       "71.1 of 100 points, a pass needs 75. Most points were lost on: Regrasps.",
       "9 times grasped again. Try next: take each block in its middle, firmly enough to carry it at one go."},
  };
  return all;
}

AttemptResult attempt_of(const Failure& failure, const Exercise& exercise) {
  AttemptResult result = graded(exercise, failure.level, failure.values);
  result.events = {event(2, "START")};
  for (const Times& times : failure.happened)
    for (int i = 0; i < times.count; ++i) {
      result.events.push_back(event(3 + i, times.type, times.severity, 5, ""));
      result.events.back().object = i;
    }
  const int total = exercise.layout.count + (exercise.kind == ExerciseKind::kTouch ? 1 : 0);
  const bool lost = failure.cause == Kind::kCritical;
  if (failure.done >= 0 && !lost) result.grade.status = AttemptStatus::kTimeout;
  put_caps(result, exercise, failure.done, total);
  return result;
}

class FailureTest : public ::testing::TestWithParam<Failure> {};

TEST_P(FailureTest, HasOneCauseThatReasonAndAdviceName) {
  const Failure& failure = GetParam();
  const Exercise exercise = shipped_exercise(failure.exercise);
  for (const bool mouse : {false, true}) {
    AttemptResult result = attempt_of(failure, exercise);
    result.device.backend = mouse ? kPointerBackend : "simulated";
    for (const char* language : {"en", "fr", "de"}) {
      const Translator words(TROCAR_SOURCE_DIR "/assets/languages", language);
      const DebriefFacts facts = debrief_facts(words, result, exercise);
      const std::string said = advice(words, result, facts, exercise);
      EXPECT_EQ(facts.cause.kind, failure.cause);
      for (const std::string& text : {facts.reason, said})
        EXPECT_EQ(text.find(words("n/a")), std::string::npos) << text;
      for (const std::string& text : facts.more) EXPECT_EQ(text.find(words("n/a")), std::string::npos) << text;
      EXPECT_TRUE(words.missing().empty()) << language << ": " << *words.missing().begin();
      if (language != std::string("en")) continue;
      EXPECT_EQ(facts.reason, failure.reason);
      EXPECT_EQ(said, mouse ? failure.by_mouse : failure.by_device);
      EXPECT_TRUE(!mouse || said.find("feel") == std::string::npos) << said;
      EXPECT_LE(said.size(), 150u) << said;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FailureTest, ::testing::ValuesIn(failures()),
                         [](const auto& tested) { return std::string(tested.param.name); });

class EndsTest : public ::testing::Test {
 protected:
  std::pair<DebriefFacts, std::string> said(const AttemptResult& result) const {
    const DebriefFacts facts = debrief_facts(words_, result, touch_);
    return {facts, advice(words_, result, facts, touch_)};
  }
  const Translator words_;
  const Exercise touch_ = shipped_exercise("surface-touch");
};

TEST_F(EndsTest, TimeThatRanOutBeforeTheClockBeganIsNoFailureOfForce) {
  AttemptResult result =
      graded(touch_, "L1", {{"object_in_band_share", kNone}, {"path_ratio", kNone}, {"time_s", kNone}});
  result.grade.status = AttemptStatus::kTimeout;
  put_caps(result, touch_, 0, 13);
  const auto [facts, next] = said(result);
  EXPECT_EQ(facts.cause.kind, Kind::kNotStarted);
  EXPECT_EQ(facts.reason, "Time ran out before the clock began: the tip did not rest in the ball at the start.");
  EXPECT_TRUE(facts.more.empty()) << facts.more.front();
  EXPECT_EQ(next, "Try next: bring the tip into the ball at the start and rest there for 1 s.");
}

TEST_F(EndsTest, TheGateThatWasHiddenByThePlacesIsStillSaid) {
  AttemptResult result = graded(touch_, "L1", {{"object_in_band_share", 0.08}, {"wrong_places", 13}, {"time_s", 120}});
  result.events = {event(2, "START")};
  result.grade.status = AttemptStatus::kTimeout;
  put_caps(result, touch_, 0, 13);
  EXPECT_EQ(said(result).first.more, (std::vector<std::string>{"Force in band: 8 %; a pass needs at least 65 %.",
                                                               "Time ran out: 0 of 13 done."}));
}

TEST_F(EndsTest, AnOpenedDeadmanIsNamed) {
  AttemptResult result;
  result.level = "L1";
  result.grade.status = AttemptStatus::kVoid;
  result.events = {event(2, "START"), event(9, "DEADMAN_OPEN", Severity::kMajor)};
  const auto [facts, next] = said(result);
  EXPECT_EQ(facts.reason, "The deadman was opened while the clock ran: the attempt is void, and counts as not passed.");
  EXPECT_EQ(next, "Try next: keep the deadman closed until the clock stops.");
}

TEST_F(EndsTest, LeavingAndADeviceThatStoppedAskForTheSameAgain) {
  AttemptResult result;
  result.level = "L1";
  result.grade.status = AttemptStatus::kAborted;
  EXPECT_EQ(said(result).second, "Try next: the whole task once, however slowly; only a finished one is graded.");
  result.events = {event(2, "START")};
  for (const auto status : {AttemptStatus::kFault, AttemptStatus::kVoid}) {
    result.grade.status = status;
    EXPECT_EQ(said(result).second, "Try next: the same once more; call your teacher if it happens again.");
  }
}

TEST_F(EndsTest, WhatNeverBeganSaysHowItBegins) {
  AttemptResult result;
  result.level = "L1";
  result.grade.status = AttemptStatus::kVoid;
  const auto [facts, next] = said(result);
  EXPECT_EQ(facts.reason, "The clock never began: nothing is graded, and it does not count.");
  EXPECT_EQ(next, "Try next: bring the tip into the ball at the start and rest there for 1 s.");
}

}  // namespace
}  // namespace trocar::failures_test
