#include "app/window/practice/practice_model.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/session/setup/recorded_scene.h"
#include "app/window/pages/progress_screen.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/layout/board_numbers.h"
#include "tests/app/window/pages/practice_bench.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"

namespace trocar::practice_model_test {
namespace {

using testing_support::PracticeBench;

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

TEST(PracticeModel, BeginsAsAGuestAtTheFirstExercise) {
  const PracticeBench bench;
  const auto model = bench.model();
  EXPECT_TRUE(model->is_guest());
  EXPECT_EQ(model->exercise_id, model->exercises().front().id);
  EXPECT_EQ(model->level, "L1");
  EXPECT_FALSE(model->running());
  EXPECT_FALSE(model->result());
  EXPECT_TRUE(model->recording().empty());
  EXPECT_TRUE(model->notice.empty()) << model->notice;
}

TEST(PracticeModel, TheLoopKnowsItsDeviceFromTheFilesThatWereGiven) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.input = "device";
  options.backend = kEmulatedMc4000Backend;
  options.device = bench.folder.write("jig.toml", "[homing]\nmethod = \"edges\"\nsee_dark = true\n");
  auto model = bench.model(options);
  EXPECT_EQ(model->backend(), kEmulatedMc4000Backend);
  ASSERT_EQ(model->begin_attempt(), "");
  const Scene& scene = model->running()->scene();
  EXPECT_EQ(scene.loop.device.homing.method, HomingMethod::kEdges);
  EXPECT_TRUE(scene.setup.device.identified);
  model.reset();
  options.input = "mouse";
  model = bench.model(options);
  ASSERT_EQ(model->begin_attempt(), "");
  EXPECT_FALSE(model->running()->scene().setup.device.identified) << "there is no device to know of";
}

TEST(PracticeModel, BadDeviceFilesAndScriptsOnARealArmAreRefusedAtOnce) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.device = bench.folder.write("bad.toml", "[homing]\nmethod = \"guess\"\n");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { bench.model(options); }), "bad.toml");
  options.device.clear();
  options.backend = kHostmot2Backend;
  options.hand = "expert";
  EXPECT_CONTAINS(test::message_of<InputError>([&] { bench.model(options); }), "no script moves it");
}

TEST(PracticeModel, SignsInByCodeAndSaysWhatIsWrongWithOne) {
  const PracticeBench bench;
  const auto model = bench.model();
  EXPECT_NE(model->sign_in(""), "");
  EXPECT_NE(model->sign_in("no spaces"), "");
  EXPECT_TRUE(model->is_guest());
  EXPECT_EQ(model->sign_in("T-1"), "");
  EXPECT_EQ(model->trainee(), "T-1");
  model->sign_out();
  EXPECT_TRUE(model->is_guest());
}

TEST(PracticeModel, SaysWhichCodesNobodyHasYet) {
  using Asks = PracticeModel::CodeAsks;
  const PracticeBench bench;
  const auto model = bench.model();
  EXPECT_EQ(model->code_asks("T-1"), Asks::kNew);
  EXPECT_EQ(model->code_asks("T-1"), Asks::kNew) << "asking makes nobody";
  EXPECT_EQ(model->code_asks("no spaces"), Asks::kNothing) << "signing in says what is wrong with it";
  EXPECT_EQ(model->code_asks("guest"), Asks::kNothing);
  ASSERT_EQ(model->sign_in("T-1"), "");
  model->sign_out();
  EXPECT_EQ(model->code_asks("T-1"), Asks::kNothing);
  EXPECT_EQ(model->code_asks("t-1"), Asks::kNothing) << "codes differ by more than case";
}

