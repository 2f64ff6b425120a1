// The report's pictures of board exercises: every pen and block is there, with its errors, limits and carry share.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/sample_attempt.h"
#include "trainees/markup/board_plots.h"

namespace trocar::board_plots_test {
namespace {

bool has(const std::string& page, const std::string& words) { return page.find(words) != std::string::npos; }

int count(const std::string& text, const std::string& words) {
  int n = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
  return n;
}

Event event(double t_s, const char* type, int object, double value = 0, const char* unit = "") {
  Event e;
  e.t_s = t_s;
  e.type = type;
  e.object = object;
  e.value = value;
  e.unit = unit;
  return e;
}

std::vector<Event> pen_events() {
  return {event(1, "TARGET_LIT", 0),
          event(4, "TARGET_HELD", 0, 3.0, "s"),
          event(4, "POSITION_ERROR", 0, 0.0021, "m"),
          event(4, "ANGLE_ERROR", 0, 0.07, "rad"),
          event(19, "TARGET_TIMEOUT", 1, 15, "s"),
          event(25, "TARGET_HELD", 2, 6.0, "s"),
          event(25, "POSITION_ERROR", 2, 0.0034, "m"),
          event(25, "ANGLE_ERROR", 2, 0.02, "rad")};
}

TEST(PenOutcomes, AreReadFromTheEvents) {
  const auto pens = pen_outcomes(pen_events());
  ASSERT_EQ(pens.size(), 3U);
  EXPECT_EQ(pens[0].position_error_m, 0.0021);
  EXPECT_EQ(pens[0].angle_error_rad, 0.07);
  EXPECT_EQ(pens[0].time_s, 3.0);
  EXPECT_EQ(pens[0].timeouts, 0);
  EXPECT_FALSE(pens[1].position_error_m);
  EXPECT_EQ(pens[1].timeouts, 1);
  EXPECT_TRUE(pen_outcomes({}).empty());
}

TEST(PosePlot, ShowsEveryPenWithItsErrorsAndWhatIsAllowed) {
  const std::string plot = pose_plot_svg(pen_events(), {0.003, 0.14});
  for (const char* words : {"pen 1", "pen 2", "pen 3", ">2.1<", ">4.0<", ">3.4<", "\u00d71", "not matched", "allowed"})
    EXPECT_TRUE(has(plot, words)) << words;
  EXPECT_EQ(count(plot, "#d55e00\"/>") > 0, true);
  EXPECT_EQ(count(plot, "fill=\"#d55e00\""), 1) << "only the third pen's distance is over the tolerance";
  EXPECT_EQ(count(plot, "not matched"), 3) << "the second pen, in each panel";
}

TEST(PosePlot, SaysSoWhenNoPenWasLit) { EXPECT_TRUE(has(pose_plot_svg({}, {0.003, 0.14}), "no pen was lit")); }

/// Grip of 1 N throughout, except half a newton from 3 to 4 s.
Trace grip_trace() {
  Trace trace;
  for (int i = 0; i <= 6000; ++i) {
    TraceSample sample;
    sample.t_s = 10 + 0.001 * i;
    sample.grip_n = i >= 3000 && i < 4000 ? 0.5 : 1.0;
    trace.samples.push_back(sample);
  }
  return trace;
}

std::vector<Event> grip_events() {
  return {event(11, "GRASPED", 0),  event(12, "LIFTED", 0, 0.031, "m"), event(15, "SET_DOWN", 0),
          event(15.4, "PLACED", 0), event(15.5, "LIFTED", 2),           event(99, "CRUSH", 7)};
}

const std::vector<GripLimits> kBlocks = {{0.8, 1.5}, {0.5, 2.5}, {1.2, 4.0}};

TEST(Carries, RunFromLiftedToSetDownAndToTheEndOtherwise) {
  const auto found = carries(grip_trace(), grip_events(), kBlocks);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].block, 0);
  EXPECT_EQ(found[0].from_s, 12);
  EXPECT_EQ(found[0].to_s, 15);
  EXPECT_NEAR(found[0].share_in_window, 2.0 / 3, 1e-3) << "one of three seconds too loose";
  EXPECT_EQ(found[1].block, 2);
  EXPECT_EQ(found[1].to_s, 16) << "still in the air when the record ends";
  EXPECT_EQ(found[1].share_in_window, 0) << "1 N slips: 1.2 N is the least";
}

TEST(Carries, IgnoreObjectsThatAreNoBlocks) {
  EXPECT_TRUE(carries(grip_trace(), {event(12, "LIFTED", 5), event(13, "SET_DOWN", -1)}, kBlocks).empty());
  EXPECT_TRUE(carries({}, grip_events(), {}).empty());
}

TEST(GripPlot, ShowsWindowsAndCarryShares) {
  const std::string plot = grip_plot_svg(grip_trace(), grip_events(), kBlocks);
  for (const char* words : {"67 % of 3.0 s", "0 % of 0.5 s", "never carried", "Block 1, 0.8 to 1.5 N", "crushed above"})
    EXPECT_TRUE(has(plot, words)) << words;
  EXPECT_EQ(count(plot, "fill-opacity=\"0.17\""), 2) << "one window a carry";
}

TEST(GripPlot, SurvivesNonsense) {
  Trace trace = grip_trace();
  trace.samples[100].grip_n = std::nan("");
  EXPECT_FALSE(has(grip_plot_svg(trace, grip_events(), kBlocks), "nan"));
  EXPECT_FALSE(has(grip_plot_svg({}, {}, kBlocks), "nan"));
}

}  // namespace
}  // namespace trocar::board_plots_test
