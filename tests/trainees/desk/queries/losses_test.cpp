// Why attempts fail, against numbers by hand.
#include "trainees/desk/queries/losses.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/erasure.h"

namespace trocar::losses_test {
namespace {

constexpr const char* kNow = "2026-07-01T12:00:00Z";

AttemptResult made(double in_band, double force, double time_s) {
  AttemptResult out = sample_result(100 * (0.6 * in_band + 0.4 * force));
  out.grade.metrics = {{"time_s", time_s, "s"}, {"force_max_n", 1 + time_s / 100, "N"}};
  out.grade.subscores = {{"force", force, 0.4, 6 - 4 * force, "N", 2, 6, true},
                         {"in band", in_band, 0.6, 0.3 + 0.7 * in_band, "1", 1, 0.3, true}};
  out.grade.caps.clear();
  if (in_band < 0.5) out.grade.caps = {{.kind = CapKind::kGate, .subject = "in band", .below = 0.5, .at_most = 59}};
  out.events.clear();
  return out;
}

class LossesOfACohort : public testing::Test {
 protected:
  void attempt(const std::string& who, const AttemptResult& result) {
    store_attempt(database_, sample_start(who), result);
  }
  std::vector<Losses> losses(const CohortFilter& filter = {}) {
    return losses_of(database_, newest_attempts(cohort_lines(database_, {}, filter, kNow)));
  }
  Database database_{":memory:"};
};

TEST_F(LossesOfACohort, AreMeansOverTheNewestAttemptsOfEach) {
  for (int i = 0; i < 4; ++i) attempt("A", made(0, 0, 90));  // of seven the newest five count
  for (int i = 0; i < 3; ++i) attempt("A", made(1, 0.5, 30));
  attempt("B", made(0.25, 1, 60));
  const auto all = losses();
  ASSERT_EQ(all.size(), 1u);
  const Losses& l = all[0];
  EXPECT_EQ(l.people, 2);
  EXPECT_EQ(l.attempts, 6);
  EXPECT_EQ(l.graded, 6);
  EXPECT_EQ(l.passed, 3);
  ASSERT_EQ(l.parts.size(), 2u);
  EXPECT_EQ(l.parts[0].part.name, "in band") << "most points lost first";
  EXPECT_NEAR(l.parts[0].points_lost, 60 * (2 * 1 + 0.75) / 6, 1e-12);
  EXPECT_EQ(l.parts[0].gate_failed, 3);
  EXPECT_DOUBLE_EQ(l.parts[0].gate_below, 0.5);
  EXPECT_NEAR(*l.parts[0].part.raw, (0.475 + 1) / 2, 1e-12) << "median of 0.3, 0.3, 0.475, 1, 1, 1";
  EXPECT_NEAR(l.parts[1].points_lost, 40 * (2 * 1 + 3 * 0.5) / 6, 1e-12);
  EXPECT_EQ(l.parts[1].gate_failed, 0);
}

TEST_F(LossesOfACohort, TellWhatWasGraveAndWhatHasNoScore) {
  AttemptResult left = made(1, 1, 20);
  left.grade.status = AttemptStatus::kAborted;
  left.grade.score.reset();
  left.grade.subscores.clear();
  left.events = {{1, "WRONG_STRUCTURE", Severity::kCritical, 0, 0, "", Vec3::Zero()}};
  attempt("A", left);
  AttemptResult late = made(1, 1, 120);
  late.grade.status = AttemptStatus::kTimeout;
  late.grade.passed = false;
  late.grade.caps = {{.kind = CapKind::kUnfinished, .done = 7, .total = 12, .at_most = 28}};
  attempt("A", late);
  const Losses l = losses().at(0);
  EXPECT_EQ(l.attempts, 2);
  EXPECT_EQ(l.graded, 1);
  EXPECT_EQ(l.passed, 0);
  EXPECT_EQ(l.unfinished, 1);
  ASSERT_EQ(l.critical.size(), 1u);
  EXPECT_EQ(l.critical[0].type, "WRONG_STRUCTURE");
}

TEST_F(LossesOfACohort, FollowTheFilter) {
  attempt("A", made(1, 1, 20));
  attempt("B", made(0, 0, 20));
  EXPECT_EQ(losses({.trainee = "A"}).at(0).people, 1);
  EXPECT_NEAR(losses({.trainee = "A"}).at(0).parts[0].points_lost, 0, 1e-12);
  EXPECT_TRUE(losses({.exercise = "another"}).empty());
}

TEST_F(LossesOfACohort, AMeasureIsDrawnFromThreePeopleOnAndNeverOfTheErased) {
  int n = 0;
  for (const char* who : {"A", "B", "C", "D"})
    for (const double time : {10.0, 20.0}) attempt(who, made(1, 1, time + 1.0 * n++));
  const CurveKey key = cohort_lines(database_, {}, {}, kNow).at(0).key;
  const MetricCohort four = metric_cohort(database_, key, "time_s");
  ASSERT_EQ(four.points.size(), 2u);
  EXPECT_EQ(four.unit, "s");
  EXPECT_EQ(four.points[0].people, 4);
  EXPECT_DOUBLE_EQ(four.points[0].scores.median, 13) << "10, 12, 14, 16";
  EXPECT_DOUBLE_EQ(four.points[1].scores.median, 24) << "21, 23, 25, 27";
  erase_trainee(database_, "D", ErasureKind::kTraining, "request of the person", {"", "Ida"});
  EXPECT_DOUBLE_EQ(metric_cohort(database_, key, "time_s").points.at(0).scores.median, 12);
  erase_trainee(database_, "C", ErasureKind::kTraining, "request of the person", {"", "Ida"});
  EXPECT_TRUE(metric_cohort(database_, key, "time_s").points.empty()) << "two would show single people";
  EXPECT_TRUE(metric_cohort(database_, key, "no such measure").points.empty());
}

TEST_F(LossesOfACohort, MeasuresStandInTheRecordsOrder) {
  attempt("A", made(1, 1, 20));
  EXPECT_EQ(metrics_of_attempt(database_, cohort_lines(database_, {}, {}, kNow).at(0).newest_rows.at(0)),
            (std::vector<std::string>{"time_s", "force_max_n"}));
}

}  // namespace
}  // namespace trocar::losses_test
