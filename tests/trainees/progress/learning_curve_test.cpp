// Own attempts with their numbers: read back whole, never mixed over inputs or rubrics, medians, and an export that
// others can read.
#include "trainees/progress/learning_curve.h"

#include <cmath>

#include "tests/trainees/records/store_samples.h"

namespace trocar::learning_curve_test {
namespace {

PastAttempt run(double score, bool passed, const std::string& hand = "mouse", const std::string& level = "L1") {
  PastAttempt a;
  a.summary.uuid = "u" + std::to_string(score);
  a.summary.exercise_id = "surface-touch";
  a.summary.level = level;
  a.summary.hand = hand;
  a.summary.rubric_sha256 = "r";
  a.summary.status = "completed";
  a.summary.score = score;
  a.summary.passed = passed;
  a.metrics = {{"time_s", 40}};
  return a;
}

std::vector<std::string> lines(const std::string& csv) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from < csv.size();) {
    const std::size_t end = csv.find("\r\n", from);
    out.push_back(csv.substr(from, end - from));
    from = end + 2;
  }
  return out;
}

TEST(Quartiles, LieBetweenValuesInProportion) {
  EXPECT_FALSE(quartiles({}));
  EXPECT_EQ(quartiles({7})->median, 7);
  const auto four = quartiles({4, 1, 3, 2});  // type 7: 1.75, 2.5, 3.25
  EXPECT_DOUBLE_EQ(four->low, 1.75);
  EXPECT_DOUBLE_EQ(four->median, 2.5);
  EXPECT_DOUBLE_EQ(four->high, 3.25);
  EXPECT_DOUBLE_EQ(quartiles({1, 2, 3, 4, 5})->low, 2);
}

TEST(LearningCurves, KeepInputsLevelsAndRubricsApart) {
  std::vector<PastAttempt> newest_first{run(80, true, "device"), run(70, false), run(60, false),
                                        run(90, true, "mouse", "L2")};
  newest_first.push_back(run(50, false));
  newest_first.back().summary.rubric_sha256 = "older";
  const auto curves = learning_curves(newest_first);
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_EQ(curves[0].key.hand, "device") << "the newest first";
  EXPECT_EQ(curves[1].attempts.size(), 2u);
  EXPECT_EQ(*curves[1].attempts.front().summary.score, 60) << "within a curve the oldest first";
  EXPECT_EQ(curves[2].key.level, "L2");
  EXPECT_EQ(curves[3].key.rubric_sha256, "older");
}

TEST(LearningCurves, CountWhatWasTriedButNotWhatTheDeviceEnded) {
  std::vector<PastAttempt> newest_first{run(88, true), run(80, true), run(70, false), run(85, true)};
  PastAttempt left = run(0, false);
  left.summary.status = "aborted";
  left.summary.score.reset();
  left.metrics.clear();
  PastAttempt broken = left;
  broken.summary.status = "fault";
  broken.summary.ended_by_device = true;
  newest_first.insert(newest_first.begin() + 1, {broken, left});
  const LearningCurve c = learning_curves(newest_first).front();
  EXPECT_EQ(c.attempts.size(), 5u);
  EXPECT_EQ(c.graded, 4);
  EXPECT_EQ(c.passed, 3);
  EXPECT_EQ(c.in_a_row, 1) << "who leaves breaks the row";
  EXPECT_EQ(c.trained_s, 160);
  EXPECT_EQ(c.best, 88);
  EXPECT_EQ(c.last, 88);
  EXPECT_EQ(c.passes(), (std::vector<bool>{true, false, true, false, true}));
}

TEST(LearningCurves, WhatWasSwitchedOffInTheRunIsATryThatFailed) {
  Database database(":memory:");
  const auto stored = [&](AttemptStatus status, const std::vector<std::string>& events) {
    AttemptResult result = sample_result();
    result.grade = {};
    result.grade.status = status;
    result.events.clear();
    for (const std::string& type : events) {
      Event event;
      event.t_s = static_cast<double>(result.events.size());
      event.type = type;
      result.events.push_back(event);
    }
    store_attempt(database, sample_start("A"), result);
    const PastAttempt read = past_attempts(database, "A").front(), made = past_attempt(result);
    EXPECT_EQ(read.summary.ended_by_device, made.summary.ended_by_device);
    EXPECT_EQ(read.summary.begun, made.summary.begun);
    return read.summary;
  };
  const AttemptSummary off = stored(AttemptStatus::kVoid, {"START", "DEADMAN_OPEN"});
  EXPECT_FALSE(off.ended_by_device);
  EXPECT_TRUE(off.begun);
  const AttemptSummary unfit = stored(AttemptStatus::kVoid, {"START", "DONE"});
  EXPECT_TRUE(unfit.ended_by_device) << "its record cannot be graded";
  EXPECT_TRUE(unfit.begun);
  EXPECT_FALSE(stored(AttemptStatus::kVoid, {"TIMEOUT"}).begun);
  EXPECT_FALSE(stored(AttemptStatus::kFault, {"DEVICE_FAULT"}).begun);
  EXPECT_TRUE(stored(AttemptStatus::kFault, {"START", "DEVICE_FAULT"}).begun);
  EXPECT_TRUE(stored(AttemptStatus::kAborted, {}).begun) << "who leaves has been there";
  const std::vector<LearningCurve> curves = learning_curves(past_attempts(database, "A"));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves.front().passes(), (std::vector<bool>{false, false})) << "switched off, left";
}

