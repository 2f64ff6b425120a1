// The cohort's lines against the slow way: every trainee's attempts read one by one, curves made of them, and judged.
#include <algorithm>
#include <set>
#include <tuple>

#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/trainee_store.h"

namespace trocar::cohort_query_test {
namespace {

constexpr const char* kNow = "2026-07-01T12:00:00Z";

Database& small() {
  static Database database = [] {
    Database made(":memory:");
    test::CohortPlan plan;
    plan.trainees = 12;
    plan.attempts = 900;
    plan.metrics = 6;
    plan.events = 3;
    fill_cohort(made, plan);
    return made;
  }();
  return database;
}

struct Slow {
  LearningCurve curve;
  std::vector<double> scores;
  double peak_sum = 0;
  int over = 0;
  std::vector<SafetyRecord> safety;
};

/// By trainee and curve; from AttemptStore::load alone.
std::map<std::pair<std::string, CurveKey>, Slow> the_slow_way(Database& database) {
  std::map<std::pair<std::string, CurveKey>, Slow> out;
  for (const Trainee& trainee : TraineeStore(database).list())
    for (LearningCurve& curve : learning_curves(past_attempts(database, trainee.code))) {
      Slow& slow = out[{trainee.code, curve.key}];
      slow.curve = curve;
      for (const PastAttempt& past : curve.attempts) {
        if (!past.summary.score) continue;
        slow.scores.push_back(*past.summary.score);
        slow.peak_sum += past.metrics.at("force_max_n");
      }
    }
  const AttemptStore store(database);
  for (const AttemptSummary& summary : store.list()) {
    const AttemptResult result = store.load(summary.row);
    SafetyRecord record{
        summary.uuid,
        0,
        0,
        summary.status == "void" || summary.status == "fault",
        result.device.saturated_contact_share > 0.05 || static_cast<double>(result.device.overruns) > 600,
        summary.started_utc};
    Slow& slow = out[{summary.trainee, {summary.exercise_id, summary.level, summary.hand, summary.rubric_sha256}}];
    for (const Event& event : result.events) {
      record.critical_events += event.severity == Severity::kCritical ? 1 : 0;
      slow.over += event.type == "EXCESS_FORCE" || event.type == "CRITICAL_FORCE" ? 1 : 0;
    }
    for (const Cap& cap : result.grade.caps) record.failed_gates += cap.kind == CapKind::kGate ? 1 : 0;
    slow.safety.push_back(record);
  }
  return out;
}

std::string said(const std::vector<Judgement>& judgements) {
  std::string out;
  for (const Judgement& j : judgements)
    out += std::string(flag_name(j.flag)) + ": " + j.evidence + " (" + std::to_string(j.n) + ")\n";
  return out;
}

TEST(CohortLines, AreWhatTheSlowWayFinds) {
  Database& database = small();
  const auto slow = the_slow_way(database);
  const auto lines = cohort_lines(database, {}, {}, kNow);
  ASSERT_EQ(lines.size(), slow.size());
  std::map<CurveKey, std::vector<std::vector<double>>> cohort;
  for (const auto& [who, s] : slow) cohort[who.second].push_back(s.scores);
  std::set<Flag> seen;
  for (const CohortLine& line : lines) {
    const auto at = slow.find({line.trainee, line.key});
    ASSERT_NE(at, slow.end());
    const Slow& s = at->second;
    EXPECT_EQ(line.tries, static_cast<int>(s.curve.attempts.size()));
    EXPECT_EQ(line.graded, s.curve.graded);
    EXPECT_EQ(line.passes, s.curve.passed);
    EXPECT_EQ(line.in_a_row, s.curve.in_a_row);
    EXPECT_EQ(line.best, s.curve.best);
    EXPECT_EQ(line.last, s.curve.last);
    EXPECT_EQ(line.over_force, s.over);
    EXPECT_NEAR(line.mean_peak_n.value_or(0), s.scores.empty() ? 0 : s.peak_sum / static_cast<double>(s.scores.size()),
                1e-12);
    const std::size_t shown = std::min<std::size_t>(s.scores.size(), kSparkScores);
    EXPECT_EQ(line.newest_scores,
              std::vector<double>(s.scores.end() - static_cast<std::ptrdiff_t>(shown), s.scores.end()));
    const std::vector<double> newest(
        s.scores.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(10, s.scores.size())), s.scores.end());
    const auto reliable =
        s.scores.size() < 3 ? std::nullopt : reliability(newest, between_variance(cohort[line.key], 10).value_or(0));
    EXPECT_EQ(line.reliability, reliable);
    EXPECT_EQ(said(line.judgements), said(judge(s.curve, s.safety, {}, reliable, "", kNow)));
    EXPECT_EQ(line.exercise_version, "1.0");
    for (const Judgement& j : line.judgements) seen.insert(j.flag);
  }
  EXPECT_GE(seen.size(), 5u) << "the sample shows most flags";
}

TEST(CohortLines, KnowTheNewestAttempt) {
  Database& database = small();
  const AttemptStore store(database);
  for (const CohortLine& line : cohort_lines(database, {}, {}, kNow)) {
    const AttemptSummary newest = store.find(line.last_uuid);
    EXPECT_EQ(newest.started_utc, line.last_utc);
    for (const AttemptSummary& other : store.list({line.trainee, line.key.exercise_id}))
      EXPECT_TRUE(other.level != line.key.level || other.hand != line.key.hand || other.row <= newest.row);
  }
}

TEST(CohortLines, AreOrderedAndFiltered) {
  Database& database = small();
  const auto all = cohort_lines(database, {}, {}, kNow);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const CohortLine& a, const CohortLine& b) {
    return std::tie(a.trainee, a.key) < std::tie(b.trainee, b.key);
  }));
  const auto count = [&](const CohortFilter& filter, auto holds) {
    const auto lines = cohort_lines(database, {}, filter, kNow);
    EXPECT_TRUE(std::all_of(lines.begin(), lines.end(), holds));
    EXPECT_EQ(static_cast<std::ptrdiff_t>(lines.size()), std::count_if(all.begin(), all.end(), holds));
    EXPECT_FALSE(lines.empty());
    EXPECT_LT(lines.size(), all.size());
  };
  count({.group = "2026 A"}, [](const CohortLine& l) { return l.groups == std::vector<std::string>{"2026 A"}; });
  count({.exercise = "surface-touch"}, [](const CohortLine& l) { return l.key.exercise_id == "surface-touch"; });
  count({.level = "L2"}, [](const CohortLine& l) { return l.key.level == "L2"; });
  count({.trainee = "p003"}, [](const CohortLine& l) { return l.trainee == "P003"; });
  count({.flag = Flag::kUnsafe}, [](const CohortLine& l) { return l.judgements.front().flag == Flag::kUnsafe; });
  EXPECT_TRUE(cohort_lines(database, {}, {.group = "nobody's"}, kNow).empty());
  EXPECT_TRUE(cohort_lines(database, {}, {.exercise = "' OR 1 = 1 --"}, kNow).empty());
}

