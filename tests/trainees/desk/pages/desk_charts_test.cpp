#include <gtest/gtest.h>

#include <numeric>

#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/charts.h"

namespace trocar::review::desk_charts_test {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

Trace trace_of(const std::vector<Vec3>& tips) {
  Trace trace;
  for (const Vec3& tip : tips) {
    TraceSample sample;
    sample.t_s = 0.1 * static_cast<double>(trace.samples.size());
    sample.tip_T = tip;
    trace.samples.push_back(sample);
  }
  return trace;
}

TEST(Histogram, CountsEveryTickInItsCell) {
  // A box of 40 by 20 mm in cells of 10 mm; one tick at each corner, three in one cell, the rest none.
  Trace trace = trace_of({{0, 0, 0},
                          {0.04, 0, 0},
                          {0, 0.02, 0},
                          {0.04, 0.02, 0},
                          {0.015, 0.005, 0},
                          {0.016, 0.006, 0},
                          {0.017, 0.004, 0}});
  const Histogram2 h = tip_histogram(trace, kFromAbove, false, 4);
  EXPECT_EQ(h.columns, 4);
  EXPECT_EQ(h.rows, 2);
  EXPECT_DOUBLE_EQ(h.cell_m, 0.01);
  EXPECT_EQ(h.ticks, (std::vector<int>{1, 3, 0, 1, 1, 0, 0, 1}));
  EXPECT_EQ(h.most, 3);
  EXPECT_EQ(h.total, 7);
}

TEST(Histogram, ContactsOnlyKeepsTheBoxOfThePath) {
  Trace trace = trace_of({{0, 0, 0}, {0.04, 0.02, 0}, {0.015, 0.005, 0}});
  trace.samples[2].contact = true;
  const Histogram2 h = tip_histogram(trace, kFromAbove, true, 4);
  EXPECT_EQ(h.ticks, (std::vector<int>{0, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(h.total, 1);
}

TEST(Histogram, TotalsAreTheTicksFromEverySide) {
  const Trace trace = sample_trace();
  for (const Projection& view : {kFromAbove, kFromFront, kFromSide}) {
    const Histogram2 all = tip_histogram(trace, view, false, 40), touched = tip_histogram(trace, view, true, 40);
    EXPECT_EQ(all.total, 6001);
    EXPECT_EQ(std::accumulate(all.ticks.begin(), all.ticks.end(), 0), 6001);
    EXPECT_EQ(touched.total, 2001);
  }
}

TEST(Histogram, NothingToCount) {
  EXPECT_EQ(tip_histogram({}, kFromAbove, false, 40).total, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tip_histogram(trace_of({{nan, 0, 0}}), kFromAbove, false, 40).total, 0);
  EXPECT_EQ(tip_histogram(trace_of({{0, 0, 0}}), kFromAbove, false, 40).total, 1);  // a tip that stood still
  EXPECT_NE(heat_svg(sample_trace(0), kFromAbove, false).find("<rect"), std::string::npos);
  EXPECT_NE(heat_svg(trace_of({{0, 0, 0}}), kFromAbove, true).find("nothing was touched"), std::string::npos);
}

TEST(Path, ColoursByForceClassAndMarksEndsAndMoment) {
  const std::string svg = path_svg(sample_trace(2.0), kFromAbove, {0.4, 0.8, 1.5}, 30);
  for (const char* colour : {"#7a8794", "#009e73", "#e69f00", "#d55e00"})
    EXPECT_GE(count(svg, std::string("stroke=\"") + colour), 1U) << colour;
  EXPECT_EQ(count(svg, "<title>start"), 1U);
  EXPECT_EQ(count(svg, "<title>end"), 1U);
  EXPECT_EQ(count(svg, "<title>tip at this moment"), 1U);
  EXPECT_EQ(count(path_svg(sample_trace(2.0), kFromAbove, {}, -1), "tip at this moment"), 0U);
  EXPECT_NE(path_svg({}, kFromAbove, {}, 0).find("no samples"), std::string::npos);
}

TEST(Path, ScaleBarIsInMillimetresAndNamesTheAxes) {
  const std::string svg = path_svg(sample_trace(), kFromSide, {}, -1);  // 40 mm of y, 60 mm of z: 60 mm over 276 px
  EXPECT_NE(svg.find(">20 mm<"), std::string::npos) << svg;
  EXPECT_EQ(axes_words(kFromSide), "from the side (y right, z up)");
  EXPECT_NE(svg.find("x2=\"114.0\""), std::string::npos);  // 22 + 20 / 60 * 276
}

TEST(SampleAt, TakesTheNearestRow) {
  Trace trace = trace_of({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  for (TraceSample& sample : trace.samples) sample.t_s += 50;
  EXPECT_NEAR(length_s(trace), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(sample_at(trace, 0.04)->tip_T.x(), 1);
  EXPECT_DOUBLE_EQ(sample_at(trace, 0.06)->tip_T.x(), 2);
  EXPECT_DOUBLE_EQ(sample_at(trace, 99)->tip_T.x(), 3);
  EXPECT_DOUBLE_EQ(sample_at(trace, -1)->tip_T.x(), 1);
  EXPECT_EQ(sample_at({}, 0), nullptr);
  EXPECT_EQ(length_s({}), 0);
}

TEST(TimePlotTest, AKeyThatDoesNotFitGoesOnInAFurtherRow) {
  const Trace trace = sample_trace();
  TimePlot plot;
  plot.limits = {0.4, 0.8, 1.5};
  const auto height = [&](const std::string& words) {
    plot.lines = {{&trace, false, words, "#0072b2", ""}, {&trace, false, words, "#d55e00", ""}};
    const std::string svg = time_plot_svg(plot);
    EXPECT_NE(svg.find("over 1.5 N"), std::string::npos);
    const std::size_t at = svg.find("viewBox=\"0 0 ");
    return std::stod(svg.substr(svg.find(' ', at + 13)));
  };
  EXPECT_EQ(height("demo-amara, 2026-11-20"), height("short") + 22);
}

TEST(TimePlotTest, CursorStripsAndEventsStandAtTheirTimes) {
  const Trace trace = sample_trace(5);
  TimePlot plot;
  plot.lines = {{&trace, false, "force", "#1d2630", ""}};
  plot.limits = {0.4, 0.8, 1.5};
  plot.events = {{30, "EXCESS_FORCE", Severity::kMajor, 2, 5, "N", Vec3::Zero()}};
  plot.cursor_s = 15;
  plot.moment_href_html = "?t=";
  const std::string svg = time_plot_svg(plot);
  // 44 + (748 - 44) * 15 / 60 = 220; the event at 396; 88 strips of 60 / 88 s, the first one's middle at 0.34 s.
  EXPECT_NE(svg.find("translate(220.0 0)"), std::string::npos);
  EXPECT_NE(svg.find("M390.5 "), std::string::npos);
  EXPECT_EQ(count(svg, "href=\"?t="), 89U);
  EXPECT_NE(svg.find("href=\"?t=0.34#moment\""), std::string::npos);
  EXPECT_NE(svg.find("data-end=\"60.000\""), std::string::npos);
  EXPECT_NE(svg.find("wanted 0.4 to 0.8 N"), std::string::npos);
  EXPECT_NE(svg.find("over 1.5 N"), std::string::npos);
  plot.moment_href_html.clear();
  plot.cursor_s = -1;
  EXPECT_EQ(count(time_plot_svg(plot), "href="), 0U);
  EXPECT_EQ(count(time_plot_svg(plot), "id=\"cursor\""), 0U);
}

TEST(TimePlotTest, KeepsThePeakOfEveryColumn) {
  Trace trace = sample_trace(0);
  trace.samples[3333].force_T = Vec3(3, 4, 0);  // one tick of 5 N
  TimePlot plot;
  plot.lines = {{&trace, false, "force", "#1d2630", ""}};
  // Top of the scale 5.4 N: 5 N stands at 258 - 246 * 5 / 5.4 = 30.2.
  EXPECT_NE(time_plot_svg(plot).find(",30.2 "), std::string::npos);
}

TEST(TimePlotTest, EventsFollowTheTracesBeginning) {
  Trace trace = sample_trace(5);
  for (TraceSample& sample : trace.samples) sample.t_s += 100;
  TimePlot plot;
  plot.lines = {{&trace, false, "force", "#1d2630", ""}};
  plot.events = {{130, "EXCESS_FORCE", Severity::kMajor, 2, 5, "N", Vec3::Zero()}};
  plot.begin_s = 100;
  EXPECT_NE(time_plot_svg(plot).find("Excess force at 30.0 s"), std::string::npos);
}

}  // namespace
}  // namespace trocar::review::desk_charts_test