TEST(LearningCurves, TheBandIsOfTheNewestTenAndNotOfTwo) {
  std::vector<PastAttempt> newest_first{run(80, true), run(70, false)};
  EXPECT_FALSE(learning_curves(newest_first).front().band);
  for (int i = 0; i < 30; ++i) newest_first.push_back(run(10, false));
  const auto band = learning_curves(newest_first).front().band;
  EXPECT_DOUBLE_EQ(band->median, 10);
  newest_first.clear();
  for (int i = 0; i < 10; ++i) newest_first.push_back(run(90, true));
  newest_first.push_back(run(0, false));
  EXPECT_DOUBLE_EQ(learning_curves(newest_first).front().band->low, 90);
}

TEST(OwnValues, BestIsTheOneNearerFullMarks) {
  std::vector<PastAttempt> own{run(80, true), run(70, false), run(60, false)};
  own[0].metrics = {{"time_s", 50}};
  own[1].metrics = {{"time_s", 40}};
  own[2].metrics = {{"force", 1}};
  EXPECT_EQ(own_values(own, "time_s", true).best, 40);
  EXPECT_EQ(own_values(own, "time_s", false).best, 50);
  EXPECT_EQ(own_values(own, "time_s", true).median, 45);
  EXPECT_EQ(own_values(own, "time_s", true).count, 2);
  EXPECT_FALSE(own_values(own, "unknown", true).best);
  own[1].summary.score.reset();
  EXPECT_EQ(own_values(own, "time_s", true).best, 50) << "what was not graded does not count";
}

TEST(PastAttempts, ComeBackFromTheStoreAsTheResultHadThem) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(80));
  store_attempt(database, sample_start("B"), sample_result(50));
  AttemptResult aborted = sample_result();
  aborted.grade = {};
  store_attempt(database, sample_start("A"), aborted);
  AttemptStart other = sample_start("A");
  other.exercise_id = "limited-grasp";
  store_attempt(database, other, sample_result(60));
  AttemptStore(database).begin_attempt(sample_start("A"));
  const auto all = past_attempts(database, "a");
  ASSERT_EQ(all.size(), 3u) << "codes know no case, what still runs is not past";
  EXPECT_EQ(all[0].summary.exercise_id, "limited-grasp");
  EXPECT_FALSE(all[1].summary.score);
  EXPECT_EQ(all[2].metrics, (std::map<std::string, double>{{"time_s", 41.5}, {"force_max_n", 2.8}}))
      << "an undefined metric is missing";
  EXPECT_EQ(past_attempts(database, "A", "surface-touch").size(), 2u);
  EXPECT_TRUE(past_attempts(database, "nobody").empty());
  const PastAttempt same = past_attempt(AttemptStore(database).load(all[2].summary.uuid));
  EXPECT_EQ(same.metrics, all[2].metrics);
  EXPECT_EQ(same.summary.rubric_sha256, all[2].summary.rubric_sha256);
  EXPECT_EQ(std::tie(same.summary.level, same.summary.board, same.summary.hand, same.summary.status),
            std::tie(all[2].summary.level, all[2].summary.board, all[2].summary.hand, all[2].summary.status));
}

TEST(AttemptsCsv, HasOneColumnAMetricAndEmptyCellsForWhatIsMissing) {
  PastAttempt a = run(1.0 / 3, false), b = run(90, true);
  a.metrics = {{"time_s", 0.1}};
  b.metrics = {{"force_max_n", 2}};
  const auto csv = lines(attempts_csv({a, b}));
  ASSERT_EQ(csv.size(), 3u);
  EXPECT_TRUE(csv[0].ends_with(",rubric_sha256,force_max_n,time_s"));
  EXPECT_TRUE(csv[1].ends_with(",r,,0.1")) << csv[1];
  EXPECT_TRUE(csv[2].ends_with(",r,2,")) << csv[2];
  EXPECT_NE(csv[1].find("," + std::string("0.3333333333333333") + ","), std::string::npos) << "to the bit";
  for (const std::string& line : csv) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 19) << line;
}

TEST(AttemptsCsv, QuotesWhatWouldBreakALine) {
  PastAttempt a = run(50, false);
  a.summary.integrity = "stopped, \"pulled\"\nout";
  EXPECT_NE(attempts_csv({a}).find("\"stopped, \"\"pulled\"\"\nout\""), std::string::npos);
  EXPECT_EQ(lines(attempts_csv({})).size(), 1u) << "the heads alone";
}

}  // namespace
}  // namespace trocar::learning_curve_test
