#include "app/window/practice/practice_desk.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/session/setup/recorded_scene.h"
#include "app/window/pages/progress_screen.h"
#include "haptics/input_error.h"
#include "scenarios/layout/board_numbers.h"
#include "tests/app/window/pages/desk_bench.h"
#include "trainees/records/assessments.h"

namespace trocar::practice_desk_test {
namespace {

using testing_support::DeskBench;

/// Stores a graded attempt, as the runner does.
void store(const std::filesystem::path& database, const Exercise& exercise, const std::string& level, int board,
           bool passed, const std::string& trainee = "T-1", const std::string& hand = "mouse") {
  Database db(database);
  AttemptStore attempts(db);
  AttemptStart start;
  start.trainee = trainee;
  start.exercise_id = exercise.id;
  start.exercise_version = exercise.version;
  start.exercise_number = exercise.number;
  start.exercise_title = exercise.title;
  start.exercise_text = exercise.text;
  start.level = level;
  start.board = board;
  start.hand = hand;
  start.program = "test";
  start.recording = std::filesystem::path();
  const AttemptId id = attempts.begin_attempt(start);
  AttemptResult result;
  result.grade.status = AttemptStatus::kCompleted;
  result.grade.score = passed ? 85 : 30;
  result.grade.passed = passed;
  result.grade.grade = passed ? "proficient" : "below pass";
  attempts.finish_attempt(id, result);
}

TEST(PracticeDesk, BeginsAsAGuestAtTheFirstExercise) {
  const DeskBench bench;
  const auto desk = bench.desk();
  EXPECT_TRUE(desk->is_guest());
  EXPECT_EQ(desk->exercise_id, desk->exercises().front().id);
  EXPECT_EQ(desk->level, "L1");
  EXPECT_FALSE(desk->running());
  EXPECT_FALSE(desk->result());
  EXPECT_TRUE(desk->recording().empty());
  EXPECT_TRUE(desk->notice.empty()) << desk->notice;
}

TEST(PracticeDesk, SignsInByCodeAndSaysWhatIsWrongWithOne) {
  const DeskBench bench;
  const auto desk = bench.desk();
  EXPECT_NE(desk->sign_in(""), "");
  EXPECT_NE(desk->sign_in("no spaces"), "");
  EXPECT_TRUE(desk->is_guest());
  EXPECT_EQ(desk->sign_in("T-1"), "");
  EXPECT_EQ(desk->trainee(), "T-1");
  desk->sign_out();
  EXPECT_TRUE(desk->is_guest());
}

TEST(PracticeDesk, OptionsChooseTraineeExerciseAndLevel) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.trainee = "T-9";
  options.exercise = "E02";
  options.level = "L2";
  const auto desk = bench.desk(options);
  EXPECT_EQ(desk->trainee(), "T-9");
  EXPECT_EQ(desk->exercise().id, "surface-touch");
  EXPECT_EQ(desk->level, "L2");
}

TEST(PracticeDesk, WrongOptionsAreRefusedBeforeAWindowOpens) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.exercise = "E99";
  EXPECT_THROW(bench.desk(options), InputError);
  options = bench.options();
  options.level = "L9";
  EXPECT_THROW(bench.desk(options), InputError);
  options = bench.options();
  options.trainee = "a b";
  EXPECT_THROW(bench.desk(options), InputError);
  options = bench.options();
  options.organ = "nosuch";
  try {
    bench.desk(options);
    FAIL() << "only the first attempt would find out";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("phantom-liver"), std::string::npos) << "what there is";
  }
  options = bench.options();
  options.hand = "nosuch";
  try {
    bench.desk(options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("novice"), std::string::npos);
  }
  options.hand = "expert";
  options.trainee = "T-9";
  EXPECT_THROW(bench.desk(options), InputError) << "a demonstration is nobody's attempt";
  options = bench.options();
  options.language = "xx";
  EXPECT_THROW(bench.desk(options), InputError);
}

TEST(PracticeDesk, StandingsComeFromTheStoreOfThisTraineeAlone) {
  const DeskBench bench;
  const auto desk = bench.desk();
  const Exercise& first = desk->exercises().front();
  store(bench.options().database, first, "L1", 1, true);
  EXPECT_EQ(desk->standing(first.id, "L1").attempts, 0) << "that was not the guest";
  ASSERT_EQ(desk->sign_in("T-1"), "");
  EXPECT_EQ(desk->standing(first.id, "L1").attempts, 1);
  EXPECT_EQ(desk->standing(first.id, "L1").best, 85);
  EXPECT_EQ(desk->standing("unknown", "L1").attempts, 0);
}

