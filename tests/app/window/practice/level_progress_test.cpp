#include "app/window/practice/level_progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "trainees/progress/programme.h"

namespace trocar::level_progress_test {
namespace {

AttemptSummary attempt(int board, bool passed, const std::string& status = "completed",
                       const std::string& level = "L1") {
  AttemptSummary a;
  a.board = board;
  a.passed = passed;
  a.status = status;
  a.level = level;
  if (status == "completed") a.score = passed ? 80 : 40;
  return a;
}

Exercise with_levels() {
  Exercise e;
  e.id = "e";
  for (const char* name : {"L1", "L2", "L3"}) {
    ExerciseLevel level;
    level.name = name;
    e.levels.push_back(level);
  }
  return e;
}

TEST(PassesInARow, CountFromTheNewestToTheFirstFailure) {
  EXPECT_EQ(passes_in_a_row({}), 0);
  EXPECT_EQ(passes_in_a_row({attempt(1, true), attempt(2, true), attempt(3, false), attempt(4, true)}), 2);
  EXPECT_EQ(passes_in_a_row({attempt(1, false), attempt(2, true)}), 0);
}

TEST(PassesInARow, CountABoardOnce) {
  EXPECT_EQ(passes_in_a_row({attempt(1, true), attempt(1, true), attempt(2, true)}), 2);
}

TEST(PassesInARow, AnAttemptThatWasLeftEndsTheRow) {
  EXPECT_EQ(passes_in_a_row({attempt(1, true), attempt(2, false, "aborted"), attempt(3, true)}), 1);
}

TEST(PassesInARow, WhatEndedBeforeItsClockBeganDoesNotCount) {
  for (const char* status : {"fault", "void"}) {
    AttemptSummary ended = attempt(2, false, status);
    EXPECT_EQ(passes_in_a_row({attempt(1, true), ended, attempt(4, true)}), 1) << "it can be brought about";
    ended.begun = false;
    EXPECT_EQ(passes_in_a_row({attempt(1, true), ended, attempt(4, true)}), 2);
  }
  EXPECT_EQ(passes_in_a_row({attempt(9, false, "running"), attempt(4, true)}), 1);
}

TEST(OpensNext, StaysOpenAfterALaterFailure) {
  EXPECT_TRUE(opens_next({attempt(9, false), attempt(1, true), attempt(2, true), attempt(3, true)}));
  EXPECT_FALSE(opens_next({attempt(1, true), attempt(2, true), attempt(2, true)}));
  EXPECT_FALSE(opens_next({attempt(1, true), attempt(2, true), attempt(9, false), attempt(3, true)}));
}

TEST(LevelProgressOf, FirstLevelIsOpenTheNextWaitsForThreePasses) {
  const Exercise e = with_levels();
  EXPECT_TRUE(level_progress(e, "L1", {}).unlocked);
  EXPECT_FALSE(level_progress(e, "L2", {}).unlocked);
  const std::vector<AttemptSummary> three{attempt(1, true), attempt(2, true), attempt(3, true)};
  EXPECT_TRUE(level_progress(e, "L2", three).unlocked);
  EXPECT_FALSE(level_progress(e, "L3", three).unlocked) << "passes at L1 open L2, not L3";
}

TEST(LevelProgressOf, AnEditedRubricOpensNothing) {
  Exercise e = with_levels();
  e.rubric.sha256 = "own";
  e.former_rubrics = {{"version 1", "2026-11-27"}};
  struct Row {
    const char *rubric, *started_utc;
    bool counts;
  };
  for (const Row& row : {Row{"own", "2027-01-01T00:00:00Z", true},
                         {"version 1", "2026-11-26T23:59:59Z", true},
                         {"version 1", "2026-11-27T00:00:00Z", false},
                         {"pass_at = 5", "2026-11-01T00:00:00Z", false},
                         {"", "", false}}) {
    std::vector<AttemptSummary> three{attempt(1, true), attempt(2, true), attempt(3, true)};
    for (AttemptSummary& one : three) one.rubric_sha256 = row.rubric, one.started_utc = row.started_utc;
    EXPECT_EQ(level_progress(e, "L2", three).unlocked, row.counts) << row.rubric << row.started_utc;
    EXPECT_EQ(level_progress(e, "L1", three).passed_in_a_row, row.counts ? 3 : 0) << row.rubric << row.started_utc;
  }
}

TEST(LevelProgressOf, KeepsLevelsApartAndKnowsBestAndLast) {
  std::vector<AttemptSummary> all{attempt(1, false), attempt(2, true), attempt(3, true, "completed", "L2"),
                                  attempt(4, false, "aborted")};
  all[1].score = 91;
  const LevelProgress s = level_progress(with_levels(), "L1", all);
  EXPECT_EQ(s.attempts, 3);
  EXPECT_EQ(s.passed, 1);
  EXPECT_EQ(s.best, 91);
  EXPECT_EQ(s.last, 40);
  EXPECT_EQ(s.newest_first.size(), 3U);
}

TEST(LevelProgressOf, WithoutAGradeThereIsNoScore) {
  const LevelProgress s = level_progress(with_levels(), "L1", {attempt(1, false, "aborted")});
  EXPECT_FALSE(s.best || s.last);
  EXPECT_EQ(s.attempts, 1);
}

TEST(NextStep, AllExercisesAtALevelComeBeforeTheNextLevelAndGuestsBeginWithTouch) {
  std::vector<Exercise> all(2);
  all[0].id = "reach";
  all[0].kind = ExerciseKind::kReach;
  all[1].id = "touch";
  all[1].kind = ExerciseKind::kTouch;
  for (Exercise& e : all) {
    e.levels.resize(2);
    e.levels[0].name = "L1";
    e.levels[1].name = "L2";
  }
  std::set<std::string> passed;
  const auto progress = [&](const Exercise& e, const std::string& level) {
    LevelProgress s;
    s.unlocked = level == "L1" || passed.count(e.id + "L1") > 0;
    for (int board = 0; board < 3 && passed.count(e.id + level) > 0; ++board) {
      AttemptSummary one;
      one.level = level;
      one.board = board;
      one.status = "completed";
      one.passed = true;
      s.newest_first.push_back(one);
    }
    return s;
  };
  const auto next = [&](bool guest) {
    const auto found = next_step(practice_order(all, guest), progress);
    return found ? found->exercise->id + found->level : "all passed";
  };
  EXPECT_EQ(next(false), "reachL1");
  EXPECT_EQ(next(true), "touchL1");
  passed.insert("touchL1");
  EXPECT_EQ(next(false), "reachL1");
  EXPECT_EQ(next(true), "reachL1");
  passed.insert("reachL1");
  EXPECT_EQ(next(false), "reachL2");
  passed.insert({"reachL2", "touchL2"});
  EXPECT_EQ(next(false), "all passed");
}

TEST(ScriptedHands, AreTheOnesThatNoInputIs) {
  AttemptSummary one;
  for (const char* hand : {"mouse", "keyboard", "gamepad", "spacemouse", "device", ""}) {
    one.hand = hand;
    EXPECT_FALSE(by_scripted_hand(one)) << hand;
    if (one.hand.empty()) continue;
    EXPECT_TRUE(std::count(std::begin(kPersonsInputs), std::end(kPersonsInputs), one.hand))
        << hand << ": in programmes";
  }
  for (const char* hand : {"expert", "novice", "my/script.toml"}) {
    one.hand = hand;
    EXPECT_TRUE(by_scripted_hand(one)) << hand;
  }
}

}  // namespace
}  // namespace trocar::level_progress_test
