// An attempt's detail: what stands beside it is of the same curve, everybody counts once, and experts are told apart.
#include <algorithm>

#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"

namespace trocar::attempt_query_test {
namespace {

AttemptId stored(Database& database, const std::string& trainee, double score, const std::string& hand = "mouse",
                 int board = 3) {
  AttemptStart start = sample_start(trainee);
  start.hand = hand;
  start.board = board;
  AttemptResult result = sample_result(score);
  result.grade.metrics[0].value = score;  // time_s
  return store_attempt(database, start, result);
}

const MetricDetail& metric(const AttemptDetail& detail, const std::string& name) {
  return *std::find_if(detail.metrics.begin(), detail.metrics.end(),
                       [&](const MetricDetail& m) { return m.name == name; });
}

TEST(AttemptDetail, ShowsTheResultAndItsRecord) {
  Database database(":memory:");
  const AttemptId id = stored(database, "A", 80);
  const AttemptDetail detail = attempt_detail(database, id.uuid);
  EXPECT_EQ(detail.summary.uuid, id.uuid);
  EXPECT_EQ(detail.result.uuid, id.uuid);
  EXPECT_EQ(detail.result.grade.score, 80);
  EXPECT_EQ(detail.row_hash.size(), 64u);
  EXPECT_FALSE(detail.finished_utc.empty());
  ASSERT_EQ(detail.metrics.size(), 3u);
  EXPECT_EQ(detail.metrics[1].name, "force_max_n");
  EXPECT_EQ(detail.metrics[1].unit, "N");
  EXPECT_EQ(detail.metrics[1].value, 2.8);
  EXPECT_FALSE(detail.metrics[2].value) << "undefined stays undefined";
  EXPECT_TRUE(detail.earlier.empty());
  EXPECT_TRUE(detail.experts.empty());
  EXPECT_FALSE(detail.metrics[1].cohort);
}

TEST(AttemptDetail, EarlierOnesAreOfTheSameCurveAndBefore) {
  Database database(":memory:");
  stored(database, "A", 50);
  stored(database, "A", 60);
  stored(database, "A", 10, "device");
  stored(database, "B", 20);
  AttemptResult left = sample_result(0);
  left.grade.status = AttemptStatus::kAborted;
  left.grade.score.reset();
  AttemptStart start = sample_start("A");
  start.hand = "mouse";
  store_attempt(database, start, left);
  const AttemptId id = stored(database, "A", 70);
  stored(database, "A", 99);
  const AttemptDetail detail = attempt_detail(database, id.uuid);
  ASSERT_EQ(detail.earlier.size(), 2u);
  EXPECT_EQ(detail.earlier[0].summary.score, 60) << "newest first";
  EXPECT_EQ(detail.earlier[1].summary.score, 50);
  EXPECT_EQ(detail.earlier[0].summary.trainee, "A");
  EXPECT_EQ(metric(detail, "time_s").own.count, 2);
  EXPECT_EQ(metric(detail, "time_s").own.median, 55);
  EXPECT_FALSE(metric(detail, "time_s").own.best);
}

TEST(AttemptDetail, InTheCohortEverybodyCountsOnce) {
  Database database(":memory:");
  for (int k = 0; k < 20; ++k) stored(database, "A", 5 + k);
  for (const auto& [code, score] : {std::pair{"B", 50.0}, {"C", 60.0}, {"D", 70.0}}) stored(database, code, score);
  stored(database, "E", 1000.0 / 11, "device");
  const AttemptId id = stored(database, "A", 40);
  const MetricDetail time = metric(attempt_detail(database, id.uuid), "time_s");
  EXPECT_EQ(time.people, 4);
  EXPECT_DOUBLE_EQ(time.cohort->median, 55);  // 40 50 60 70
  EXPECT_DOUBLE_EQ(time.cohort->low, 47.5);
}

TEST(AttemptDetail, TwoPeopleAreNoCohort) {
  Database database(":memory:");
  const AttemptId id = stored(database, "A", 40);
  stored(database, "B", 50);
  EXPECT_FALSE(metric(attempt_detail(database, id.uuid), "time_s").cohort);
}

TEST(AttemptDetail, ExpertsOfTheSameBoardComeFirst) {
  Database database(":memory:");
  for (int k = 0; k < 12; ++k) stored(database, "X", 90 + k * 0.5, "expert", k == 2 ? 7 : 5);
  const AttemptId id = stored(database, "A", 40, "mouse", 7);
  const AttemptDetail detail = attempt_detail(database, id.uuid);
  ASSERT_EQ(detail.experts.size(), static_cast<std::size_t>(kExpertAttempts));
  EXPECT_EQ(detail.experts[0].board, 7);
  EXPECT_EQ(detail.experts[1].score, 95.5);
  EXPECT_EQ(detail.experts[0].trainee, "X");
  EXPECT_TRUE(metric(detail, "time_s").expert);
  const AttemptDetail own = attempt_detail(database, detail.experts[0].uuid);
  EXPECT_TRUE(std::none_of(own.experts.begin(), own.experts.end(), [&](const AttemptSummary& e) {
    return e.uuid == own.summary.uuid;
  })) << "not compared with itself";
}

TEST(AttemptDetail, RefusesWhatIsNoFinishedAttempt) {
  Database database(":memory:");
  const AttemptId running = AttemptStore(database).begin_attempt(sample_start("A"));
  EXPECT_NE(message_of<InputError>([&] { attempt_detail(database, running.uuid); }).find("still runs"),
            std::string::npos);
  EXPECT_THROW(attempt_detail(database, "01234567"), InputError);
  EXPECT_THROW(attempt_detail(database, "'; DROP TABLE attempt"), InputError);
}

TEST(AttemptDetail, StandsForEveryAttemptOfACohort) {
  Database database(":memory:");
  test::CohortPlan plan;
  plan.attempts = 120;
  plan.metrics = 8;
  fill_cohort(database, plan);
  for (const AttemptSummary& summary : AttemptStore(database).list()) {
    const AttemptDetail detail = attempt_detail(database, summary.uuid);
    EXPECT_EQ(detail.metrics.size(), detail.result.grade.metrics.size());
    for (const PastAttempt& past : detail.earlier) {
      EXPECT_LT(past.summary.row, summary.row);
      EXPECT_EQ(past.summary.hand, summary.hand);
      EXPECT_EQ(past.summary.level, summary.level);
    }
  }
}

}  // namespace
}  // namespace trocar::attempt_query_test