TEST(PracticeModel, AStationThatAsksForThePinTakesTheRightOneAndWaitsAfterEachWrongOne) {
  using Asks = PracticeModel::CodeAsks;
  const PracticeBench bench;
  const auto model = bench.model();
  for (const char* code : {"T-1", "T-2"}) ASSERT_EQ(model->sign_in(code), "");
  model->sign_out();
  {
    Database database(bench.options().database, OpenMode::kExisting);
    AccountStore(database).add("ann", "Ann", Role::kTrainee, "T-1", "580274", "");
  }
  EXPECT_EQ(model->code_asks("T-1"), Asks::kNothing) << "not unless the station asks";
  model->settings().ask_pin = true;
  model->settings_changed();
  EXPECT_TRUE(load_settings(bench.options().settings).ask_pin) << "on the disk";
  for (const char* code : {"T-1", "t-1"}) EXPECT_EQ(model->code_asks(code), Asks::kPin) << code;
  EXPECT_EQ(model->code_asks("T-2"), Asks::kNothing) << "has none";
  EXPECT_EQ(model->sign_in("T-2"), "");
  model->sign_out();
  EXPECT_EQ(model->sign_in("T-1"), "Type your PIN.");
  EXPECT_EQ(model->sign_in("t-1", "111111"), "This PIN is wrong. Wait 1 s, then try again.");
  EXPECT_EQ(model->sign_in("T-1", "580274"), "Wait 1 s, then try again.") << "whatever is typed";
  EXPECT_TRUE(model->is_guest());
  std::this_thread::sleep_for(std::chrono::milliseconds(1050));
  EXPECT_EQ(model->sign_in("T-1", "111111"), "This PIN is wrong. Wait 2 s, then try again.");
  std::this_thread::sleep_for(std::chrono::milliseconds(2050));
  EXPECT_EQ(model->sign_in("T-1", "580274"), "");
  EXPECT_EQ(model->trainee(), "T-1");
  ModelOptions straight = bench.options();
  straight.trainee = "T-1";
  EXPECT_THROW(bench.model(straight), InputError) << "not round the PIN by the command line";
  Database database(bench.options().database, OpenMode::kExisting);
  AccountStore(database).set_disabled("ann", true, "");
  EXPECT_EQ(model->sign_in("T-1", "580274"), "The account of this code is disabled: ask your teacher.");
}

TEST(PracticeModel, WhoIsDeactivatedDoesNotSignIn) {
  const PracticeBench bench;
  const auto model = bench.model();
  ASSERT_EQ(model->sign_in("T-1"), "");
  model->sign_out();
  Database database(bench.options().database, OpenMode::kExisting);
  StandingStore(database).set_active({"T-1"}, false, "", {"", "x"});
  EXPECT_EQ(model->sign_in("t-1"), "This code is deactivated: ask your teacher.");
  EXPECT_TRUE(model->is_guest());
  StandingStore(database).set_active({"T-1"}, true, "", {"", "x"});
  EXPECT_EQ(model->sign_in("T-1"), "");
}

TEST(PracticeModel, OptionsChooseTraineeExerciseAndLevel) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.trainee = "T-9";
  options.exercise = "E02";
  options.level = "L2";
  const auto model = bench.model(options);
  EXPECT_EQ(model->trainee(), "T-9");
  EXPECT_EQ(model->exercise().id, "surface-touch");
  EXPECT_EQ(model->level, "L2");
}

TEST(PracticeModel, WrongOptionsAreRefusedBeforeAWindowOpens) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.exercise = "E99";
  EXPECT_THROW(bench.model(options), InputError);
  options = bench.options();
  options.level = "L9";
  EXPECT_THROW(bench.model(options), InputError);
  options = bench.options();
  options.trainee = "a b";
  EXPECT_THROW(bench.model(options), InputError);
  options = bench.options();
  options.organ = "nosuch";
  try {
    bench.model(options);
    FAIL() << "only the first attempt would find out";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("phantom-liver"), std::string::npos) << "what there is";
  }
  options = bench.options();
  options.hand = "nosuch";
  try {
    bench.model(options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("novice"), std::string::npos);
  }
  options.hand = "expert";
  options.trainee = "T-9";
  EXPECT_THROW(bench.model(options), InputError) << "a demonstration is nobody's attempt";
  options = bench.options();
  options.language = "xx";
  EXPECT_THROW(bench.model(options), InputError);
}

TEST(PracticeModel, ProgressComesFromTheStoreOfThisTraineeAlone) {
  const PracticeBench bench;
  const auto model = bench.model();
  const Exercise& first = model->exercises().front();
  store(bench.options().database, first, "L1", 1, true);
  EXPECT_EQ(model->progress(first.id, "L1").attempts, 0) << "that was not the guest";
  ASSERT_EQ(model->sign_in("T-1"), "");
  EXPECT_EQ(model->progress(first.id, "L1").attempts, 1);
  EXPECT_EQ(model->progress(first.id, "L1").best, 85);
  EXPECT_EQ(model->progress("unknown", "L1").attempts, 0);
}

