// What a certificate stands on, and what puts it in question: later decisions, not earlier ones, and no clock.
#include "trainees/records/certificate_standing.h"

#include <nlohmann/json.hpp>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/accounts.h"
#include "trainees/records/erasure.h"
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

/// One connection asks for the list, another one writes, with so many certificates that all names are read at once.
class StandingOfMany : public TemporaryFolder {
 protected:
  StandingOfMany() {
    const Account signs = AccountStore(other_).add("ida", "Ida Adler", Role::kInstructor, "", "a long password", "");
    author_ = {signs.uuid, signs.name};
    for (int k = 0; k < kPeople; ++k) {
      const std::string code = "T-" + std::to_string(k);
      AttemptStart start = sample_start(code);
      std::vector<std::string> attempts;
      for (const double score : {90., 92.}) {
        ++start.board;
        attempts.push_back(store_attempt(other_, start, sample_result(score)).uuid);
      }
      const json evidence = {{"attempt", attempts[1]},
                             {"attempts", attempts_of_curve(other_, attempts[1])},
                             {"overrides", json::array()},
                             {"row_hash", sql::query_text(other_.connection(),
                                                          "SELECT row_hash FROM attempt"
                                                          " ORDER BY id DESC LIMIT 1")}};
      given_.push_back(said_.certify(code, "surface-touch", "L1", "1", evidence.dump(), author_));
    }
  }
  /// As somebody does who may write the file.
  void behind(const std::string& text) { EXPECT_EQ(run_without_triggers(folder_ / "t.db", text), ""); }
  /// Those of which the list does not say that they are beyond doubt; as each by itself says.
  std::vector<int> doubted() {
    const std::set<std::string> stand = certificates_beyond_doubt(database_);
    std::vector<int> out;
    for (int k = 0; k < kPeople; ++k) {
      if (!stand.contains(given_[k].uuid)) out.push_back(k);
      EXPECT_NE(stand.contains(given_[k].uuid), standing_of(database_, given_[k]).in_question != "") << k;
    }
    return out;
  }

  static constexpr int kPeople = 105;
  Database other_{folder_ / "t.db"}, database_{folder_ / "t.db"};
  AssessmentStore said_{other_};
  Author author_;
  std::vector<Certificate> given_;
};

TEST_F(StandingOfMany, SeesWhatAnotherConnectionWrites) {
  EXPECT_EQ(doubted(), std::vector<int>{});
  said_.override_verdict(standing_of(database_, given_[7]).attempts[0].uuid, false, kReason, author_);
  EXPECT_EQ(doubted(), std::vector<int>{7});
  behind("UPDATE attempt SET trainee_id = 1 WHERE id = 81");
  EXPECT_EQ(doubted(), (std::vector<int>{7, 40})) << "another person's";
  behind("UPDATE attempt SET trainee_id = 41 WHERE id = 81");
  EXPECT_EQ(doubted(), std::vector<int>{7}) << "as it was";
  behind("UPDATE attempt SET row_hash = 'x' WHERE id = 84");
  EXPECT_EQ(doubted(), (std::vector<int>{7, 41})) << "the one that it cites";
  behind("UPDATE certificate SET utc = '2020' WHERE id = 51");
  EXPECT_EQ(doubted(), (std::vector<int>{7, 41, 50})) << "not as it was signed";
  behind("UPDATE audit SET detail = detail || 'x' WHERE action = 'certificate added' AND subject = '" +
         given_[51].uuid + "'");
  EXPECT_EQ(doubted(), (std::vector<int>{7, 41, 50, 51})) << "nor the entry";
}

TEST_F(StandingOfMany, AnAttemptThatIsGonePutsNoneInQuestionAndOneThatComesBackElsewhereDoes) {
  const std::string uuid = standing_of(database_, given_[9]).attempts[0].uuid;
  behind("UPDATE attempt SET uuid = 'elsewhere' WHERE uuid = '" + uuid + "'");
  EXPECT_EQ(doubted(), std::vector<int>{});
  behind("UPDATE attempt SET uuid = '" + uuid + "' WHERE id = 1");
  EXPECT_EQ(doubted(), std::vector<int>{9});
}

TEST_F(StandingOfMany, OneMoreIsBeyondDoubtAndThoseOfWhoWasErasedAreNoMore) {
  EXPECT_EQ(certificates_beyond_doubt(database_).size(), std::size_t{kPeople});
  const std::string attempt = store_attempt(other_, sample_start("T-new"), sample_result(95)).uuid;
  said_.certify("T-new", "surface-touch", "L1", "1",
                R"({"attempt":")" + attempt + R"(","attempts":[")" + attempt + R"("],"overrides":[]})", author_);
  EXPECT_EQ(certificates_beyond_doubt(database_).size(), std::size_t{kPeople} + 1);
  erase_trainee(other_, "T-12", ErasureKind::kTraining, "request", author_);
  const std::set<std::string> stand = certificates_beyond_doubt(database_);
  EXPECT_EQ(stand.size(), std::size_t{kPeople});
  EXPECT_FALSE(stand.contains(given_[12].uuid));
}

TEST_F(StandingOfMany, ANameThatIsWrittenInAnotherWayIsOneAllTheSame) {
  AttemptStart start = sample_start("T-new");
  const std::string named = store_attempt(other_, start, sample_result(95)).uuid;
  ASSERT_EQ(named[0], '0');
  ++start.board;
  const std::string cited = store_attempt(other_, start, sample_result(95)).uuid;
  const Certificate given = said_.certify(
      "T-new", "surface-touch", "L1", "1",
      R"({"attempt":")" + cited + R"(","attempts":["\u0030)" + named.substr(1) + R"("],"overrides":[]})", author_);
  EXPECT_EQ(standing_of(database_, given).in_question, "");
  behind("UPDATE attempt SET trainee_id = 1 WHERE uuid = '" + named + "'");
  EXPECT_NE(standing_of(database_, given).in_question, "");
  EXPECT_FALSE(certificates_beyond_doubt(database_).contains(given.uuid));
}

}  // namespace
}  // namespace trocar::certificate_standing_test
