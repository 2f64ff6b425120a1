// Limits from people: numbers by hand, contrasting groups against closed forms and counted errors.
#include "trainees/progress/benchmarks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trocar::benchmarks_test {
namespace {

std::vector<PersonValue> persons(std::initializer_list<double> values) {
  std::vector<PersonValue> out;
  for (const double value : values) out.push_back({"P" + std::to_string(out.size() + 1), value});
  return out;
}

double density(double x, double mean, double sd) { return std::exp(-0.5 * std::pow((x - mean) / sd, 2)) / sd; }

TEST(Benchmarks, MeanLessTwoSdByHand) {
  // 80, 90, 100: mean 90, SD 10.
  const auto b = derive_benchmark(BenchmarkRule::kMeanLessSds, persons({80, 90, 100}), false, 2, "experts of ward 3",
                                  "2026-03-01T00:00:00Z");
  EXPECT_NEAR(b->limit, 70, 1e-12);
  EXPECT_NEAR(b->mean, 90, 1e-12);
  EXPECT_NEAR(b->sd, 10, 1e-12);
  EXPECT_EQ(b->n, 3);
  EXPECT_EQ(b->who, "experts of ward 3");
  EXPECT_EQ(b->utc, "2026-03-01T00:00:00Z");
  EXPECT_EQ(b->text, "mean 90 - 2 SD of 10 over 3 persons");
  EXPECT_FALSE(b->theoretical);
  EXPECT_NEAR(derive_benchmark(BenchmarkRule::kMeanLessSds, persons({80, 90, 100}), true, 1, "", "")->limit, 100, 1e-12)
      << "less is better";
}

TEST(Benchmarks, MedianAndBestQuartile) {
  const auto people = persons({10, 20, 30, 40, 50});
  EXPECT_EQ(derive_benchmark(BenchmarkRule::kMedian, people, false, 0, "", "")->limit, 30);
  EXPECT_EQ(derive_benchmark(BenchmarkRule::kBestQuartile, people, false, 0, "", "")->limit, 40);
  EXPECT_EQ(derive_benchmark(BenchmarkRule::kBestQuartile, people, true, 0, "", "")->limit, 20);
}

TEST(Benchmarks, TwoPersonsAreNoBenchmark) {
  EXPECT_FALSE(derive_benchmark(BenchmarkRule::kMedian, persons({10, 20}), false, 0, "", ""));
  EXPECT_FALSE(contrast_groups(persons({80, 90}), persons({10, 20, 30}), false, "", ""));
  EXPECT_FALSE(derive_benchmark(BenchmarkRule::kContrastingGroups, persons({1, 2, 3}), false, 0, "", ""))
      << "wants the other group";
}

TEST(Crossing, OfEqualSpreadsLiesInTheMiddle) {
  EXPECT_NEAR(*density_crossing(80, 7, 50, 7), 65, 1e-9);
  EXPECT_NEAR(*density_crossing(50, 7, 80, 7), 65, 1e-9);
}

TEST(Crossing, OfUnequalSpreadsIsTheRootBetween) {
  // sd 1 at 0 and sd 2 at 4: 3 x^2 + 8 x - 16 - 8 ln 2 = 0.
  EXPECT_NEAR(*density_crossing(0, 1, 4, 2), (-8 + std::sqrt(64 + 12 * (16 + 8 * std::log(2.0)))) / 6, 1e-12);
  std::mt19937 random(5);
  const auto draw = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const double ma = draw(0, 50), mb = draw(50, 100), sa = draw(1, 15), sb = draw(1, 15);
    const auto x = density_crossing(ma, sa, mb, sb);
    if (!x) continue;
    ++found;
    EXPECT_GT(*x, ma);
    EXPECT_LT(*x, mb);
    EXPECT_NEAR(density(*x, ma, sa), density(*x, mb, sb), 1e-9);
    EXPECT_NEAR(*x, *density_crossing(mb, sb, ma, sa), 1e-7);
  }
  EXPECT_GT(found, 1500);
}

TEST(Crossing, ThereIsNoneWhereOneGroupDrownsTheOther) {
  EXPECT_FALSE(density_crossing(50, 1, 50.1, 20)) << "the wide density lies below the narrow one at both means";
  EXPECT_FALSE(density_crossing(50, 5, 50, 5));
  EXPECT_FALSE(density_crossing(50, 0, 80, 5));
}

TEST(ContrastingGroups, RatesOfEqualSpreadsAreThoseOfTheTable) {
  // SD 10 each, means 60 and 80: the limit 70 is one SD from both: 15.87 % on either side.
  const auto b = contrast_groups(persons({70, 80, 90}), persons({50, 60, 70}), false, "PGY5 and students", "");
  EXPECT_NEAR(b->limit, 70, 1e-9);
  EXPECT_NEAR(b->theoretical->false_pass, 0.158655, 1e-6);
  EXPECT_NEAR(b->theoretical->false_fail, 0.158655, 1e-6);
  EXPECT_EQ(b->n, 3);
  EXPECT_EQ(b->n_other, 3);
}