TEST(PracticeModel, ThreePassesOnThreeBoardsOpenTheNextLevelAndChangeTheAdvice) {
  const PracticeBench bench;
  const auto model = bench.model();
  ASSERT_EQ(model->sign_in("T-1"), "");
  const Exercise& first = model->exercises().front();
  EXPECT_EQ(model->next().exercise_id, first.id);
  EXPECT_EQ(model->next().level, "L1");
  EXPECT_FALSE(model->progress(first.id, "L2").unlocked);
  for (const int board : {1001, 1002, 1003}) {
    EXPECT_EQ(model->next().exercise_id, first.id);
    store(bench.options().database, first, "L1", board, true);
  }
  EXPECT_TRUE(model->progress(first.id, "L2").unlocked);
  EXPECT_EQ(model->next().exercise_id, model->exercises()[1].id) << "all exercises at a level before the next level";
  EXPECT_EQ(model->next().level, "L1");
}

TEST(PracticeModel, WhatIsDueInAProgrammeComesFirstUntilItIsPassed) {
  const PracticeBench bench;
  const auto model = bench.model();
  const std::string second = model->exercises()[1].id;
  {
    Database db(bench.options().database);
    const Author author{"", "Ida Adler"};
    TraineeStore(db).ensure_trainee("T-1");
    ProgrammeStore store(db);
    store.save("Autumn",
               "[[step]]\nexercise = \"" + second + "\"\nlevel = \"L2\"\n[[step]]\nexercise = \"" + second +
                   "\"\nlevel = \"L1\"\n[[step]]\nexercise = \"not-here\"\nlevel = \"L1\"\n",
               author);
    store.assign("Autumn", "T-1", "", "2099-06-30", author);
  }
  EXPECT_TRUE(model->due().empty()) << "a guest has no programme";
  ASSERT_EQ(model->sign_in("T-1"), "");
  ASSERT_EQ(model->due().size(), 2U) << "one step is of an exercise that this program does not have";
  EXPECT_EQ(model->due()[0].step.level, "L2");
  EXPECT_EQ(model->next().exercise_id, second) << "not the catalogue's first";
  EXPECT_EQ(model->next().level, "L1") << "L2 is locked yet";
  EXPECT_EQ(model->next().why, "Due by 2099-06-30.");
  store(bench.options().database, model->exercises()[1], "L1", 1001, true);
  ASSERT_EQ(model->sign_in("T-1"), "");
  ASSERT_EQ(model->due().size(), 1U);
  EXPECT_EQ(model->next().exercise_id, model->exercises().front().id) << "what is left of the programme is locked";
  model->sign_out();
  EXPECT_TRUE(model->due().empty());
  {
    Database db(bench.options().database);
    ProgrammeStore(db).assign("Autumn", "T-1", "", "2020-01-31", {"", "Ida Adler"});
  }
  ASSERT_EQ(model->sign_in("T-1"), "");
  ASSERT_EQ(model->due().size(), 1U);
  EXPECT_EQ(model->due_words(model->due()[0]), "Overdue since 2020-01-31.");
}

TEST(PracticeModel, ATeachersDecisionOpensTheNextLevelAndIsSaidWhenTheAttemptIsOpened) {
  const PracticeBench bench;
  const auto model = bench.model();
  ASSERT_EQ(model->sign_in("T-1"), "");
  const Exercise& first = model->exercises().front();
  for (const int board : {1001, 1002, 1003}) store(bench.options().database, first, "L1", board, board != 1002);
  EXPECT_FALSE(model->progress(first.id, "L2").unlocked);
  EXPECT_EQ(model->progress(first.id, "L1").passed, 2);
  const std::string uuid = model->past(first.id)[1].summary.uuid;
  {
    Database db(bench.options().database);
    AssessmentStore(db).override_verdict(uuid, true, "The stand slipped twice", {"0192-b", "Dr B"});
  }
  EXPECT_TRUE(model->progress(first.id, "L2").unlocked);
  EXPECT_EQ(model->progress(first.id, "L1").passed, 3);
  EXPECT_TRUE(model->past(first.id)[1].summary.passed);
  model->notice.clear();
  ASSERT_TRUE(model->open_result(uuid));
  EXPECT_EQ(model->notice.find("Dr B decided on 20"), 0u) << model->notice;
  EXPECT_NE(model->notice.find("that this attempt is passed: The stand slipped twice"), std::string::npos)
      << model->notice;
  model->notice.clear();
  ASSERT_TRUE(model->open_result(model->past(first.id)[0].summary.uuid));
  EXPECT_EQ(model->notice, "");
}

TEST(PracticeModel, ALockedLevelIsRefusedInWords) {
  const PracticeBench bench;
  const auto model = bench.model();
  model->level = "L2";
  EXPECT_NE(model->begin_attempt().find("L2"), std::string::npos);
  EXPECT_NE(model->locked().find("L1"), std::string::npos) << "what opens it";
  model->level = "L1";
  EXPECT_EQ(model->locked(), "");
  EXPECT_FALSE(model->running());
}

