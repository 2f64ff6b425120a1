// A person's decision holds wherever passes count; the score stays; what the device ended is never passed.
#include "trainees/records/verdicts.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/progress/learning_curve.h"
#include "trainees/progress/unlock.h"
#include "trainees/records/cohort.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::verdicts_test {
namespace {

constexpr const char* kReason = "The stand slipped in the middle of it";

class Verdicts : public testing::Test {
 protected:
  AttemptId attempt(double score, int board = 0, AttemptStatus status = AttemptStatus::kCompleted) {
    AttemptStart start = sample_start("T-1");
    start.board = board;
    AttemptResult result = sample_result(score);
    result.grade.status = status;
    if (status == AttemptStatus::kVoid || status == AttemptStatus::kAborted) result.grade.score.reset();
    if (!result.grade.score) result.grade.passed = false;
    return store_attempt(database_, start, result);
  }
  void decide(const AttemptId& id, bool passed, const std::string& by = "Dr B") {
    assessments_.override_verdict(id.uuid, passed, kReason, {"0192-b", by});
  }
  AttemptSummary summary(const AttemptId& id) { return store_.find(id.uuid); }

  Database database_{":memory:"};
  AttemptStore store_{database_};
  AssessmentStore assessments_{database_};
};

TEST(JudgedPassed, IsTheScoreUnlessSomebodyDecidedAndNeverWhatTheDeviceEnded) {
  EXPECT_TRUE(judged_passed(false, true, {}));
  EXPECT_FALSE(judged_passed(false, false, {}));
  EXPECT_TRUE(judged_passed(false, false, true));
  EXPECT_FALSE(judged_passed(false, true, false));
  EXPECT_FALSE(judged_passed(true, true, true));
  EXPECT_FALSE(verdict_of(AttemptStatus::kFault, true, {}).passed);
  EXPECT_TRUE(verdict_of(AttemptStatus::kAborted, false, VerdictOverride{"u", "", "Dr B", kReason, "", true}).passed);
}

TEST_F(Verdicts, TheNewestHoldsInEveryListAndTheScoreStays) {
  const AttemptId failed = attempt(60), passed = attempt(90);
  EXPECT_FALSE(summary(failed).passed);
  decide(failed, true, "Dr A");
  decide(passed, false);
  EXPECT_TRUE(summary(failed).passed);
  EXPECT_FALSE(summary(failed).passed_by_score);
  EXPECT_EQ(summary(failed).decided_by, "Dr A");
  EXPECT_EQ(summary(failed).score, 60);
  EXPECT_FALSE(store_.list().front().passed);
  EXPECT_TRUE(store_.list().front().passed_by_score);
  EXPECT_FALSE(store_.latest()->passed);
  EXPECT_FALSE(store_.load(failed.row).grade.passed) << "the result is the score's";
  decide(failed, false);
  decide(failed, true, "Dr C");
  EXPECT_TRUE(summary(failed).passed);
  EXPECT_EQ(summary(failed).decided_by, "Dr C");
  EXPECT_EQ(verdict_of(database_, store_.load(failed.row)).decision->printed, "Dr C");
  EXPECT_EQ(newest_decisions(database_), (std::map<std::int64_t, bool>{{failed.row, true}, {passed.row, false}}));
}

/// The decision as a machine writes it whose clock says something else. @param uuid with which it begins.
void redate(Database& database, const std::string& by, const std::string& uuid) {
  sql::execute(database.connection(),
               "DROP TRIGGER IF EXISTS audit_no_update; DROP TRIGGER IF EXISTS verdict_override_no_update");
  const std::string of_by = " WHERE printed = '" + by + "'";
  sql::execute(database.connection(),
               ("UPDATE audit SET subject = '" + uuid +
                "' || substr(subject, 5) WHERE subject = (SELECT uuid FROM verdict_override" + of_by +
                "); UPDATE verdict_override SET uuid = '" + uuid + "' || substr(uuid, 5)" + of_by)
                   .c_str());
  const std::string given = sql::query_text(database.connection(), "SELECT uuid FROM verdict_override" + of_by);
  sql::Statement(database.connection(), "UPDATE audit SET detail = ? WHERE subject = ?")
      .bind(digest_of_row(database.connection(), "verdict_override", given))
      .bind(given)
      .run();
}

TEST_F(Verdicts, TheLastOneHoldsThoughTheClockWasSetBack) {
  const AttemptId id = attempt(60);
  decide(id, true, "Dr A");
  redate(database_, "Dr A", "0fff");
  decide(id, false, "Dr B");
  decide(id, true, "Dr C");
  const auto all = assessments_.overrides_of(id.uuid);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].printed + all[1].printed + all[2].printed, "Dr CDr BDr A");
  EXPECT_GT(all[0].uuid, all[1].uuid) << "the same order by UUID, which other databases go by";
  EXPECT_GT(all[1].uuid, all[2].uuid);
  EXPECT_EQ(summary(id).decided_by, "Dr C");
  EXPECT_EQ(newest_decisions(database_), (std::map<std::int64_t, bool>{{id.row, true}}));
}

