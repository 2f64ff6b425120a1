// The report's part on stiffness: means of what touched, gaps where nothing did, words that agree with the numbers.
#include "trainees/markup/stiffness_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/sample_attempt.h"

namespace trocar::stiffness_plot_test {
namespace {

/// Ten seconds at 1 kHz: a touch from 2 to 4 s and one from 6 to 7 s.
Trace two_touches() {
  Trace trace;
  for (int i = 0; i < 10000; ++i) {
    TraceSample s;
    s.t_s = 3 + 0.001 * i;
    const double t = 0.001 * i;
    s.contact = (t >= 2 && t < 4) || (t >= 6 && t < 7);
    if (s.contact) {
      s.stiffness_n_per_m = 200;
      s.k_max_n_per_m = t < 4 ? 80 : 300;
      s.commanded_n = 2;
      s.rendered_n = t < 4 ? 0.8 : 1.9;
    }
    trace.samples.push_back(s);
  }
  return trace;
}

StiffnessReport run_report(bool clamped, double above) {
  StiffnessReport s;
  s.recorded = true;
  s.clamped = clamped;
  s.contact_ticks = 3000;
  s.k_max_min_n_per_m = 80.4;
  s.k_max_max_n_per_m = 300;
  s.asked_max_n_per_m = 200;
  s.share_min = 0.402;
  s.above_share = above;
  return s;
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(StiffnessColumns, AreMeansOfWhatTouches) {
  const auto columns = stiffness_columns(two_touches(), 100);
  ASSERT_GE(columns.size(), 30u);
  ASSERT_LE(columns.size(), 32u) << "three of ten seconds, and the edges";
  for (const StiffnessColumn& c : columns) {
    EXPECT_NEAR(c.asked, 200, 1e-9);
    EXPECT_NEAR(c.k_max, c.column < 50 ? 80 : 300, 1e-9) << c.column;
    EXPECT_NEAR(c.displayed, c.column < 50 ? 80 : 190, 1e-9) << c.column;
  }
}

TEST(StiffnessColumns, WhatIsNotKnownIsLeftOut) {
  Trace trace = two_touches();
  for (TraceSample& s : trace.samples) s.k_max_n_per_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(stiffness_columns(trace, 100).empty());
  EXPECT_TRUE(stiffness_columns(Trace{}, 100).empty());
}

TEST(StiffnessPlot, DrawsEachTouchByItself) {
  const std::string svg = stiffness_plot_svg(two_touches());
  EXPECT_EQ(count(svg, "<polyline"), 6) << "three curves, two touches";
  EXPECT_TRUE(has(svg, "stroke-dasharray")) << "K max told apart without colour";
  EXPECT_TRUE(has(svg, "N/m at the stylus"));
  EXPECT_FALSE(has(svg, "nan"));
}

TEST(StiffnessPlot, SaysWhenNothingWasTouched) {
  EXPECT_TRUE(has(stiffness_plot_svg(Trace{}), "nothing was touched"));
  EXPECT_EQ(count(stiffness_plot_svg(Trace{}), "<polyline"), 0);
}

TEST(StiffnessWords, FollowTheNumbers) {
  EXPECT_EQ(stiffness_words({}), "") << "an older recording";
  const std::string off = stiffness_words(run_report(false, 0.34)), on = stiffness_words(run_report(true, 0.34));
  EXPECT_TRUE(has(off, "clamp was off") && has(off, "34 %") && has(off, "40 %") && has(off, "80 to 300 N/m")) << off;
  EXPECT_TRUE(has(on, "clamp was on") && has(on, "softer")) << on;
  EXPECT_TRUE(has(stiffness_words(run_report(true, 0)), "None asked for more"));
  StiffnessReport free = run_report(false, 0);
  free.contact_ticks = 0;
  EXPECT_TRUE(has(stiffness_words(free), "nothing was touched"));
}

}  // namespace
}  // namespace trocar::stiffness_plot_test