TEST(PracticeModel, AnAttemptThatIsLeftIsStoredAsAborted) {
  const PracticeBench bench;
  const auto model = bench.model();
  ASSERT_EQ(model->sign_in("T-1"), "");
  ASSERT_EQ(model->begin_attempt(), "");
  ASSERT_TRUE(model->running());
  EXPECT_NE(model->begin_attempt(), "") << "one at a time";
  while (!model->running()->ready()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(model->end_attempt()) << model->notice;
  EXPECT_FALSE(model->running());
  ASSERT_TRUE(model->result());
  EXPECT_EQ(model->result()->grade.status, AttemptStatus::kAborted);
  EXPECT_EQ(model->result()->hand, "mouse");
  EXPECT_EQ(model->result()->board, drawn_board(7, false));
  ASSERT_TRUE(model->last_scene());
  const LevelProgress s = model->progress(model->exercise_id, "L1");
  ASSERT_EQ(s.attempts, 1);
  EXPECT_EQ(s.newest_first.front().status, "aborted");
}

TEST(PracticeModel, AnOrganIsPlacedOnceForAttemptsThatFollowEachOther) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.exercise = "surface-touch";
  const auto model = bench.model(options);
  const auto attempt = [&] {
    EXPECT_EQ(model->begin_attempt(), "");
    EXPECT_TRUE(model->end_attempt()) << model->notice;
    return model->last_scene();
  };
  const std::shared_ptr<const Scene> first = attempt(), second = attempt();
  EXPECT_FALSE(first->setup.placement.has_value()) << "searched";
  ASSERT_TRUE(second->setup.placement.has_value()) << "known";
  EXPECT_EQ(second->placement.X_TO.p, first->placement.X_TO.p);
  EXPECT_EQ(second->placement.X_TO.R, first->placement.X_TO.R);
  model->organ = "phantom-gallbladder";
  EXPECT_FALSE(attempt()->setup.placement.has_value()) << "another organ is searched";
}

TEST(PracticeModel, InMemoryTheSittingIsKeptInMind) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.database = ":memory:";
  const auto model = bench.model(options);
  ASSERT_EQ(model->begin_attempt(), "");
  ASSERT_TRUE(model->end_attempt()) << model->notice;
  EXPECT_EQ(model->progress(model->exercise_id, "L1").attempts, 1);
  EXPECT_EQ(model->database(), ":memory:");
}

TEST(PracticeModel, SettingsAreKeptForTheNextTime) {
  const PracticeBench bench;
  {
    const auto model = bench.model();
    model->settings().scale = 1.5;
    model->settings().keys = {{"roll-left", "I"}};
    model->settings_changed();
    EXPECT_EQ(model->scale(), 1.5);
    EXPECT_EQ(model->keys().action_of('I'), Action::kRollLeft);
  }
  const auto again = bench.model();
  EXPECT_EQ(again->scale(), 1.5);
  EXPECT_EQ(again->keys().key_of(Action::kRollLeft), 'I');
}

TEST(PracticeModel, ScaleOfTheCommandLineHoldsThisTimeOnly) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.scale = 2;
  const auto model = bench.model(options);
  EXPECT_EQ(model->scale(), 2);
  EXPECT_EQ(model->settings().scale, 1);
}

TEST(PracticeModel, AChoiceOfSizeLeavesTheLanguageOfTheCommandLine) {
  const PracticeBench bench;
  ModelOptions options = bench.options();
  options.language = "fr";
  options.scale = 1.25;
  const auto model = bench.model(options);
  model->choose_scale(1);
  EXPECT_EQ(model->scale(), 1) << "though the settings said so before";
  EXPECT_EQ(model->words().language(), "fr");
  model->choose_language("en");
  EXPECT_EQ(model->words().language(), "en");
  EXPECT_EQ(model->settings().language, "en");
}

TEST(PracticeModel, KeysThatContradictEachOtherAreANoticeNotAnEnd) {
  const PracticeBench bench;
  std::ofstream(bench.options().settings) << "version = 1\n[keys]\nroll-left = \"Esc\"\n";
  const auto model = bench.model();
  EXPECT_FALSE(model->notice.empty());
  EXPECT_EQ(model->keys().key_of(Action::kRollLeft), KeyMap().key_of(Action::kRollLeft));
}

TEST(PracticeModel, ADatabaseThatIsNoneIsRefused) {
  const PracticeBench bench;
  std::ofstream(bench.options().database)
      << "this is no database, but long enough to look at: " << std::string(200, 'x');
  EXPECT_THROW(bench.model(), InputError);
}