/// A program that knew no better gave the later decision the smaller UUID.
TEST_F(Verdicts, TheTrailOrdersWhatAnOlderProgramWroteUnderAClockThatWasSetBack) {
  const AttemptId id = attempt(60);
  decide(id, true, "Dr A");
  decide(id, false, "Dr B");
  redate(database_, "Dr B", "0100");
  EXPECT_EQ(assessments_.overrides_of(id.uuid).front().printed, "Dr B");
  EXPECT_FALSE(summary(id).passed);
  EXPECT_EQ(newest_decisions(database_), (std::map<std::int64_t, bool>{{id.row, false}}));
  sql::execute(database_.connection(),
               "UPDATE audit SET actor = 'centre' WHERE position = (SELECT max(position) FROM audit)");
  EXPECT_EQ(assessments_.overrides_of(id.uuid).front().printed, "Dr A")
      << "of one that came from elsewhere the UUID says when, the same everywhere";
}

/// Else whoever may write the file decides in anybody's name, until somebody checks the record.
TEST_F(Verdicts, ADecisionThatSomebodyWroteIntoTheFileCountsNowhere) {
  const AttemptId one = attempt(60);
  sql::execute(database_.connection(),
               "INSERT INTO verdict_override (uuid, attempt_id, row_hash, author, printed, passed, reason, utc) SELECT"
               " '0190aaaa-0000-7000-8000-000000000001', id, row_hash, '', 'Dr A', 1, 'Seen by me: clean work', '' FROM"
               " attempt");
  EXPECT_FALSE(summary(one).passed);
  EXPECT_FALSE(verdict_of(database_, store_.load(one.row)).passed);
  EXPECT_TRUE(newest_decisions(database_).empty());
  EXPECT_TRUE(assessments_.overrides_of(one.uuid).empty());
  decide(one, true, "Dr B");
  EXPECT_TRUE(summary(one).passed);
  EXPECT_EQ(summary(one).decided_by, "Dr B");
}

TEST_F(Verdicts, CountsOfPassesFollow) {
  const AttemptId failed = attempt(60);
  attempt(90);
  EXPECT_EQ(TraineeStore(database_).find("T-1")->passes, 1);
  decide(failed, true);
  EXPECT_EQ(TraineeStore(database_).find("T-1")->passes, 2);
  EXPECT_EQ(TraineeStore(database_).list().front().passes, 2);
  ASSERT_EQ(cohort(database_).size(), 1u);
  EXPECT_EQ(cohort(database_).front().passes, 2);
  EXPECT_EQ(cohort(database_).front().best, 90);
}

