// What a certificate stands on, and what puts it in question: later decisions, not earlier ones, and no clock.
#include "trainees/records/certificate_standing.h"

#include <nlohmann/json.hpp>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::certificate_standing_test {
namespace {

using nlohmann::json;

constexpr const char* kReason = "The stand slipped in the middle of it";

class Standing : public testing::Test {
 protected:
  Standing() {
    for (const double score : {90., 60., 92.}) attempts_.push_back(attempt(score));
  }
  AttemptId attempt(double score) {
    AttemptStart start = sample_start("T-1");
    start.board = ++board_;
    return store_attempt(database_, start, sample_result(score));
  }
  VerdictOverride decide(std::size_t which, bool passed, const std::string& by = "Dr B") {
    return said_.override_verdict(attempts_[which].uuid, passed, kReason, {"", by});
  }
  Certificate certify(json evidence) {
    evidence["attempt"] = attempts_[2].uuid;
    return said_.certify("T-1", "surface-touch", "L1", "1", evidence.dump(), {"", "Ida Adler"});
  }
  /// As the desk does. @param known decisions at that moment.
  Certificate certify_with(const std::vector<std::pair<std::size_t, VerdictOverride>>& known = {}) {
    json decisions = json::array();
    for (const auto& [which, decision] : known)
      decisions.push_back({{"attempt", attempts_[which].uuid},
                           {"decision", decision.uuid},
                           {"passed", decision.passed},
                           {"by", decision.printed}});
    return certify({{"overrides", decisions}, {"attempts", attempts_of_curve(database_, attempts_[2].uuid)}});
  }
  std::string doubt(const Certificate& certificate) {
    std::string why = standing_of(database_, certificate).in_question;
    if (!why.empty()) {
      EXPECT_FALSE(certificates_beyond_doubt(database_).contains(certificate.uuid)) << why;
    }
    return why;
  }

  int board_ = 0;
  Database database_{":memory:"};
  AssessmentStore said_{database_};
  std::vector<AttemptId> attempts_;
};

/// On paper it would be as good as any.
TEST_F(Standing, OfOneThatSomebodyWroteIntoTheFileIsInQuestion) {
  Certificate given = certify_with();
  ASSERT_EQ(doubt(given), "");
  EXPECT_TRUE(certificates_beyond_doubt(database_).contains(given.uuid));
  given.uuid = "0190aaaa-0000-7000-8000-000000000001";
  sql::execute(
      database_.connection(),
      ("INSERT INTO certificate (uuid, trainee_id, exercise_id, level, rule_version, evidence, author, printed,"
       " utc) SELECT '" +
       given.uuid +
       "', trainee_id, exercise_id, level, rule_version, evidence, author, printed, utc FROM"
       " certificate")
          .c_str());
  EXPECT_NE(doubt(given).find("not signed with the station's key"), std::string::npos);
}

TEST_F(Standing, OnAnotherPersonsAttemptIsInQuestion) {
  const Certificate given = certify_with();
  TraineeStore(database_).ensure_trainee("T-2");
  std::vector<std::string> triggers;
  sql::Statement names(database_.connection(), "SELECT name FROM sqlite_schema WHERE type = 'trigger'");
  while (names.step()) triggers.push_back(names.text(0));
  for (const std::string& name : triggers) sql::execute(database_.connection(), ("DROP TRIGGER " + name).c_str());
  sql::execute(database_.connection(), "UPDATE attempt SET trainee_id = 2 WHERE id = 1");
  EXPECT_NE(doubt(given).find("is another person's"), std::string::npos) << doubt(given);
}

TEST_F(Standing, IsThatOfTheAttemptsOnItsCurve) {
  const Certificate given = certify_with();
  attempt(95);
  const CertificateStanding standing = standing_of(database_, given);
  EXPECT_EQ(standing.cited, attempts_[2].uuid);
  ASSERT_EQ(standing.attempts.size(), 3U) << "what came after it is none of them";
  EXPECT_TRUE(standing.attempts[0].passed_then && standing.attempts[0].passed_now);
  EXPECT_FALSE(standing.attempts[1].passed_then || standing.attempts[1].passed_now);
  EXPECT_EQ(standing.in_question, "");
}

TEST_F(Standing, IsInQuestionOnceAnAttemptWasDecidedNotPassed) {
  const Certificate given = certify_with();
  decide(0, false);
  EXPECT_EQ(doubt(given).find("1 of the 3 attempts that it stands on was decided not passed by Dr B on 20"), 0U)
      << doubt(given);
  EXPECT_NE(doubt(given).find(kReason), std::string::npos);
  const CertificateStanding standing = standing_of(database_, given);
  EXPECT_TRUE(standing.attempts[0].passed_then);
  EXPECT_FALSE(standing.attempts[0].passed_now);
  EXPECT_EQ(standing.attempts[0].decided_now, "Dr B");
  decide(2, false, "Dr C");
  EXPECT_EQ(doubt(given).find("the attempt that it cites was decided not passed by Dr C"), 0U) << doubt(given);
  decide(0, true);
  decide(2, true);
  EXPECT_EQ(doubt(given), "") << "decided again: it holds";
}

TEST_F(Standing, MindsNoDecisionThatWasKnownThen) {
  const VerdictOverride failed = decide(0, false), passed = decide(1, true);
  const Certificate given = certify_with({{0, failed}, {1, passed}});
  EXPECT_EQ(doubt(given), "");
  decide(0, false, "Dr C");
  EXPECT_EQ(doubt(given), "") << "it had not counted as passed";
  decide(1, false, "Dr C");
  EXPECT_EQ(doubt(given).find("1 of the 3 attempts"), 0U) << doubt(given);
  const auto standing = standing_of(database_, given).attempts;
  EXPECT_EQ(standing[1].decided_then, "Dr B");
  EXPECT_EQ(standing[1].decided_now, "Dr C");
}

TEST_F(Standing, OfAnOlderCertificateTheTrailTells) {
  decide(0, false);
  const Certificate given = certify({{"words", "3 of 3"}});
  attempts_.push_back(attempt(95));
  decide(3, false);
  EXPECT_EQ(standing_of(database_, given).attempts.size(), 3U);
  EXPECT_EQ(doubt(given), "") << "one was decided before, one came after";
  decide(2, false);
  EXPECT_EQ(doubt(given).find("the attempt that it cites was"), 0U) << doubt(given);
}

TEST_F(Standing, IsInQuestionWhenTheCitedAttemptIsAnother) {
  const Certificate given = certify({{"row_hash", "0123"}});
  EXPECT_EQ(doubt(given), "the attempt that it cites is no longer the one that was certified");
}

}  // namespace
}  // namespace trocar::certificate_standing_test