TEST(PracticeModel, TheShowSceneLoadsBehindTheDesk) {
  const PracticeBench bench;
  const auto model = bench.model();
  const auto scene = model->show_scene(60);
  ASSERT_TRUE(scene);
  ASSERT_TRUE(scene->organ);
  EXPECT_FALSE(scene->organ->triangles.empty());
  EXPECT_EQ(model->show_scene(0), scene) << "loaded once";
}

TEST(PracticeModelNotice, UnreadableSettingsAreSaidInTheLanguageWithoutTheParsersWords) {
  testing_support::PracticeBench bench;
  ModelOptions options = bench.options();
  bench.folder.write("settings.toml", "version = 1\nscale = = 2\n");
  options.language = "de";
  const auto model = bench.model(options);
  EXPECT_NE(model->notice.find("Zeile 2"), std::string::npos) << model->notice;
  EXPECT_NE(model->notice.find("settings.toml.unread"), std::string::npos) << model->notice;
  EXPECT_EQ(model->notice.find("Error"), std::string::npos) << model->notice;
  ASSERT_EQ(model->begin_play(Play::kTutorial), "");
  model->end_attempt();
  EXPECT_FALSE(std::filesystem::exists(unread_settings(options.settings))) << "nobody has changed anything";
  model->settings_changed();
  EXPECT_TRUE(std::filesystem::exists(unread_settings(options.settings)));
}

TEST(PracticeModel, WhatAScriptedHandDidIsNobodysPass) {
  const PracticeBench bench;
  {
    const auto model = bench.model();
    const Exercise& first = model->exercises().front();
    for (const int board : {1001, 1002, 1003})
      store(bench.options().database, first, "L1", board, true, "guest", "expert");
    EXPECT_EQ(model->progress(first.id, "L1").attempts, 0) << "an older database holds such runs as a guest's";
    EXPECT_FALSE(model->progress(first.id, "L2").unlocked);
    EXPECT_TRUE(model->past().empty());
    EXPECT_NE(model->sign_in("demonstration"), "") << "kept for them";
  }
  ModelOptions options = bench.options();
  options.hand = "expert";
  const auto model = bench.model(options);
  EXPECT_EQ(model->who(), "Demonstration");
  ASSERT_EQ(model->begin_attempt(), "");
  ASSERT_TRUE(model->end_attempt());
  EXPECT_EQ(model->result()->trainee, "demonstration");
  EXPECT_EQ(model->progress(model->exercise_id, "L1").attempts, 1) << "shown to those who watch";
  EXPECT_EQ(bench.model()->progress(model->exercise_id, "L1").attempts, 0);
}

TEST(PracticeModel, AnAttemptThatWasCutOffIsNamedAtTheNextStart) {
  const PracticeBench bench;
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
  const auto model = bench.model();
  EXPECT_NE(model->notice.find("The attempt of E02 (T-5) at "), std::string::npos) << model->notice;
  EXPECT_NE(model->notice.find("was cut off"), std::string::npos);
  model->notice.clear();
  ASSERT_EQ(model->sign_in("T-5"), "");
  EXPECT_NE(model->notice.find("The attempt of E02 at "), std::string::npos) << "and to whoever it was";
  ASSERT_EQ(progress_of(*model).size(), 1u);
  EXPECT_NE(progress_of(*model).front().note.find("was cut off"), std::string::npos) << "it stays in the progress";
  ASSERT_EQ(bench.model()->notice, "") << "said once";
}

TEST(PracticeModel, TheExpertDoesWhatTheAttemptDidNotWhatTheDeskWouldDoNow) {
  const PracticeBench bench;
  const auto model = bench.model();
  model->exercise_id = "surface-touch";
  ASSERT_EQ(model->begin_attempt(), "");
  ASSERT_TRUE(model->end_attempt());
  model->organ = "phantom-abdomen";  // chosen since
  for (int i = 0; i < 9000 && model->expert_recording().empty() && model->expert_refusal().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_FALSE(model->expert_recording().empty()) << model->expert_refusal();
  const AttemptSetup own = recorded_setup(model->recording()), beside = recorded_setup(model->expert_recording());
  EXPECT_EQ(beside.organ, own.organ);
  EXPECT_EQ(beside.board, own.board);
  EXPECT_EQ(beside.seed, own.seed);
  EXPECT_EQ(beside.hand, "expert");
}

}  // namespace
}  // namespace trocar::practice_model_test
