// Who is at risk, in order, with the size and the reason.
#include "trainees/desk/queries/harm.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"

namespace trocar::harm_test {
namespace {

Harm of(int critical, double peak_n, int excess, int unsafe, int before) {
  Harm harm;
  harm.attempts = 5;
  harm.unsafe = unsafe;
  harm.attempts_before = 5;
  harm.unsafe_before = before;
  harm.peak_n = peak_n;
  harm.limit_n = 2;
  if (critical > 0) harm.events.push_back({"WRONG_STRUCTURE", true, critical});
  if (excess > 0) harm.events.push_back({"EXCESS_FORCE", false, excess});
  return harm;
}

TEST(Harm, IsOrderedByKindThenForceThenNumberThenTrend) {
  const Harm falling[] = {of(2, 1, 0, 2, 2), of(1, 6, 9, 5, 0), of(0, 6, 1, 2, 2), of(0, 4, 9, 5, 2),
                          of(0, 4, 9, 4, 2), of(0, 4, 8, 5, 2), of(0, 1, 8, 5, 2)};
  for (std::size_t i = 0; i < std::size(falling); ++i) {
    for (std::size_t j = 0; j < std::size(falling); ++j)
      EXPECT_EQ(worse(falling[i], falling[j]), i < j) << i << " " << j;
  }
  EXPECT_TRUE(worse(of(0, 4, 9, 4, 1), of(0, 4, 9, 4, 2))) << "was better before";
  Harm unknown = of(0, 1.8, 28, 2, 2);
  unknown.limit_n = 0;
  EXPECT_TRUE(worse(unknown, of(0, 1.6, 1, 2, 2))) << "under the limit the number of events decides";
}

TEST(Harm, SaysHowMuchOfWhat) {
  Harm harm = of(1, 3.04, 34, 5, 2);
  harm.limit_n = 1.5;
  harm.gates = {"force in band 31 %, the gate asks 65 % or more"};
  EXPECT_EQ(harm_sentence(harm),
            "5 of the last 5 attempts were unsafe (2 of the 5 before: getting worse): critical: wrong structure once; "
            "peak force 3.0 N, 2.0 times the limit of 1.5 N; excess force 34 times; at worst force in band 31 %, the "
            "gate asks 65 % or more");
  harm.limit_n = 0;
  harm.attempts_before = 0;
  harm.gates.clear();
  EXPECT_EQ(harm_sentence(harm),
            "5 of the last 5 attempts were unsafe: critical: wrong structure once; peak force 3.0 N; excess force 34 "
            "times");
  harm = of(0, 1.2, 0, 2, 4);
  EXPECT_EQ(harm_sentence(harm),
            "2 of the last 5 attempts were unsafe (4 of the 5 before: getting better): peak force 1.2 N, under the "
            "limit of 2 N");
}

AttemptResult gate_failed(double raw_n, double peak_n) {
  AttemptResult result = sample_result(50);
  result.grade.metrics = {{"force_max_n", peak_n, "N"}};
  result.grade.subscores = {{"force", (6 - raw_n) / 4, 1, raw_n, "N", 2, 6, true}};
  result.grade.caps = {{.kind = CapKind::kGate, .subject = "force", .below = 0.5, .at_most = 59}};
  result.events = {{1, "EXCESS_FORCE", Severity::kMajor, 0, peak_n, "N", Vec3::Zero()},
                   {2, "TIMEOUT", Severity::kMajor, -1, 90, "s", Vec3::Zero()}};
  return result;
}

TEST(Harm, IsReadFromTheAttemptsOfTheRulesWindowAlone) {
  Database database(":memory:");
  const auto attempt = [&database](const char* who, const AttemptResult& result) {
    store_attempt(database, sample_start(who), result);
  };
  attempt("MILD", gate_failed(5.9, 9.5));  // long ago, and the worst
  for (int i = 0; i < 3; ++i) attempt("MILD", sample_result(80));
  for (const double raw : {4.5, 5.0}) attempt("MILD", gate_failed(raw, 2.1));
  for (const double raw : {4.5, 5.5}) attempt("BAD", gate_failed(raw, 6.2));
  ProgressRules rules;
  rules.unsafe_window = 2;
  auto lines = cohort_lines(database, rules, {}, "2026-07-01T12:00:00Z");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].trainee, "BAD");
  sort_by_gravity(lines);
  ASSERT_TRUE(lines[0].harm && lines[1].harm);
  EXPECT_EQ(lines[0].trainee, "BAD");
  const Harm& mild = *lines[1].harm;
  EXPECT_EQ(mild.attempts, 2);
  EXPECT_EQ(mild.unsafe, 2);
  EXPECT_EQ(mild.attempts_before, 2);
  EXPECT_DOUBLE_EQ(*mild.peak_n, 2.1);
  ASSERT_EQ(mild.events.size(), 1u) << "that time ran out is no harm";
  EXPECT_EQ(mild.events[0].type, "EXCESS_FORCE");
  EXPECT_EQ(mild.events[0].count, 2);
  EXPECT_EQ(mild.gates, (std::vector<std::string>{"force 5 N, the gate asks 4 N or less"}));
}

}  // namespace
}  // namespace trocar::harm_test
