// The window and the instructor's desk: what is told of it, and messages: at once, quietly, never in an exam, met once.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/window/practice/practice_desk.h"
#include "tests/app/window/pages/desk_bench.h"
#include "trainees/live/live_stations.h"
#include "trainees/records/assessments.h"

namespace trocar::practice_desk_live_test {
namespace {

using testing_support::DeskBench;

class PracticeDeskLive : public testing::Test {
 protected:
  PracticeDeskLive() { desk_ = bench_.desk(); }
  void send(const std::string& text) const {
    Database database(file());
    AssessmentStore(database).add_message("T-7", text, {"a-1", "Ines"});
  }
  bool waits() const {
    Database database(file());
    return AssessmentStore(database).unseen_message("T-7").has_value();
  }
  std::filesystem::path file() const { return bench_.folder.path() / "trocar.db"; }
  /// Frames until something has been said to the trainee, or for two seconds of the desk's time.
  std::string notice() {
    desk_->notice.clear();
    for (int i = 0; i < 40 && desk_->notice.empty(); ++i) desk_->pass(0.05);
    return std::exchange(desk_->notice, "");
  }
  /// The moment that an instructor's desk sees of this window, once it is so.
  std::optional<LiveMoment> told(const std::string& phase) {
    for (int i = 0; i < 1000; ++i) {
      desk_->pass(0.001);
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
      const Exercise& exercise = desk_->exercise();
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
  DeskBench bench_;
  std::unique_ptr<PracticeDesk> desk_;
};

TEST_F(PracticeDeskLive, TellsWhoIsHereAndWhatRuns) {
  ASSERT_TRUE(told("between attempts"));
  EXPECT_EQ(told("between attempts")->trainee, "") << "a guest is nobody";
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  for (int i = 0; i < 500 && told("between attempts")->trainee.empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(told("between attempts")->trainee, "T-7");
  ASSERT_EQ(desk_->begin_attempt(), "");
  const auto moment = told("ready");
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->trainee, "T-7");
  EXPECT_EQ(moment->attempt, desk_->running()->attempt());
  EXPECT_EQ(moment->exercise_id, desk_->exercise_id);
  EXPECT_EQ(moment->program, "practice window");
  ASSERT_TRUE(desk_->running()->pause(true));
  EXPECT_TRUE(told("paused"));
  desk_->end_attempt();
  ASSERT_TRUE(told("between attempts"));
  desk_.reset();
  EXPECT_TRUE(look_at_stations(file()).stations.empty()) << "closed, not crashed";
}

TEST_F(PracticeDeskLive, AMessageIsShownAtOnceBetweenAttemptsAndMetOnce) {
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  EXPECT_EQ(notice(), "");
  send("Come and see me");
  EXPECT_EQ(notice(), "Ines writes: Come and see me");
  EXPECT_EQ(desk_->teacher_note(), "Come and see me (Ines)") << "and stands on the course's page";
  EXPECT_FALSE(waits());
  EXPECT_EQ(notice(), "") << "once";
}

TEST_F(PracticeDeskLive, SeveralMessagesComeInTheirOrderAndDoNotPushAnotherNoticeAway) {
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  send("one");
  send("two");
  desk_->notice = "Moment marked";
  for (int i = 0; i < 40; ++i) desk_->pass(0.05);
  EXPECT_EQ(desk_->notice, "Moment marked");
  EXPECT_EQ(notice(), "Ines writes: one");
  EXPECT_EQ(notice(), "Ines writes: two");
}

TEST_F(PracticeDeskLive, AMessageComesDuringAnAttemptToo) {
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  ASSERT_EQ(desk_->begin_attempt(), "");
  send("Softer");
  EXPECT_EQ(notice(), "Ines writes: Softer");
  EXPECT_FALSE(waits());
}

TEST_F(PracticeDeskLive, InAnExamItWaitsUntilItIsOver) {
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  const auto& levels = desk_->exercise().levels;
  ASSERT_EQ(levels.back().name, kExamLevel);
  pass_level(levels[levels.size() - 2].name);
  desk_->level = kExamLevel;
  ASSERT_EQ(desk_->begin_attempt(), "");
  send("Third disc: from the left");
  EXPECT_EQ(notice(), "");
  EXPECT_TRUE(waits()) << "nobody has met it";
  desk_->end_attempt();
  EXPECT_EQ(notice(), "Ines writes: Third disc: from the left");
  EXPECT_FALSE(waits());
}

TEST_F(PracticeDeskLive, NobodyElseMeetsIt) {
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  desk_->sign_out();
  send("for T-7 alone");
  EXPECT_EQ(notice(), "");
  ASSERT_EQ(desk_->sign_in("T-8"), "");
  EXPECT_EQ(notice(), "");
  EXPECT_TRUE(waits());
  ASSERT_EQ(desk_->sign_in("T-7"), "");
  EXPECT_EQ(notice(), "Ines writes: for T-7 alone");
}

TEST_F(PracticeDeskLive, WhereNothingIsKeptNothingIsTold) {
  DeskOptions options = bench_.options();
  options.database = ":memory:";
  const auto desk = bench_.desk(options);
  desk->pass(2);
  EXPECT_TRUE(desk->notice.empty());
}

}  // namespace
}  // namespace trocar::practice_desk_live_test
