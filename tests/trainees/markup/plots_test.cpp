#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trainees/markup/plots.h"
#include "trainees/markup/svg.h"

namespace trocar::plots_test {
namespace {

/// A record may hold any number, and whoever looks at it must not wait for ever.
TEST(AxisTicks, EndWhateverTheNumbersAre) {
  EXPECT_EQ(svg::ticks(0, 10, svg::nice_step(10, 5)), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const double infinite = std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::max();
  for (const double high : {infinite, most, 1e17 + 16, std::nan(""), -infinite})
    for (const double low : {0.0, 1e17, -infinite, std::nan("")})
      EXPECT_LE(svg::ticks(low, high, svg::nice_step(high - low, 5)).size(), 200U) << low << " " << high;
}

TEST(ColumnRanges, KeepTheShortestPeak) {
  std::vector<double> t, values;
  for (int i = 0; i < 60000; ++i) {
    t.push_back(0.001 * i);
    values.push_back(i == 31234 ? 7.7 : 0.1 * std::sin(0.01 * i));
  }
  const auto ranges = column_ranges(t, values, 60, 900);
  ASSERT_EQ(ranges.size(), 900U);
  double highest = 0;
  for (const ColumnRange& r : ranges) highest = std::max(highest, r.high);
  EXPECT_DOUBLE_EQ(highest, 7.7);
  for (std::size_t i = 1; i < ranges.size(); ++i) EXPECT_LT(ranges[i - 1].column, ranges[i].column);
}

TEST(ColumnRanges, LeaveOutWhatIsNotANumber) {
  const auto ranges = column_ranges({0, 1, 2}, {1, std::nan(""), 3}, 2, 2);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_DOUBLE_EQ(ranges[0].high, 1);
  EXPECT_DOUBLE_EQ(ranges[1].low, 3);
  EXPECT_TRUE(column_ranges({}, {}, 1, 10).empty());
}

TEST(ForceClass, FollowsBandAndLimit) {
  const ForceLimits band{1, 2, 5};
  EXPECT_EQ(force_class(0, band), 0);
  EXPECT_EQ(force_class(1, band), 1);
  EXPECT_EQ(force_class(2.5, band), 2);
  EXPECT_EQ(force_class(5, band), 3);
  EXPECT_EQ(force_class(9, ForceLimits{}), 0);
}

}  // namespace
}  // namespace trocar::plots_test
