#include "trainees/records/cohort.h"

#include "tests/trainees/records/store_samples.h"

namespace trocar::cohort_test {
namespace {

AttemptResult without_score(AttemptStatus status) {
  AttemptResult result = sample_result();
  result.grade.status = status;
  result.grade.score.reset();
  result.grade.passed = false;
  result.grade.metrics = {{"force_max_n", 99, "N"}};
  return result;
}

TEST(Cohort, SummarisesByTraineeExerciseAndLevel) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(80));  // peak force 2 + score/100 N
  store_attempt(database, sample_start("A"), sample_result(90));
  store_attempt(database, sample_start("A"), sample_result(40));
  store_attempt(database, sample_start("A"), without_score(AttemptStatus::kAborted));
  AttemptStart harder = sample_start("A");
  harder.level = "L2";
  store_attempt(database, harder, sample_result(50));
  store_attempt(database, sample_start("B"), without_score(AttemptStatus::kFault));
  AttemptStore(database).begin_attempt(sample_start("C"));
  const auto rows = cohort(database);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(std::tie(rows[0].trainee, rows[0].exercise_id, rows[0].level),
            std::make_tuple(std::string("A"), std::string("surface-touch"), std::string("L1")));
  EXPECT_EQ(rows[0].attempts, 4);
  EXPECT_EQ(rows[0].graded, 3);
  EXPECT_EQ(rows[0].passes, 2);
  EXPECT_EQ(rows[0].best, 90);
  EXPECT_EQ(rows[0].last, 40);
  EXPECT_NEAR(*rows[0].mean_peak_force_n, 2.7, 1e-12);
  EXPECT_NEAR(*rows[0].mean_time_s, 41.5, 1e-12);
  EXPECT_EQ(rows[1].level, "L2");
  EXPECT_EQ(rows[1].best, 50);
  EXPECT_EQ(rows[2].trainee, "B");
  EXPECT_EQ(rows[2].graded, 0);
  EXPECT_FALSE(rows[2].best || rows[2].last || rows[2].mean_peak_force_n);
}

TEST(Cohort, KeepsRubricsOfOneIdApart) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(60));
  AttemptStart easier = sample_start("A");
  easier.exercise_text += "# easier\n";
  easier.exercise_version = "mine";
  store_attempt(database, easier, sample_result(100));
  store_attempt(database, sample_start("A"), sample_result(70));
  const auto rows = cohort(database);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].best, 70);
  EXPECT_EQ(rows[0].last, 70);
  EXPECT_EQ(rows[1].best, 100);
  EXPECT_EQ(rows[1].exercise_version, "mine");
  EXPECT_NE(rows[0].rubric_sha256, rows[1].rubric_sha256);
}

TEST(Cohort, CanBeNarrowedToOneTrainee) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(80));
  store_attempt(database, sample_start("B"), sample_result(80));
  ASSERT_EQ(cohort(database, "b").size(), 1u);
  EXPECT_EQ(cohort(database, "b")[0].trainee, "B");
  EXPECT_TRUE(cohort(database, "nobody").empty());
}

}  // namespace
}  // namespace trocar::cohort_test