TEST(CohortLines, ALineIsTheSameWhoeverElseIsAskedFor) {
  Database& database = small();
  const auto all = cohort_lines(database, {}, {}, kNow);
  for (const CohortLine& alone : cohort_lines(database, {}, {.trainee = "P005"}, kNow)) {
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const CohortLine& l) { return l.trainee == "P005" && l.key == alone.key; });
    ASSERT_NE(at, all.end());
    EXPECT_EQ(at->reliability, alone.reliability) << "the cohort is everybody, not those shown";
    EXPECT_EQ(said(at->judgements), said(alone.judgements));
  }
}

TEST(CohortLines, GravestFirstAndOfTheUnsafeTheWorstElseTheOrderIsKept) {
  auto lines = cohort_lines(small(), {}, {}, kNow);
  sort_by_gravity(lines);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const auto before = lines[k - 1].judgements.front().flag, here = lines[k].judgements.front().flag;
    EXPECT_LE(before, here);
    if (before == Flag::kUnsafe && here == before)
      EXPECT_FALSE(worse(*lines[k].harm, *lines[k - 1].harm));
    else
      EXPECT_TRUE(before != here || lines[k - 1].trainee <= lines[k].trainee);
  }
}

TEST(CohortLines, RunningAttemptsAreNotThereYet) {
  Database database(":memory:");
  EXPECT_TRUE(cohort_lines(database, {}, {}, kNow).empty());
  AttemptStore(database).begin_attempt(sample_start("A"));
  EXPECT_TRUE(cohort_lines(database, {}, {}, kNow).empty());
  store_attempt(database, sample_start("A"), sample_result(80));
  const auto lines = cohort_lines(database, {}, {}, kNow);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].tries, 1);
  EXPECT_EQ(lines[0].over_force, 1);
  EXPECT_NEAR(*lines[0].mean_peak_n, 2.8, 1e-12);
  EXPECT_FALSE(lines[0].reliability);
  EXPECT_EQ(lines[0].judgements.front().flag, Flag::kLearning);
}

TEST(CohortLines, CertificatesThatHoldBringPeopleBack) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(80));
  AssessmentStore assessments(database);
  const Certificate first = assessments.certify("A", "surface-touch", "L1", "1", "{}", {"", "Dr. B"});
  const auto after = [&](int days) { return utc_of_seconds(*seconds_of_utc(first.utc) + days * kSecondsADay); };
  EXPECT_EQ(cohort_lines(database, {}, {}, after(13))[0].certified_utc, first.utc);
  EXPECT_EQ(cohort_lines(database, {}, {}, after(13))[0].judgements.front().flag, Flag::kCertified);
  EXPECT_EQ(cohort_lines(database, {}, {}, after(14))[0].judgements.front().flag, Flag::kRetentionDue);
  assessments.revoke(first.uuid, "given to the wrong person", {"", "Dr. B"});
  EXPECT_EQ(cohort_lines(database, {}, {}, after(14))[0].certified_utc, "");
  EXPECT_EQ(cohort_lines(database, {}, {}, after(14))[0].judgements.front().flag, Flag::kLearning);
}

TEST(CohortSamples, MakeAChainThatHolds) { EXPECT_EQ(small().check(), std::vector<std::string>{}); }

}  // namespace
}  // namespace trocar::cohort_query_test