TEST_F(Verdicts, RowsOfPassesAndTheNextLevelFollow) {
  const AttemptId middle = [&] {
    attempt(90, 1);
    const AttemptId id = attempt(60, 2);
    attempt(91, 3);
    return id;
  }();
  EXPECT_FALSE(opens_next(store_.list()));
  EXPECT_EQ(passes_in_a_row(store_.list()), 1);
  decide(middle, true);
  EXPECT_TRUE(opens_next(store_.list()));
  EXPECT_EQ(passes_in_a_row(store_.list()), 3);
  decide(middle, false);
  EXPECT_FALSE(opens_next(store_.list()));
  const LearningCurve curve = learning_curves(past_attempts(database_, "T-1")).front();
  EXPECT_EQ(curve.passed, 2);
  EXPECT_EQ(curve.in_a_row, 1);
  EXPECT_EQ(curve.passes(), (std::vector<bool>{true, false, true}));
}

TEST_F(Verdicts, TheFileOfOnesOwnAttemptsHasBothVerdicts) {
  decide(attempt(60), true, "=Dr A");
  const std::string csv = attempts_csv(past_attempts(database_, "T-1"));
  EXPECT_NE(csv.find(",score,passed,passed_by_score,decided_by,decided_utc,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",60,1,0,'=Dr A,2"), std::string::npos) << csv;
}

TEST_F(Verdicts, AnAttemptThatWasLeftCanBeDecidedOneThatTheDeviceEndedCannot) {
  const AttemptId left = attempt(0, 0, AttemptStatus::kAborted), broken = attempt(0, 1, AttemptStatus::kVoid);
  decide(left, true);
  EXPECT_TRUE(summary(left).passed);
  EXPECT_NE(message_of<InputError>([&] { decide(broken, true); }).find("ended by the device or is void"),
            std::string::npos);
  EXPECT_TRUE(assessments_.overrides_of(broken.uuid).empty());
}

TEST_F(Verdicts, ACertificateCitesNoAttemptThatIsNotPassed) {
  const AttemptId good = attempt(90), other = store_attempt(database_, sample_start("T-2"), sample_result(90));
  const auto certify = [&](const AttemptId& id) {
    return message_of<InputError>([&] {
      assessments_.certify("T-1", "surface-touch", "L1", "1", "{\"attempt\":\"" + id.uuid + "\"}", {"0192-b", "Dr B"});
    });
  };
  decide(good, false, "Dr A");
  EXPECT_NE(certify(good).find("is not passed by decision of Dr A"), std::string::npos) << certify(good);
  EXPECT_NE(certify(other).find("none of this trainee's"), std::string::npos);
  EXPECT_NE(certify(attempt(40)).find("is not passed, so"), std::string::npos);
  EXPECT_TRUE(assessments_.certificates_of("").empty());
  decide(good, true);
  EXPECT_EQ(certify(good), "");
  EXPECT_EQ(assessments_.certificates_of("T-1").size(), 1u);
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
}

TEST_F(Verdicts, AttemptsAreFoundByNumberIdentifierAndItsParts) {
  AttemptId last;
  for (int i = 0; i < 12; ++i) last = attempt(80, i);
  EXPECT_EQ(store_.find("12").uuid, last.uuid);
  EXPECT_EQ(store_.find("3").row, 3);
  EXPECT_EQ(store_.find(last.uuid).row, 12);
  EXPECT_EQ(store_.find(last.uuid.substr(24)).row, 12);
  EXPECT_NE(message_of<InputError>([&] { store_.find("13"); }).find("no attempt of this database has that number"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { store_.find("999999"); }).find("neither as a number nor in an identifier"),
            std::string::npos);
  for (const char* none : {"0", "012", "", "1 OR 1=1", "-1", "99999999999999999999"})
    EXPECT_THROW(store_.find(none), InputError) << none;
}

TEST_F(Verdicts, AnInventedAttemptEndsByItsOwnClock) {
  AttemptStart start = sample_start("T-1");
  start.started_utc = "2026-03-01T09:00:00.000Z";
  const AttemptId id = store_.begin_attempt(start);
  EXPECT_THROW(store_.finish_attempt(id, sample_result(), "2026-03-01T08:59:59.000Z"), InputError);
  store_.finish_attempt(id, sample_result(), "2026-03-01T09:01:00.000Z");
  EXPECT_EQ(summary(id).status, "completed");
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
}

}  // namespace
}  // namespace trocar::verdicts_test
