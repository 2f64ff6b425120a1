// Decisions in what the desk asks: cohort, trainee, attempt, Rasch; and abilities when there is enough.
#include <algorithm>

#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/records/assessments.h"

namespace trocar::verdict_query_test {
namespace {

constexpr const char* kNow = "2026-06-01T12:00:00Z";
const Author kTeacher{"0192-b", "Dr B"};

/// Without anything critical, so that only passes count.
AttemptId tried(Database& database, const std::string& who, double score, const std::string& level = "L1") {
  AttemptStart start = sample_start(who);
  start.level = level;
  AttemptResult result = sample_result(score);
  result.grade.caps.clear();
  result.events.pop_back();
  return store_attempt(database, start, result);
}

CohortLine line_of(Database& database, const std::string& who, const ProgressRules& rules = {}) {
  CohortFilter filter;
  filter.trainee = who;
  return cohort_lines(database, rules, filter, kNow).at(0);
}

bool has(const CohortLine& line, Flag flag) {
  return std::any_of(line.judgements.begin(), line.judgements.end(),
                     [flag](const Judgement& j) { return j.flag == flag; });
}

TEST(DecidedCohort, PassesRowsAndStatesFollowTheDecision) {
  Database database(":memory:");
  std::vector<AttemptId> ids;
  for (int i = 0; i < 15; ++i) ids.push_back(tried(database, "A", i == 7 ? 60 : 90));
  EXPECT_EQ(line_of(database, "A").passes, 14);
  EXPECT_EQ(line_of(database, "A").in_a_row, 7);
  EXPECT_FALSE(has(line_of(database, "A"), Flag::kReady));
  AssessmentStore(database).override_verdict(ids[7].uuid, true, "The stand slipped twice", kTeacher);
  const CohortLine after = line_of(database, "A");
  EXPECT_EQ(after.passes, 15);
  EXPECT_EQ(after.in_a_row, 15);
  ASSERT_TRUE(has(after, Flag::kReady));
  EXPECT_EQ(after.judgements[0].decided, 1);
  for (const AttemptId& id : ids)
    AssessmentStore(database).override_verdict(id.uuid, false, "Somebody else held it", kTeacher);
  EXPECT_EQ(line_of(database, "A").passes, 0);
  EXPECT_TRUE(has(line_of(database, "A"), Flag::kStuck));
  EXPECT_EQ(line_of(database, "A").best, 90);
}

TEST(DecidedCohort, ARelapseIsOneByDecisionToo) {
  Database database(":memory:");
  std::vector<AttemptId> ids;
  for (int i = 0; i < 18; ++i) ids.push_back(tried(database, "A", 90));
  EXPECT_FALSE(has(line_of(database, "A"), Flag::kRelapsed));
  for (std::size_t i = 15; i < ids.size(); ++i)
    AssessmentStore(database).override_verdict(ids[i].uuid, false, "Helped by the teacher", kTeacher);
  EXPECT_TRUE(has(line_of(database, "A"), Flag::kRelapsed));
}

TEST(DecidedTrainee, CurveTestAndLineAgreeWithTheCohort) {
  Database database(":memory:");
  std::vector<AttemptId> ids;
  for (int i = 0; i < 9; ++i) ids.push_back(tried(database, "A", i % 2 == 0 ? 60 : 90));
  AssessmentStore(database).override_verdict(ids[2].uuid, true, "The stand slipped twice", kTeacher);
  AssessmentStore(database).override_verdict(ids[3].uuid, false, "Somebody else held it", kTeacher);
  const TraineeDetail detail = trainee_detail(database, "A", {}, kNow);
  const CohortLine line = line_of(database, "A");
  const LearningCurve& curve = detail.curves.at(0).curve;
  EXPECT_EQ(curve.passes(), (std::vector<bool>{false, true, true, false, false, true, false, true, false}));
  EXPECT_EQ(curve.passed, line.passes);
  EXPECT_EQ(curve.in_a_row, line.in_a_row);
  EXPECT_EQ(detail.curves[0].judgements[0].evidence, line.judgements[0].evidence);
  EXPECT_EQ(detail.curves[0].judgements[0].decided, 1) << "a plateau looks at the newest six";
  EXPECT_EQ(line.judgements[0].decided, 1);
  const AttemptDetail attempt = attempt_detail(database, ids[8].uuid);
  EXPECT_EQ(attempt.earlier.at(4).summary.passed, false) << "ids[3]";
  EXPECT_EQ(attempt.earlier.at(5).summary.passed, true) << "ids[2]";
}

TEST(DecidedTrainee, WhatTheDeviceEndedIsListedAsideAndJudgedNever) {
  Database database(":memory:");
  tried(database, "A", 90);
  AttemptResult broken = sample_result(90);
  broken.grade.status = AttemptStatus::kVoid;
  const AttemptId id = store_attempt(database, sample_start("A"), broken);
  const TraineeDetail detail = trainee_detail(database, "A", {}, kNow);
  ASSERT_EQ(detail.ended_by_device.size(), 1u);
  EXPECT_EQ(detail.ended_by_device[0].summary.uuid, id.uuid);
  EXPECT_FALSE(detail.ended_by_device[0].summary.passed);
  EXPECT_EQ(line_of(database, "A").passes, 1);
}

/// Everybody tries both levels ten times below the mark; L2 is passed less often by decision, B passes most.
void fill(Database& database) {
  const std::map<std::string, int> wanted{{"AL1", 5}, {"AL2", 2}, {"BL1", 8}, {"BL2", 6}, {"CL1", 6}, {"CL2", 4}};
  for (const auto& [who_and_level, passes] : wanted)
    for (int i = 0; i < 10; ++i) {
      const AttemptId id = tried(database, who_and_level.substr(0, 1), 40, who_and_level.substr(1));
      if (i < passes)
        AssessmentStore(database).override_verdict(id.uuid, true, "All scores are below the mark here", kTeacher);
    }
}

TEST(Abilities, ComeFromVerdictsAsTheyCountAndOrderPeopleAndExercises) {
  Database database(":memory:");
  fill(database);
  ProgressRules rules;
  EXPECT_EQ(rasch_report(database, rules).missing, "There are 60 of the 200 attempts that an estimate asks for.");
  EXPECT_EQ(trainee_detail(database, "A", rules, kNow).ability_missing, rasch_report(database, rules).missing);
  rules.rasch_least_attempts = 60;
  rules.rasch_largest_se = 1;
  const RaschReport rasch = rasch_report(database, rules);
  EXPECT_EQ(rasch.missing, "");
  EXPECT_EQ(rasch.attempts, 60);
  ASSERT_EQ(rasch.items.size(), 2u);
  EXPECT_EQ(rasch.items[0].level, "L1") << "easiest first";
  EXPECT_LT(rasch.items[0].estimate.logit, rasch.items[1].estimate.logit);
  EXPECT_EQ(rasch.items[0].estimate.n, 30);
  const TraineeDetail a = trainee_detail(database, "A", rules, kNow), b = trainee_detail(database, "B", rules, kNow);
  ASSERT_TRUE(a.ability_logit && b.ability_logit);
  EXPECT_LT(*a.ability_logit, *b.ability_logit);
  EXPECT_EQ(a.ability_n, 20);
  EXPECT_GT(*a.ability_se, 0);
  rules.rasch_largest_se = 0.1;
  EXPECT_NE(trainee_detail(database, "A", rules, kNow).ability_missing.find("it is shown below 0.10"),
            std::string::npos);
  EXPECT_TRUE(rasch_report(database, rules).items.empty());
}

TEST(Abilities, SayWhatIsMissingToWhoOnlyPassed) {
  Database database(":memory:");
  fill(database);
  for (int i = 0; i < 5; ++i) tried(database, "D", 90);
  ProgressRules rules;
  rules.rasch_least_attempts = 60;
  const TraineeDetail detail = trainee_detail(database, "D", rules, kNow);
  EXPECT_FALSE(detail.ability_logit);
  EXPECT_NE(detail.ability_missing.find("only passes or only failures"), std::string::npos);
}

}  // namespace
}  // namespace trocar::verdict_query_test
