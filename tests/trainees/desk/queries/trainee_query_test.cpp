// One trainee's picture: curves with the cohort beside them, weeks without gaps, ability only where it is worth
// showing.
#include <algorithm>
#include <cmath>

#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/progress/calendar.h"

namespace trocar::trainee_query_test {
namespace {

constexpr const char* kNow = "2026-07-01T12:00:00Z";

Database& small() {
  static Database database = [] {
    Database made(":memory:");
    test::CohortPlan plan;
    plan.trainees = 9;
    plan.attempts = 540;
    plan.metrics = 5;
    plan.events = 2;
    fill_cohort(made, plan);
    return made;
  }();
  return database;
}

TEST(TraineeDetail, AgreesWithTheCohortsLines) {
  Database& database = small();
  for (const std::string code : {"P001", "P004", "P008"}) {
    const TraineeDetail picture = trainee_detail(database, code, {}, kNow);
    const auto lines = cohort_lines(database, {}, {.trainee = code}, kNow);
    ASSERT_EQ(picture.curves.size(), lines.size());
    for (const CurveDetail& curve : picture.curves) {
      const auto line =
          std::find_if(lines.begin(), lines.end(), [&](const CohortLine& l) { return l.key == curve.curve.key; });
      ASSERT_NE(line, lines.end());
      EXPECT_EQ(curve.reliability, line->reliability);
      ASSERT_EQ(curve.judgements.size(), line->judgements.size());
      for (std::size_t k = 0; k < curve.judgements.size(); ++k)
        EXPECT_EQ(curve.judgements[k].evidence, line->judgements[k].evidence);
      EXPECT_EQ(curve.cusum.size(), curve.curve.attempts.size());
      EXPECT_EQ(curve.competence.value, competence_of(curve.cusum).value);
    }
  }
}

TEST(TraineeDetail, CohortIsTheQuartilesOfEverybodysScores) {
  Database& database = small();
  const CurveDetail curve = trainee_detail(database, "P002", {}, kNow).curves.front();
  std::vector<std::vector<double>> scores;
  for (int t = 1; t <= 9; ++t)
    for (const LearningCurve& other : learning_curves(past_attempts(database, "P00" + std::to_string(t)))) {
      if (other.key != curve.curve.key) continue;
      scores.emplace_back();
      for (const PastAttempt& past : other.attempts)
        if (past.summary.score) scores.back().push_back(*past.summary.score);
    }
  const auto wanted = cohort_curve(scores);
  ASSERT_EQ(curve.cohort.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_EQ(curve.cohort[k].people, wanted[k].people);
    EXPECT_DOUBLE_EQ(curve.cohort[k].scores.median, wanted[k].scores.median);
  }
}

TEST(TraineeDetail, WeeksHaveNoGapsAndAllMinutes) {
  Database& database = small();
  const TraineeDetail picture = trainee_detail(database, "P001", {}, kNow);
  double minutes = 0, wanted = 0;
  int attempts = 0;
  for (std::size_t k = 0; k < picture.weeks.size(); ++k) {
    minutes += picture.weeks[k].minutes;
    attempts += picture.weeks[k].attempts;
    if (k == 0) continue;
    const auto day = [](const std::string& date) { return *seconds_of_utc(date + "T00:00:00Z") / kSecondsADay; };
    EXPECT_EQ(day(picture.weeks[k].monday) - day(picture.weeks[k - 1].monday), 7);
  }
  const auto all = past_attempts(database, "P001");
  for (const PastAttempt& past : all)
    if (const auto at = past.metrics.find("time_s"); at != past.metrics.end()) wanted += at->second / 60;
  EXPECT_NEAR(minutes, wanted, 1e-9);
  EXPECT_EQ(attempts, static_cast<int>(all.size()));
}

TEST(TraineeDetail, AbilityIsShownOnlyWhenItIsWorthIt) {
  Database& database = small();
  const TraineeDetail picture = trainee_detail(database, "P001", {}, kNow);
  EXPECT_GT(picture.rasch_attempts, 500);
  ASSERT_TRUE(picture.ability_logit);
  EXPECT_LT(*picture.ability_se, 0.5);
  ProgressRules rules;
  rules.rasch_least_attempts = 10000;
  EXPECT_FALSE(trainee_detail(database, "P001", rules, kNow).ability_logit);
  rules = {};
  rules.rasch_largest_se = 0.05;
  EXPECT_FALSE(trainee_detail(database, "P001", rules, kNow).ability_logit);
}

TEST(TraineeDetail, HasNotesAndCertificatesAndWhatIsDue) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(80));
  AssessmentStore assessments(database);
  assessments.add_note("A", "", "Lift before you turn.", {"", "Dr. B"});
  const Certificate certificate = assessments.certify("A", "surface-touch", "L1", "1", "{}", {"", "Dr. B"});
  const auto certified = *seconds_of_utc(certificate.utc);
  TraineeDetail picture = trainee_detail(database, "a", {}, utc_of_seconds(certified + 20 * kSecondsADay));
  EXPECT_EQ(picture.code, "A");
  ASSERT_EQ(picture.notes.size(), 1u);
  EXPECT_EQ(picture.notes[0].text, "Lift before you turn.");
  ASSERT_EQ(picture.certificates.size(), 1u);
  ASSERT_EQ(picture.curves[0].retention.size(), 2u);
  EXPECT_EQ(picture.curves[0].retention[0].state, RetentionDate::State::kDue);
  EXPECT_EQ(picture.curves[0].judgements.front().flag, Flag::kRetentionDue);
  assessments.revoke(certificate.uuid, "given to the wrong person", {"", "Dr. B"});
  picture = trainee_detail(database, "A", {}, utc_of_seconds(certified + 20 * kSecondsADay));
  EXPECT_TRUE(picture.curves[0].retention.empty());
}

TEST(RulesInForce, AreTheNewestKeptOrTheShipped) {
  Database database(":memory:");
  EXPECT_EQ(rules_in_force(database).version, "1");
  CurriculumStore store(database);
  store.add(kRulesName, "version = \"2\"\n[stuck]\nattempts = 7\n", {});
  store.add("another", "version = \"9\"\n", {});
  EXPECT_EQ(rules_in_force(database).version, "2");
  EXPECT_EQ(rules_in_force(database).stuck_after, 7);
  store.add(kRulesName, "version = \"3\"\n[stuck]\nattempts = 0\n", {});
  const ProgressRules before = rules_in_force(database);
  EXPECT_EQ(before.version, "2") << "those before it rule on";
  EXPECT_TRUE(before.unread.starts_with("curriculum standard, version 2:3:12:")) << before.unread;
}

TEST(TraineeDetail, StrangersAndBeginners) {
  Database database(":memory:");
  EXPECT_NE(message_of<InputError>([&] { trainee_detail(database, "nobody", {}, kNow); }).find("no trainee \"nobody\""),
            std::string::npos);
  AttemptStore(database).begin_attempt(sample_start("A"));
  const TraineeDetail picture = trainee_detail(database, "A", {}, kNow);
  EXPECT_TRUE(picture.curves.empty());
  EXPECT_TRUE(picture.weeks.empty());
  EXPECT_FALSE(picture.ability_logit);
}

}  // namespace
}  // namespace trocar::trainee_query_test