TEST(PracticeDesk, ThreePassesOnThreeBoardsOpenTheNextLevelAndChangeTheAdvice) {
  const DeskBench bench;
  const auto desk = bench.desk();
  ASSERT_EQ(desk->sign_in("T-1"), "");
  const Exercise& first = desk->exercises().front();
  EXPECT_EQ(desk->next().exercise_id, first.id);
  EXPECT_EQ(desk->next().level, "L1");
  EXPECT_FALSE(desk->standing(first.id, "L2").unlocked);
  for (const int board : {1001, 1002, 1003}) {
    EXPECT_EQ(desk->next().exercise_id, first.id);
    store(bench.options().database, first, "L1", board, true);
  }
  EXPECT_TRUE(desk->standing(first.id, "L2").unlocked);
  EXPECT_EQ(desk->next().exercise_id, desk->exercises()[1].id) << "all exercises at a level before the next level";
  EXPECT_EQ(desk->next().level, "L1");
}

TEST(PracticeDesk, ATeachersDecisionOpensTheNextLevelAndIsSaidWhenTheAttemptIsOpened) {
  const DeskBench bench;
  const auto desk = bench.desk();
  ASSERT_EQ(desk->sign_in("T-1"), "");
  const Exercise& first = desk->exercises().front();
  for (const int board : {1001, 1002, 1003}) store(bench.options().database, first, "L1", board, board != 1002);
  EXPECT_FALSE(desk->standing(first.id, "L2").unlocked);
  EXPECT_EQ(desk->standing(first.id, "L1").passed, 2);
  const std::string uuid = desk->past(first.id)[1].summary.uuid;
  {
    Database db(bench.options().database);
    AssessmentStore(db).override_verdict(uuid, true, "The stand slipped twice", {"", "Dr B"});
  }
  EXPECT_TRUE(desk->standing(first.id, "L2").unlocked);
  EXPECT_EQ(desk->standing(first.id, "L1").passed, 3);
  EXPECT_TRUE(desk->past(first.id)[1].summary.passed);
  desk->notice.clear();
  ASSERT_TRUE(desk->open_result(uuid));
  EXPECT_EQ(desk->notice.find("Dr B decided on 20"), 0u) << desk->notice;
  EXPECT_NE(desk->notice.find("that this attempt is passed: The stand slipped twice"), std::string::npos)
      << desk->notice;
  desk->notice.clear();
  ASSERT_TRUE(desk->open_result(desk->past(first.id)[0].summary.uuid));
  EXPECT_EQ(desk->notice, "");
}

TEST(PracticeDesk, ALockedLevelIsRefusedInWords) {
  const DeskBench bench;
  const auto desk = bench.desk();
  desk->level = "L2";
  EXPECT_NE(desk->begin_attempt().find("L2"), std::string::npos);
  EXPECT_NE(desk->locked().find("L1"), std::string::npos) << "what opens it";
  desk->level = "L1";
  EXPECT_EQ(desk->locked(), "");
  EXPECT_FALSE(desk->running());
}

