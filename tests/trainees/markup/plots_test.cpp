#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/sample_attempt.h"
#include "trainees/markup/plots.h"

namespace trocar::plots_test {
namespace {

using testing_support::sample_attempt;
using testing_support::sample_trace;

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

/// All coordinates of one attribute.
std::vector<double> numbers(const std::string& svg, const std::string& attribute) {
  std::vector<double> out;
  const std::string key = " " + attribute + "=\"";
  for (std::size_t at = svg.find(key); at != std::string::npos; at = svg.find(key, at + 1)) {
    const char* begin = svg.c_str() + at + key.size();
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    if (end != begin) out.push_back(value);
  }
  return out;
}

TEST(ForcePlot, StaysInsideItsFrame) {
  const std::string svg = force_plot_svg(sample_trace(), sample_attempt().events, {1, 2, 5});
  for (const char* x : {"x", "x1", "x2", "cx"})
    for (const double v : numbers(svg, x)) EXPECT_TRUE(v >= 0 && v <= 1000) << x << " " << v;
  for (const char* y : {"y", "y1", "y2", "cy"})
    for (const double v : numbers(svg, y)) EXPECT_TRUE(v >= 0 && v <= 322) << y << " " << v;
}

TEST(ForcePlot, ShowsBandLimitGripAndEveryEvent) {
  const std::string svg = force_plot_svg(sample_trace(), sample_attempt().events, {1, 2, 5});
  EXPECT_NE(svg.find("band 1 to 2 N"), std::string::npos);
  EXPECT_NE(svg.find("over the limit of 5 N"), std::string::npos);
  EXPECT_NE(svg.find("grip force"), std::string::npos);
  EXPECT_NE(svg.find(">5!<"), std::string::npos);  // the excess force, number 5 of the list
  std::size_t dashed = 0;
  for (std::size_t at = svg.find("stroke-dasharray"); at != std::string::npos;
       at = svg.find("stroke-dasharray", at + 1))
    ++dashed;
  EXPECT_EQ(dashed, sample_attempt().events.size());
}

TEST(ForcePlot, HoldsForNoSamplesAndNoLimits) {
  const std::string svg = force_plot_svg(Trace{}, {}, {});
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("band"), std::string::npos);
}

TEST(ForcePlot, SizeDoesNotGrowWithTheRecording) {
  Trace longer = sample_trace();
  const std::size_t first = force_plot_svg(longer, {}, {1, 2, 5}).size();
  const std::size_t n = longer.samples.size();
  for (int repeat = 1; repeat < 10; ++repeat)
    for (std::size_t i = 0; i < n; ++i) {
      longer.samples.push_back(longer.samples[i]);
      longer.samples.back().t_s += 20.0 * repeat;
    }
  EXPECT_LT(force_plot_svg(longer, {}, {1, 2, 5}).size(), 2.5 * static_cast<double>(first));
}

TEST(PathPlot, ColoursTheStrongTouchAndMarksStartAndEnd) {
  const std::string svg = path_plot_svg(sample_trace(), sample_attempt().events, {1, 2, 5});
  EXPECT_NE(svg.find("#d55e00"), std::string::npos);
  EXPECT_NE(svg.find("#009e73"), std::string::npos);
  EXPECT_NE(svg.find(">start<"), std::string::npos);
  EXPECT_NE(svg.find(">end<"), std::string::npos);
  EXPECT_NE(svg.find(" mm<"), std::string::npos);
  Trace gentle = sample_trace();
  for (TraceSample& s : gentle.samples) s.force_T.setZero();
  EXPECT_EQ(path_plot_svg(gentle, {}, {1, 2, 5}).find("#d55e00"), std::string::npos);
}

TEST(PathPlot, HoldsForAStillOrBrokenTip) {
  Trace still;
  still.samples.resize(5);
  EXPECT_EQ(path_plot_svg(still, {}, {}).find("nan"), std::string::npos);
  still.samples[2].tip_T.x() = std::nan("");
  EXPECT_EQ(path_plot_svg(still, {}, {}).find("nan"), std::string::npos);
  EXPECT_NE(path_plot_svg(Trace{}, {}, {}).find("no samples"), std::string::npos);
}

}  // namespace
}  // namespace trocar::plots_test