TEST(ContrastingGroups, ObservedRatesAreCounted) {
  const auto b = contrast_groups(persons({60, 85, 90, 95}), persons({40, 45, 50, 80}), false, "", "");
  ASSERT_TRUE(b);
  EXPECT_GT(b->limit, 60);
  EXPECT_LT(b->limit, 80);
  EXPECT_DOUBLE_EQ(b->observed->false_pass, 0.25);
  EXPECT_DOUBLE_EQ(b->observed->false_fail, 0.25);
}

TEST(ContrastingGroups, LessIsBetterIsTheSameMirrored) {
  const auto up = contrast_groups(persons({70, 82, 95}), persons({40, 55, 66, 30}), false, "", "");
  const auto down = contrast_groups(persons({-70, -82, -95}), persons({-40, -55, -66, -30}), true, "", "");
  EXPECT_NEAR(up->limit, -down->limit, 1e-9);
  EXPECT_NEAR(up->theoretical->false_pass, down->theoretical->false_pass, 1e-12);
  EXPECT_NEAR(up->theoretical->false_fail, down->theoretical->false_fail, 1e-12);
  EXPECT_EQ(up->observed->false_pass, down->observed->false_pass);
}

TEST(ContrastingGroups, TheCompetentMustBeTheBetterOnes) {
  EXPECT_FALSE(contrast_groups(persons({50, 60, 70}), persons({70, 80, 90}), false, "", ""));
  EXPECT_TRUE(contrast_groups(persons({50, 60, 70}), persons({70, 80, 90}), true, "", ""));
}

TEST(WhoWouldPass, NamesThemAtTheLimitToo) {
  const auto people = persons({60, 75, 90});
  EXPECT_EQ(who_would_pass(75, false, people), (std::vector<std::string>{"P2", "P3"}));
  EXPECT_EQ(who_would_pass(75, true, people), (std::vector<std::string>{"P1", "P2"}));
  EXPECT_TRUE(who_would_pass(95, false, people).empty());
}

TEST(Benchmarks, RulesHaveNames) {
  EXPECT_STREQ(benchmark_rule_name(BenchmarkRule::kContrastingGroups), "contrasting groups");
  EXPECT_STREQ(benchmark_rule_name(BenchmarkRule::kMeanLessSds), "mean - SD");
}

TEST(LawfulRange, EveryKindOfMetricHasItsOwn) {
  struct Row {
    const char *metric, *words;
    std::vector<double> good, bad;
  };
  for (const Row& row : {Row{"score", "from 0 to 100", {0, 75, 100}, {-0.1, 100.1, NAN, INFINITY}},
                         {"idle_share", "from 0 to 1", {0, 1}, {-0.01, 1.01}},
                         {"economy", "from 0 to 1", {0.5}, {1.2}},
                         {"force_max_n", "0 or more", {0, 4000}, {-1, INFINITY}},
                         {"angle_error_deg", "from 0 to 180", {180}, {181, -1}},
                         {"sparc", "0 or less", {-2.5, 0}, {0.1}}}) {
    const LawfulRange range = lawful_range(row.metric);
    EXPECT_EQ(range_words(range), row.words) << row.metric;
    for (const double value : row.good) EXPECT_TRUE(lawful(range, value)) << row.metric << " " << value;
    for (const double value : row.bad) EXPECT_FALSE(lawful(range, value)) << row.metric << " " << value;
  }
}

TEST(ReliabilityOfMeans, IsWhatChanceWithinLeavesOfTheSpreadBetween) {
  // Means 10, 20, 30: variance 100. Within: 9, 10, 11 (variance 1) each, of the mean 1/3: (100 - 1/3) / 100.
  const std::vector<std::vector<double>> clear{{9, 10, 11}, {19, 20, 21}, {29, 30, 31}};
  ASSERT_TRUE(reliability_of_means(clear));
  EXPECT_NEAR(*reliability_of_means(clear), 1 - 1.0 / 300, 1e-12);
  EXPECT_EQ(*reliability_of_means({{0, 50, 100}, {1, 51, 101}, {2, 52, 102}}), 0) << "chance alone explains it";
  EXPECT_FALSE(reliability_of_means({{9, 10, 11}, {19, 20, 21}}));
  EXPECT_FALSE(reliability_of_means({{9, 10, 11}, {19, 20, 21}, {30}}));
  EXPECT_FALSE(reliability_of_means({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}})) << "nothing to tell apart";
}

}  // namespace
}  // namespace trocar::benchmarks_test
