// The hash chain shows what triggers cannot forbid: a file changed by someone who dropped the triggers.
#include <sqlite3.h>

#include "tests/trainees/records/store_samples.h"

namespace trocar::attempt_chain_test {
namespace {

class AttemptChain : public TemporaryFolder {
 protected:
  AttemptChain() : file_(folder_ / "t.db") {
    Database database(file_);
    for (int i = 0; i < 4; ++i) store_attempt(database, sample_start(), sample_result(70 + i));
  }
  /// What check() says after the change, with the triggers out of the way.
  std::string after(const std::string& sql) {
    const char* triggers[] = {"attempt_no_update",    "attempt_no_delete",      "attempt_keeps_identity",
                              "metric_row_no_update", "event_row_no_delete",    "subscore_row_no_update",
                              "ruleset_no_update",    "event_row_no_update",    "score_cap_no_update",
                              "metric_row_no_delete", "subscore_row_no_delete", "score_cap_no_delete",
                              "score_no_update",      "score_no_delete"};
    for (const char* trigger : triggers) {
      EXPECT_EQ(run_outside(file_, std::string("DROP TRIGGER ") + trigger), "");
    }
    EXPECT_EQ(run_outside(file_, sql), "") << sql;
    std::string problems;
    for (const std::string& problem : Database(file_).check()) problems += problem + "\n";
    return problems;
  }
  static constexpr const char* kRemoveSecond =
      "DELETE FROM event_row WHERE id >> 20 = 2; DELETE FROM metric_row WHERE id >> 10 = 2;"
      "DELETE FROM subscore_row WHERE id >> 10 = 2; DELETE FROM score_cap WHERE score_id = 2;"
      "DELETE FROM score WHERE id = 2; DELETE FROM attempt WHERE id = 2";
  std::filesystem::path file_;
};

TEST_F(AttemptChain, IsSoundWhenUntouched) { EXPECT_TRUE(Database(file_).check().empty()); }

TEST_F(AttemptChain, ShowsAChangedScore) {
  EXPECT_NE(after("UPDATE score SET value = 99 WHERE attempt_id = 2").find("was changed after it was finished"),
            std::string::npos);
}

TEST_F(AttemptChain, ShowsAChangedStatus) {
  EXPECT_NE(after("UPDATE attempt SET status = 'void' WHERE id = 4").find("was changed"), std::string::npos);
}

TEST_F(AttemptChain, ShowsAChangeInTheLastDigitOfAMetric) {
  EXPECT_NE(after("UPDATE metric_row SET value = value + 1e-15 WHERE id = 1 << 10 | 1"), "");
}

TEST_F(AttemptChain, ShowsARemovedEvent) {
  EXPECT_NE(after("DELETE FROM event_row WHERE id = 3 << 20 | 1").find("was changed"), std::string::npos);
}

TEST_F(AttemptChain, ShowsAChangedSubscoreAndCap) {
  EXPECT_NE(after("UPDATE subscore_row SET raw = 1 WHERE id = 1 << 10;"
                  "UPDATE score_cap SET at_most = 100 WHERE score_id = 2"),
            "");
}

TEST_F(AttemptChain, ShowsARemovedAttempt) {
  const std::string problems = after(kRemoveSecond);
  EXPECT_NE(problems.find("attempts 2 to 2 are missing"), std::string::npos) << problems;
}

TEST_F(AttemptChain, ShowsAnAttemptThatNoLongerFollows) {
  EXPECT_NE(after("UPDATE attempt SET prev_hash = 'x' WHERE id = 3").find("does not follow"), std::string::npos);
}

TEST_F(AttemptChain, ShowsAChangedExercise) {
  EXPECT_NE(after("UPDATE ruleset SET toml = 'easier'").find("exercise surface-touch"), std::string::npos);
}

TEST_F(AttemptChain, ABrokenReferenceIsReported) {
  EXPECT_NE(after("DELETE FROM trainee").find("points to nothing in trainee"), std::string::npos);
}

}  // namespace
}  // namespace trocar::attempt_chain_test