TEST(PracticeDesk, AnAttemptThatIsLeftIsStoredAsAborted) {
  const DeskBench bench;
  const auto desk = bench.desk();
  ASSERT_EQ(desk->sign_in("T-1"), "");
  ASSERT_EQ(desk->begin_attempt(), "");
  ASSERT_TRUE(desk->running());
  EXPECT_NE(desk->begin_attempt(), "") << "one at a time";
  while (!desk->running()->ready()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(desk->end_attempt()) << desk->notice;
  EXPECT_FALSE(desk->running());
  ASSERT_TRUE(desk->result());
  EXPECT_EQ(desk->result()->grade.status, AttemptStatus::kAborted);
  EXPECT_EQ(desk->result()->hand, "mouse");
  EXPECT_EQ(desk->result()->board, drawn_board(7, false));
  ASSERT_TRUE(desk->last_scene());
  const Standing s = desk->standing(desk->exercise_id, "L1");
  ASSERT_EQ(s.attempts, 1);
  EXPECT_EQ(s.newest_first.front().status, "aborted");
}

TEST(PracticeDesk, AnOrganIsPlacedOnceForAttemptsThatFollowEachOther) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.exercise = "surface-touch";
  const auto desk = bench.desk(options);
  const auto attempt = [&] {
    EXPECT_EQ(desk->begin_attempt(), "");
    EXPECT_TRUE(desk->end_attempt()) << desk->notice;
    return desk->last_scene();
  };
  const std::shared_ptr<const Scene> first = attempt(), second = attempt();
  EXPECT_FALSE(first->setup.placement.has_value()) << "searched";
  ASSERT_TRUE(second->setup.placement.has_value()) << "known";
  EXPECT_EQ(second->placement.X_TO.p, first->placement.X_TO.p);
  EXPECT_EQ(second->placement.X_TO.R, first->placement.X_TO.R);
  desk->organ = "phantom-gallbladder";
  EXPECT_FALSE(attempt()->setup.placement.has_value()) << "another organ is searched";
}

TEST(PracticeDesk, InMemoryTheSittingIsKeptInMind) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.database = ":memory:";
  const auto desk = bench.desk(options);
  ASSERT_EQ(desk->begin_attempt(), "");
  ASSERT_TRUE(desk->end_attempt()) << desk->notice;
  EXPECT_EQ(desk->standing(desk->exercise_id, "L1").attempts, 1);
  EXPECT_EQ(desk->database(), ":memory:");
}

TEST(PracticeDesk, SettingsAreKeptForTheNextTime) {
  const DeskBench bench;
  {
    const auto desk = bench.desk();
    desk->settings().scale = 1.5;
    desk->settings().keys = {{"roll-left", "I"}};
    desk->settings_changed();
    EXPECT_EQ(desk->scale(), 1.5);
    EXPECT_EQ(desk->keys().action_of('I'), Action::kRollLeft);
  }
  const auto again = bench.desk();
  EXPECT_EQ(again->scale(), 1.5);
  EXPECT_EQ(again->keys().key_of(Action::kRollLeft), 'I');
}

TEST(PracticeDesk, ScaleOfTheCommandLineHoldsThisTimeOnly) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.scale = 2;
  const auto desk = bench.desk(options);
  EXPECT_EQ(desk->scale(), 2);
  EXPECT_EQ(desk->settings().scale, 1);
}

TEST(PracticeDesk, AChoiceOfSizeLeavesTheLanguageOfTheCommandLine) {
  const DeskBench bench;
  DeskOptions options = bench.options();
  options.language = "fr";
  options.scale = 1.25;
  const auto desk = bench.desk(options);
  desk->choose_scale(1);
  EXPECT_EQ(desk->scale(), 1) << "though the settings said so before";
  EXPECT_EQ(desk->words().language(), "fr");
  desk->choose_language("en");
  EXPECT_EQ(desk->words().language(), "en");
  EXPECT_EQ(desk->settings().language, "en");
}

TEST(PracticeDesk, KeysThatContradictEachOtherAreANoticeNotAnEnd) {
  const DeskBench bench;
  std::ofstream(bench.options().settings) << "version = 1\n[keys]\nroll-left = \"Esc\"\n";
  const auto desk = bench.desk();
  EXPECT_FALSE(desk->notice.empty());
  EXPECT_EQ(desk->keys().key_of(Action::kRollLeft), KeyMap().key_of(Action::kRollLeft));
}

TEST(PracticeDesk, ADatabaseThatIsNoneIsRefused) {
  const DeskBench bench;
  std::ofstream(bench.options().database)
      << "this is no database, but long enough to look at: " << std::string(200, 'x');
  EXPECT_THROW(bench.desk(), InputError);
}

TEST(PracticeDesk, TheShowSceneLoadsBehindTheDesk) {
  const DeskBench bench;
  const auto desk = bench.desk();
  const auto scene = desk->show_scene(60);
  ASSERT_TRUE(scene);
  ASSERT_TRUE(scene->organ);
  EXPECT_FALSE(scene->organ->triangles.empty());
  EXPECT_EQ(desk->show_scene(0), scene) << "loaded once";
}

