// Forces over time from a recording: the graded window, no peak lost, and what is cut off is shown as far as it goes.
#include "app/window/attempt/force_trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/app/window/attempt/attempt_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::force_trace_test {
namespace {

using testing_support::event;
using testing_support::pressing_events;
using testing_support::pressing_trace;

TEST(ForceTrace, RunsFromStartToTheEnd) {
  const ForceTrace t = force_trace(pressing_trace(), pressing_events());
  EXPECT_NEAR(t.begin_s, 2, 1e-9);
  EXPECT_NEAR(t.end_s, 59, 1e-9);
  EXPECT_NEAR(static_cast<double>(t.t_s.size()), 57001, 1);
  EXPECT_EQ(t.t_s.size(), t.tip_n.size());
  EXPECT_EQ(t.t_s.size(), t.speed_mps.size());
}

TEST(ForceTrace, WithoutAStartItIsAllThereIs) {
  const ForceTrace t = force_trace(pressing_trace(10), {});
  EXPECT_EQ(t.begin_s, 0);
  EXPECT_NEAR(t.end_s, 9.999, 1e-9);
  EXPECT_TRUE(force_trace({}, pressing_events()).t_s.empty());
}

TEST(ForceTrace, ColumnsKeepEveryPeakAndEveryValley) {
  Trace trace = pressing_trace(20);
  trace.samples[12345].force_T = Vec3(0, 0, 9);
  const ForceTrace t = force_trace(trace, {});
  for (const int count : {1, 7, 100, 640, 5000}) {
    const auto columns = t.columns(t.tip_n, count, t.begin_s, t.end_s);
    ASSERT_EQ(columns.size(), static_cast<std::size_t>(count));
    double high = 0;
    for (const auto& c : columns) {
      EXPECT_TRUE(c.any);
      EXPECT_LE(c.low, c.high);
      high = std::max(high, c.high);
    }
    EXPECT_EQ(high, 9);
    EXPECT_EQ(columns[static_cast<std::size_t>(count * 12.345 / t.end_s)].high, 9);
  }
}

TEST(ForceTrace, ColumnsAgreeWithAPlainSearch) {
  const ForceTrace t = force_trace(pressing_trace(12), {});
  const auto columns = t.columns(t.tip_n, 50, 3, 8);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < t.t_s.size(); ++i) {
      const double share = (t.t_s[i] - 3.0) / 5.0;
      if (share < 0 || share > 1 || std::min<std::size_t>(49, static_cast<std::size_t>(50 * share)) != k) continue;
      low = std::min<double>(low, t.tip_n[i]);
      high = std::max<double>(high, t.tip_n[i]);
    }
    EXPECT_EQ(columns[k].low, low);
    EXPECT_EQ(columns[k].high, high);
  }
}

TEST(ForceTrace, WhatIsOutsideIsNotThere) {
  const ForceTrace t = force_trace(pressing_trace(5), {});
  for (const auto& c : t.columns(t.tip_n, 4, 100, 110)) EXPECT_FALSE(c.any);
  EXPECT_TRUE(t.columns(t.tip_n, 0, 0, 1).empty());
  EXPECT_FALSE(t.columns(t.tip_n, 3, 2, 2)[0].any);
}

TEST(ForceTrace, ReadsTheValueAtOrBeforeAMoment) {
  const ForceTrace t = force_trace(pressing_trace(5), {});
  EXPECT_EQ(t.at(t.tip_n, -1), 0);
  EXPECT_EQ(t.at(t.tip_n, 2.0004), t.tip_n[2000]);
  EXPECT_EQ(t.at(t.tip_n, 99), t.tip_n.back());
}

TEST(ForceTrace, SpeedIsThatOfTheTip) {
  Trace trace;
  for (int i = 0; i < 1000; ++i) {
    TraceSample s;
    s.t_s = 1e-3 * i;
    s.tip_T = Vec3(0.05 * s.t_s, 0, 0);
    trace.samples.push_back(s);
  }
  trace.samples[500].force_T = Vec3(NAN, 0, 0);
  const ForceTrace t = force_trace(trace, {});
  for (const float v : t.speed_mps) EXPECT_NEAR(v, 0.05, 1e-6);
  EXPECT_EQ(t.tip_n[500], 0) << "what cannot be represented is not drawn";
}

TEST(ForceTrace, IsReadFromARecordingWholeOrCutOff) {
  const test::TemporaryFolder folder;
  const std::string bytes = small_recording(4, 1000, 3);
  const auto write = [&](const char* name, const std::string& what) {
    const auto file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << what;
    return file;
  };
  const ForceTrace whole = load_force_trace(write("whole.trec", bytes));
  EXPECT_GT(whole.t_s.size(), 0u);
  const ForceTrace cut = load_force_trace(write("cut.trec", bytes.substr(0, bytes.size() * 6 / 10)));
  EXPECT_GT(cut.t_s.size(), 0u);
  EXPECT_LE(cut.end_s, whole.end_s);
  EXPECT_THROW(load_force_trace(write("none.trec", "not a recording")), InputError);
  EXPECT_THROW(load_force_trace(folder.path() / "missing.trec"), InputError);
}

}  // namespace
}  // namespace trocar::force_trace_test
