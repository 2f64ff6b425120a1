#include <gtest/gtest.h>

#include "app/report/verdict.h"
#include "tests/support/sample_attempt.h"

namespace trocar::report_verdict_test {
namespace {

using testing_support::sample_attempt;

TEST(Verdict, PassNamesTheMarginAndTheLargestLoss) {
  const Verdict verdict = judge(sample_attempt(true), 75);
  EXPECT_EQ(verdict.headline, "PASS");
  EXPECT_NE(verdict.reason.find("88.4 of 100, pass mark 75"), std::string::npos);
  EXPECT_NE(verdict.reason.find("Path ratio"), std::string::npos);
}

TEST(Verdict, CapComesBeforeLostPoints) {
  const Verdict verdict = judge(sample_attempt(), 75);
  EXPECT_EQ(verdict.headline, "NOT YET");
  EXPECT_EQ(verdict.reason, "safety: peak_force below 0.5: at most 59.");
  EXPECT_NE(verdict.advice.find("Peak force down to 2 N (now 5.61 N)"), std::string::npos) << verdict.advice;
}

TEST(Verdict, CriticalEventComesBeforeEverything) {
  AttemptResult attempt = sample_attempt();
  attempt.events.push_back({9.25, "PERFORATION", Severity::kCritical, 2, 8.4, "N", Vec3::Zero()});
  EXPECT_NE(judge(attempt, 75).reason.find("Perforation at 9.2 s (8.4 N)"), std::string::npos)
      << judge(attempt, 75).reason;
}

TEST(Verdict, TimeoutIsNamedWhenNothingWorseHappened) {
  AttemptResult attempt = sample_attempt();
  attempt.grade.caps.clear();
  attempt.grade.status = AttemptStatus::kTimeout;
  EXPECT_NE(judge(attempt, 75).reason.find("time limit"), std::string::npos);
}

TEST(Verdict, PlainShortfallNamesTheCostliestPart) {
  AttemptResult attempt = sample_attempt();
  attempt.grade.caps.clear();
  attempt.grade.score = 71;
  EXPECT_NE(judge(attempt, 75).reason.find("Peak force: 5.61 N, full marks at 2 N (\u221223.4 points)"),
            std::string::npos)
      << judge(attempt, 75).reason;
}

TEST(Verdict, UngradedAttemptsSayWhyAndCarryNoScore) {
  AttemptResult attempt = sample_attempt();
  attempt.grade.score.reset();
  for (const auto& [status, word] : {std::pair(AttemptStatus::kAborted, "stopped"),
                                     {AttemptStatus::kFault, "overheat"},
                                     {AttemptStatus::kVoid, "void"}}) {
    attempt.grade.status = status;
    attempt.device.fault = "overheat";
    const Verdict verdict = judge(attempt, 75);
    EXPECT_EQ(verdict.headline, "NOT GRADED");
    EXPECT_NE(verdict.reason.find(word), std::string::npos) << verdict.reason;
    EXPECT_TRUE(verdict.advice.empty());
  }
}

TEST(Verdict, FullMarksNeedNoAdvice) {
  AttemptResult attempt = sample_attempt(true);
  for (Subscore& s : attempt.grade.subscores) s.value = 1;
  attempt.grade.score = 100;
  EXPECT_TRUE(judge(attempt, 75).advice.empty());
  EXPECT_NE(judge(attempt, 75).reason.find("Full marks"), std::string::npos);
}

TEST(ReportOrder, SafetyFirstTimeLast) {
  const auto ordered = in_report_order(sample_attempt().grade.subscores);
  EXPECT_EQ(ordered.front().name, "peak_force");
  EXPECT_EQ(ordered.back().name, "time_to_complete");
}

TEST(ReportOrder, PointsLostAddUpToTheMissingScore) {
  double lost = 0, score = 0;
  for (const Subscore& s : sample_attempt().grade.subscores) {
    lost += points_lost(s);
    score += 100 * s.weight * s.value;
  }
  EXPECT_NEAR(lost + score, 100, 1e-9);
}

}  // namespace
}  // namespace trocar::report_verdict_test
