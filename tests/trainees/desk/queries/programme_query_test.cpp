// The grid of people and steps, and who is late: who has a programme, what counts, and the clock that is given.
#include "trainees/desk/queries/programme_query.h"

#include "haptics/input_error.h"
#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/assessments.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/cohort.h"
#include "trainees/records/erasure.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::programme_query_test {
namespace {

const Author kAuthor{"", "Ida Adler"};
constexpr const char* kTwoSteps =
    "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\npasses = 2\ndays = 2\n"
    "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L2\"\nsign_off = true\n";

class ProgrammeQuery : public TemporaryFolder {
 protected:
  ProgrammeQuery() {
    for (const char* code : {"T-1", "T-2", "T-3"}) TraineeStore(database_).ensure_trainee(code);
    for (const char* code : {"T-1", "T-2"}) CurriculumStore(database_).join(code, "2026 A", kAuthor);
    store_.save("Basics", kTwoSteps, kAuthor);
  }
  std::string attempt(const char* code, const char* level, double score, const char* day, const char* hand = "mouse",
                      AttemptStatus status = AttemptStatus::kCompleted) {
    AttemptStart start = sample_start(code);
    start.level = level;
    start.hand = hand;
    start.started_utc = std::string(day) + "T10:00:00.000Z";
    AttemptResult result = sample_result(score);
    result.grade.passed = score >= 75;
    result.grade.status = status;
    return store_attempt(database_, start, result).uuid;
  }
  ProgrammeGrid grid(const GridFilter& filter = {}, const char* now = "2030-01-01T12:00:00Z") {
    return programme_grid(database_, "Basics", filter, now);
  }
  /// "T-1 learning not-started; ..." of those whom the grid has.
  std::string said(const GridFilter& filter = {}, const char* now = "2030-01-01T12:00:00Z") {
    std::string out;
    for (const ProgrammeLine& line : grid(filter, now).lines) {
      out += (out.empty() ? "" : "; ") + line.code;
      for (const ProgrammeCell& cell : line.cells) out += std::string(" ") + step_state_key(cell.state);
    }
    return out;
  }
  Database database_{folder_ / "q.db"};
  ProgrammeStore store_{database_};
};

TEST_F(ProgrammeQuery, HasThoseToWhomItIsAssignedAlsoWhoJoinsLater) {
  EXPECT_EQ(said(), "");
  const Assignment given = store_.assign("Basics", "", "2026 A", "", kAuthor);
  EXPECT_EQ(said(), "T-1 not-started not-started; T-2 not-started not-started");
  CurriculumStore(database_).join("T-3", "2026 A", kAuthor);
  EXPECT_EQ(grid().lines.size(), 3U);
  CurriculumStore(database_).leave("T-1", "2026 A", kAuthor);
  EXPECT_EQ(grid().lines.size(), 2U);
  store_.withdraw(given.uuid, "", kAuthor);
  EXPECT_EQ(said(), "");
  EXPECT_THROW(programme_grid(database_, "Other", {}, "2030-01-01T12:00:00Z"), InputError);
  EXPECT_THROW(grid({}, "yesterday"), InputError);
}

TEST_F(ProgrammeQuery, StatesFollowAttemptsDecisionsAndCertificates) {
  store_.assign("Basics", "", "2026 A", "2029-12-31", kAuthor);
  attempt("T-1", "L1", 80, "2026-03-01");
  attempt("T-1", "L1", 60, "2026-03-02");
  EXPECT_EQ(said({}, "2029-12-31T23:59:59Z"), "T-1 learning not-started; T-2 not-started not-started");
  EXPECT_EQ(said({}, "2030-01-01T00:00:00Z"), "T-1 overdue overdue; T-2 overdue overdue");
  const std::string last = attempt("T-1", "L1", 60, "2026-03-03", "device");
  AssessmentStore assessments(database_);
  assessments.override_verdict(last, true, "the camera was knocked", {"0192-account", "Ida Adler"});
  attempt("T-1", "L2", 90, "2026-03-04");
  attempt("T-2", "L2", 90, "2026-03-04", "mouse", AttemptStatus::kFault);
  EXPECT_EQ(said({}, "2029-12-31T12:00:00Z"), "T-1 passed to-sign; T-2 not-started learning")
      << "what the device ended is never a pass, but was tried";
  const std::string certificate =
      assessments.certify("T-1", "surface-touch", "L2", "1", "{}", {"0192-account", "Ida Adler"}).uuid;
  EXPECT_EQ(said({"", "t-1"}), "T-1 passed certified");
  assessments.revoke(certificate, "given by mistake", {"0192-account", "Ida Adler"});
  EXPECT_EQ(said({"", "T-1"}), "T-1 passed to-sign");
  const ProgrammeCell cell = grid().lines[0].cells[0];
  EXPECT_EQ(cell.progress.attempts, 3);
  EXPECT_EQ(cell.progress.passes, 2);
  EXPECT_EQ(due_day(*cell.due_s), "2029-12-31");
}

TEST_F(ProgrammeQuery, ACertificateInQuestionIsNoneUntilSomebodyHasLooked) {
  const Author ida{"0192-account", "Ida Adler"};
  store_.assign("Basics", "T-1", "", "", kAuthor);
  const std::string passed = attempt("T-1", "L2", 90, "2026-03-04");
  AssessmentStore assessments(database_);
  assessments.certify("T-1", "surface-touch", "L2", "1", R"({"attempts": [")" + passed + R"("]})", ida);
  ASSERT_EQ(said(), "T-1 not-started certified");
  assessments.override_verdict(passed, false, "the camera was knocked", ida);
  EXPECT_EQ(said(), "T-1 not-started learning") << "as the cohort says";
}

TEST_F(ProgrammeQuery, WhatAScriptedHandDidIsNobodysPass) {
  store_.assign("Basics", "T-1", "", "", kAuthor);
  for (const char* day : {"2026-03-01", "2026-03-02"}) attempt("T-1", "L1", 100, day, "expert");
  EXPECT_EQ(said(), "T-1 not-started not-started");
  EXPECT_EQ(said({"", "T-1"}), "T-1 not-started not-started");
  for (const char* day : {"2026-03-03", "2026-03-04"}) attempt("T-1", "L1", 100, day, "device");
  EXPECT_EQ(said(), "T-1 passed not-started");
}

TEST_F(ProgrammeQuery, OneAlikeByEitherWay) {
  test::CohortPlan plan;
  plan.trainees = 6;
  plan.attempts = 240;
  Database other(folder_ / "many.db");
  test::fill_cohort(other, plan);
  std::string text;
  for (const char* exercise : {"reach-and-orient", "surface-touch", "limited-grasp"})
    for (const char* level : {"L1", "L2", "L3"})
      for (const char* rule : {"passes = 2\n", "passes = 3\nin_a_row = true\ninput = \"mouse\"\n"})
        text += std::string("[[step]]\nexercise = \"") + exercise + "\"\nlevel = \"" + level + "\"\n" + rule;
  ProgrammeStore(other).save("All", text, kAuthor);
  for (const char* group : {"2026 A", "2026 B"}) ProgrammeStore(other).assign("All", "", group, "2026-06-30", kAuthor);
  const ProgrammeGrid all = programme_grid(other, "All", {}, "2026-07-01T12:00:00Z");
  ASSERT_EQ(all.lines.size(), 6U);
  int passed = 0, tried = 0;
  for (const ProgrammeLine& line : all.lines) {
    const ProgrammeGrid one = programme_grid(other, "All", {"", line.code, false}, "2026-07-01T12:00:00Z");
    ASSERT_EQ(one.lines.size(), 1U);
    for (std::size_t at = 0; at < line.cells.size(); ++at) {
      EXPECT_EQ(one.lines[0].cells[at].state, line.cells[at].state) << line.code << at;
      EXPECT_EQ(one.lines[0].cells[at].progress.passes, line.cells[at].progress.passes) << line.code << at;
      EXPECT_EQ(one.lines[0].cells[at].progress.reached_s, line.cells[at].progress.reached_s) << line.code << at;
      passed += line.cells[at].state == StepState::kPassed ? 1 : 0;
      tried += line.cells[at].progress.attempts;
    }
  }
  EXPECT_GT(passed, 0);
  EXPECT_GT(tried, 240) << "each level stands twice";
}

TEST_F(ProgrammeQuery, WhoIsDeactivatedIsLeftOutUnlessAskedFor) {
  store_.assign("Basics", "", "2026 A", "", kAuthor);
  attempt("T-1", "L1", 80, "2026-03-01");
  attempt("T-2", "L1", 80, "2026-03-01");
  StandingStore(database_).set_active({"T-2"}, false, "left", kAuthor);
  EXPECT_EQ(grid().lines.size(), 1U);
  EXPECT_EQ(grid({"", "", true}).lines.size(), 2U);
  EXPECT_FALSE(grid({"", "T-2", false}).lines.at(0).active);
  const auto lines = [&](const CohortFilter& filter) {
    return cohort_lines(database_, {}, filter, "2026-07-01T12:00:00Z");
  };
  EXPECT_EQ(lines({}).size(), 1U);
  EXPECT_EQ(lines({.deactivated = true}).size(), 2U);
  EXPECT_EQ(lines({.trainee = "T-2"}).size(), 1U);
  EXPECT_EQ(cohort(database_).size(), 1U);
  EXPECT_EQ(cohort(database_, "", true).size(), 2U);
  EXPECT_EQ(cohort(database_, "T-2").size(), 1U);
  erase_trainee(database_, "T-1", ErasureKind::kTraining, "request", kAuthor);
  EXPECT_EQ(said(), "");
}

TEST_F(ProgrammeQuery, RemindersAreThoseLateAndDueSoonAndEndAtTheGivenDay) {
  store_.assign("Basics", "", "2026 A", "2026-06-30", kAuthor);
  attempt("T-1", "L1", 80, "2026-03-01");
  attempt("T-2", "L2", 80, "2026-03-01");
  const auto late = [&](int days, const char* now) { return reminders(database_, "", "", days, now); };
  EXPECT_TRUE(late(14, "2026-06-15T12:00:00Z").empty());
  const auto soon = late(14, "2026-06-16T00:00:00Z");
  ASSERT_EQ(soon.size(), 3U) << "T-2 waits for a signature, which is not theirs to give";
  EXPECT_EQ(soon[0].code, "T-1");
  EXPECT_EQ(soon[0].days, 14);
  EXPECT_EQ(soon[0].state, StepState::kLearning);
  EXPECT_EQ(soon[0].missing, "1 of 2 passes, 1 of 2 days");
  EXPECT_EQ(late(0, "2026-06-30T23:00:00Z").at(0).days, 0);
  const auto over = late(0, "2026-07-03T01:00:00Z");
  EXPECT_EQ(over.at(0).days, -3);
  EXPECT_EQ(over.at(0).state, StepState::kOverdue);
  EXPECT_EQ(over.at(0).due, "2026-06-30");
  EXPECT_TRUE(reminders(database_, "", "2026 B", 9999, "2026-07-03T01:00:00Z").empty());
  EXPECT_TRUE(reminders(database_, "Other", "", 9999, "2026-07-03T01:00:00Z").empty());
}

TEST_F(ProgrammeQuery, TheStepsOwnDaysCountFromJoiningAndThePersonsAssignmentGoesFirst) {
  const std::string now = utc_now();
  store_.save("Basics", "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\ndue_days = 10\n", kAuthor);
  store_.assign("Basics", "", "2026 A", "", kAuthor);
  // As if it had been given, and T-1 had joined, long ago; T-2 joined today.
  sql::execute(database_.connection(),
               "DROP TRIGGER assignment_no_update; DROP TRIGGER audit_no_update;"
               "UPDATE assignment SET utc = '2020-01-01T10:00:00.000Z';"
               "UPDATE audit SET utc = '2020-03-01T10:00:00.000Z' WHERE action = 'group joined'"
               " AND subject = (SELECT uuid FROM known_trainee WHERE code = 'T-1')");
  seal_row(database_.connection(), "assignment", sql::query_text(database_.connection(), "SELECT uuid FROM assignment"),
           "");
  const ProgrammeGrid both = grid({}, now.c_str());
  EXPECT_EQ(due_day(*both.lines[0].cells[0].due_s), "2020-03-11");
  EXPECT_EQ(both.lines[0].cells[0].state, StepState::kOverdue);
  EXPECT_EQ(both.lines[1].cells[0].state, StepState::kNotStarted) << "ten days from now";
  store_.assign("Basics", "T-1", "", "2031-01-01", kAuthor);
  EXPECT_EQ(grid({}, now.c_str()).lines[0].through, "");
  EXPECT_EQ(grid({}, now.c_str()).lines[0].cells[0].state, StepState::kNotStarted) << "given anew today";
}

TEST_F(ProgrammeQuery, NextStepsAreDatedOnesFirstAndOneOfEachProgramme) {
  store_.save("Later", kTwoSteps, kAuthor);
  store_.assign("Later", "T-1", "", "", kAuthor);
  EXPECT_EQ(next_steps(database_, "T-1", "2026-05-01T12:00:00Z").size(), 1U);
  store_.assign("Basics", "", "2026 A", "2026-06-30", kAuthor);
  const auto steps = next_steps(database_, "T-1", "2026-05-01T12:00:00Z");
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].programme, "Basics");
  EXPECT_EQ(steps[2].programme, "Later");
  EXPECT_EQ(steps[2].due, "");
  EXPECT_TRUE(next_steps(database_, "T-3", "2026-05-01T12:00:00Z").empty());
}

}  // namespace
}  // namespace trocar::programme_query_test