TEST(PracticeDeskNotice, UnreadableSettingsAreSaidInTheLanguageWithoutTheParsersWords) {
  testing_support::DeskBench bench;
  DeskOptions options = bench.options();
  bench.folder.write("settings.toml", "version = 1\nscale = = 2\n");
  options.language = "de";
  const auto desk = bench.desk(options);
  EXPECT_NE(desk->notice.find("Zeile 2"), std::string::npos) << desk->notice;
  EXPECT_NE(desk->notice.find("settings.toml.unread"), std::string::npos) << desk->notice;
  EXPECT_EQ(desk->notice.find("Error"), std::string::npos) << desk->notice;
  desk->settings_changed();
  EXPECT_TRUE(std::filesystem::exists(unread_settings(options.settings)));
}

TEST(PracticeDesk, WhatAScriptedHandDidIsNobodysPass) {
  const DeskBench bench;
  {
    const auto desk = bench.desk();
    const Exercise& first = desk->exercises().front();
    for (const int board : {1001, 1002, 1003})
      store(bench.options().database, first, "L1", board, true, "guest", "expert");
    EXPECT_EQ(desk->standing(first.id, "L1").attempts, 0) << "an older database holds such runs as a guest's";
    EXPECT_FALSE(desk->standing(first.id, "L2").unlocked);
    EXPECT_TRUE(desk->past().empty());
    EXPECT_NE(desk->sign_in("demonstration"), "") << "kept for them";
  }
  DeskOptions options = bench.options();
  options.hand = "expert";
  const auto desk = bench.desk(options);
  EXPECT_EQ(desk->who(), "Demonstration");
  ASSERT_EQ(desk->begin_attempt(), "");
  ASSERT_TRUE(desk->end_attempt());
  EXPECT_EQ(desk->result()->trainee, "demonstration");
  EXPECT_EQ(desk->standing(desk->exercise_id, "L1").attempts, 1) << "shown to those who watch";
  EXPECT_EQ(bench.desk()->standing(desk->exercise_id, "L1").attempts, 0);
}

TEST(PracticeDesk, AnAttemptThatWasCutOffIsNamedAtTheNextStart) {
  const DeskBench bench;
  const ::pid_t child = ::fork();
  if (child == 0) {
    Database db(bench.options().database);
    AttemptStart start;
    start.trainee = "T-5";
    start.exercise_id = "surface-touch";
    start.exercise_text = "text";
    start.level = "L1";
    start.hand = "mouse";
    start.recording = std::filesystem::path();
    AttemptStore(db).begin_attempt(start);
    ::_exit(0);  // as kill -9 leaves it
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const auto desk = bench.desk();
  EXPECT_NE(desk->notice.find("The attempt of E02 (T-5) at "), std::string::npos) << desk->notice;
  EXPECT_NE(desk->notice.find("was cut off"), std::string::npos);
  desk->notice.clear();
  ASSERT_EQ(desk->sign_in("T-5"), "");
  EXPECT_NE(desk->notice.find("The attempt of E02 at "), std::string::npos) << "and to whoever it was";
  ASSERT_EQ(progress_of(*desk).size(), 1u);
  EXPECT_NE(progress_of(*desk).front().note.find("was cut off"), std::string::npos) << "it stays in the progress";
  ASSERT_EQ(bench.desk()->notice, "") << "said once";
}

TEST(PracticeDesk, TheExpertDoesWhatTheAttemptDidNotWhatTheDeskWouldDoNow) {
  const DeskBench bench;
  const auto desk = bench.desk();
  desk->exercise_id = "surface-touch";
  ASSERT_EQ(desk->begin_attempt(), "");
  ASSERT_TRUE(desk->end_attempt());
  desk->organ = "phantom-abdomen";  // chosen since
  for (int i = 0; i < 3000 && desk->expert_recording().empty() && desk->expert_refusal().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_FALSE(desk->expert_recording().empty()) << desk->expert_refusal();
  const AttemptSetup own = recorded_setup(desk->recording()), beside = recorded_setup(desk->expert_recording());
  EXPECT_EQ(beside.organ, own.organ);
  EXPECT_EQ(beside.board, own.board);
  EXPECT_EQ(beside.seed, own.seed);
  EXPECT_EQ(beside.hand, "expert");
}

}  // namespace
}  // namespace trocar::practice_desk_test
