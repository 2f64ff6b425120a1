// Counted durations against a sorted list.
#include "app/session/lanes/timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace trocar::timing_test {
namespace {

TEST(DurationCounts, NothingCountedIsZero) {
  const DurationCounts counts;
  EXPECT_EQ(counts.count(), 0u);
  EXPECT_EQ(counts.percentile_us(0.99), 0);
  EXPECT_EQ(counts.max_ns(), 0);
}

TEST(DurationCounts, PercentilesAreThoseOfTheSortedListToABin) {
  std::mt19937 random(3);
  std::lognormal_distribution<double> us(3.5, 1.6);  // from a few us to tens of ms
  DurationCounts counts;
  std::vector<double> all;
  for (int i = 0; i < 20000; ++i) {
    all.push_back(us(random));
    counts.add(std::llround(1000 * all.back()));
  }
  std::sort(all.begin(), all.end());
  for (const double share : {0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double exact = all[static_cast<std::size_t>(std::ceil(share * static_cast<double>(all.size()))) - 1];
    const double bin = exact < 4000 ? 1 : 100;  // widths of the bins
    EXPECT_GE(counts.percentile_us(share), exact - 1e-3) << share;
    EXPECT_LE(counts.percentile_us(share), exact + bin) << share;
  }
  EXPECT_NEAR(static_cast<double>(counts.max_ns()) * 1e-3, all.back(), 1e-3);
}

TEST(DurationCounts, CountsWhatIsAboveALimit) {
  DurationCounts counts;
  for (const std::int64_t us : {10, 499, 500, 999, 1000, 5000, 2'000'000}) counts.add(1000 * us);
  EXPECT_EQ(counts.above_us(500), 5u);
  EXPECT_EQ(counts.above_us(1000), 3u);
  EXPECT_EQ(counts.percentile_us(1), 2e6) << "beyond the bins the maximum stands";
}

TEST(DurationCounts, BinsAddUpAndAreToldFromBelow) {
  DurationCounts counts, others;
  counts.add(7'200, 3);
  counts.add(5'000'000);
  others.add(7'900);
  others.add(2'000'000'000);
  counts.add(others);
  EXPECT_EQ(counts.count(), 6u);
  EXPECT_EQ(counts.max_ns(), 2'000'000'000);
  std::vector<std::pair<std::int64_t, std::uint64_t>> told;
  counts.each([&](std::int64_t lower_us, std::uint64_t count) { told.emplace_back(lower_us, count); });
  EXPECT_EQ(told, (std::vector<std::pair<std::int64_t, std::uint64_t>>{{7, 4}, {5000, 1}, {1'000'000, 1}}));
}

TEST(DurationCounts, AWakeBeforeItsTimeIsOnTime) {
  DurationCounts counts;
  counts.add(-5);
  EXPECT_EQ(counts.count(), 1u);
  EXPECT_EQ(counts.max_ns(), 0);
}

}  // namespace
}  // namespace trocar::timing_test
