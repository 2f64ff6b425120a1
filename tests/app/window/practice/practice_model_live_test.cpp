// The window and the instructor's desk: what is told of it, and messages: at once, quietly, never in an exam, met once.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/window/practice/practice_model.h"
#include "tests/app/window/pages/practice_bench.h"
#include "trainees/live/live_stations.h"
#include "trainees/records/assessments.h"

namespace trocar::practice_model_live_test {
namespace {

using testing_support::PracticeBench;

class PracticeModelLive : public testing::Test {
 protected:
  PracticeModelLive() { model_ = bench_.model(); }
  void send(const std::string& text) const {
    Database database(file());
    AssessmentStore(database).add_message("T-7", text, {"a-1", "Ines"});
  }
  bool waits() const {
    Database database(file());
    return AssessmentStore(database).unseen_message("T-7").has_value();
  }
  std::filesystem::path file() const { return bench_.folder.path() / "trocar.db"; }
  /// Frames until something has been said to the trainee, or for two seconds of the model's time.
  std::string notice() {
    model_->notice.clear();
    for (int i = 0; i < 40 && model_->notice.empty(); ++i) model_->pass(0.05);
    return std::exchange(model_->notice, "");
  }
  /// The moment that an instructor's desk sees of this window, once it is so.
  std::optional<LiveMoment> told(const std::string& phase) {
    for (int i = 0; i < 1000; ++i) {
      model_->pass(0.001);
      for (const LiveStation& station : look_at_stations(file()).stations)
        if (station.told.moment.phase == phase) return station.told.moment;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return std::nullopt;
  }
  void pass_level(const std::string& level) const {
    Database database(file());
    AttemptStore attempts(database);
    for (int board = 0; board < 3; ++board) {
      const Exercise& exercise = model_->exercise();
      AttemptStart start;
      start.trainee = "T-7";
      start.exercise_id = exercise.id;
      start.exercise_version = exercise.version;
      start.exercise_text = exercise.text;
      start.level = level;
      start.board = board;
      start.hand = "mouse";
      start.program = "test";
      start.recording = std::filesystem::path();
      const AttemptId id = attempts.begin_attempt(start);
      AttemptResult result;
      result.grade.status = AttemptStatus::kCompleted;
      result.grade.score = 90;
      result.grade.passed = true;
      attempts.finish_attempt(id, result);
    }
  }
  PracticeBench bench_;
  std::unique_ptr<PracticeModel> model_;
};

TEST_F(PracticeModelLive, TellsWhoIsHereAndWhatRuns) {
  ASSERT_TRUE(told("between attempts"));
  EXPECT_EQ(told("between attempts")->trainee, "") << "a guest is nobody";
  ASSERT_EQ(model_->sign_in("T-7"), "");
  for (int i = 0; i < 500 && told("between attempts")->trainee.empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(told("between attempts")->trainee, "T-7");
  ASSERT_EQ(model_->begin_attempt(), "");
  const auto moment = told("ready");
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->trainee, "T-7");
  EXPECT_EQ(moment->attempt, model_->running()->attempt());
  EXPECT_EQ(moment->exercise_id, model_->exercise_id);
  EXPECT_EQ(moment->program, "practice window");
  ASSERT_TRUE(model_->running()->pause(true));
  EXPECT_TRUE(told("paused"));
  model_->end_attempt();
  ASSERT_TRUE(told("between attempts"));
  model_.reset();
  EXPECT_TRUE(look_at_stations(file()).stations.empty()) << "closed, not crashed";
}

TEST_F(PracticeModelLive, TheTutorialIsNoAttemptForTheDesk) {
  ASSERT_EQ(model_->begin_play(Play::kTutorial), "");
  for (int i = 0; i < 500 && !model_->running()->newest().seen; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(model_->running()->newest().seen);
  EXPECT_TRUE(told("between attempts"));
  EXPECT_EQ(told("between attempts")->attempt, "");
  model_->end_attempt();
}

TEST_F(PracticeModelLive, AMessageIsShownAtOnceBetweenAttemptsAndMetOnce) {
  ASSERT_EQ(model_->sign_in("T-7"), "");
  EXPECT_EQ(notice(), "");
  send("Come and see me");
  EXPECT_EQ(notice(), "Ines writes: Come and see me");
  EXPECT_EQ(model_->teacher_note(), "Come and see me (Ines)") << "and stands on the course's page";
  EXPECT_FALSE(waits());
  EXPECT_EQ(notice(), "") << "once";
}

TEST_F(PracticeModelLive, SeveralMessagesComeInTheirOrderAndDoNotPushAnotherNoticeAway) {
  ASSERT_EQ(model_->sign_in("T-7"), "");
  send("one");
  send("two");
  model_->notice = "Moment marked";
  for (int i = 0; i < 40; ++i) model_->pass(0.05);
  EXPECT_EQ(model_->notice, "Moment marked");
  EXPECT_EQ(notice(), "Ines writes: one");
  EXPECT_EQ(notice(), "Ines writes: two");
}

TEST_F(PracticeModelLive, AMessageComesDuringAnAttemptToo) {
  ASSERT_EQ(model_->sign_in("T-7"), "");
  ASSERT_EQ(model_->begin_attempt(), "");
  send("Softer");
  EXPECT_EQ(notice(), "Ines writes: Softer");
  EXPECT_FALSE(waits());
}

TEST_F(PracticeModelLive, InAnExamItWaitsUntilItIsOver) {
  ASSERT_EQ(model_->sign_in("T-7"), "");
  const auto& levels = model_->exercise().levels;
  ASSERT_EQ(levels.back().name, kExamLevel);
  pass_level(levels[levels.size() - 2].name);
  model_->level = kExamLevel;
  ASSERT_EQ(model_->begin_attempt(), "");
  send("Third disc: from the left");
  EXPECT_EQ(notice(), "");
  EXPECT_TRUE(waits()) << "nobody has met it";
  model_->end_attempt();
  EXPECT_EQ(notice(), "Ines writes: Third disc: from the left");
  EXPECT_FALSE(waits());
}

TEST_F(PracticeModelLive, NobodyElseMeetsIt) {
  ASSERT_EQ(model_->sign_in("T-7"), "");
  model_->sign_out();
  send("for T-7 alone");
  EXPECT_EQ(notice(), "");
  ASSERT_EQ(model_->sign_in("T-8"), "");
  EXPECT_EQ(notice(), "");
  EXPECT_TRUE(waits());
  ASSERT_EQ(model_->sign_in("T-7"), "");
  EXPECT_EQ(notice(), "Ines writes: for T-7 alone");
}

TEST_F(PracticeModelLive, WhereNothingIsKeptNothingIsTold) {
  ModelOptions options = bench_.options();
  options.database = ":memory:";
  const auto model = bench_.model(options);
  model->pass(2);
  EXPECT_TRUE(model->notice.empty());
}

}  // namespace
}  // namespace trocar::practice_model_live_test
