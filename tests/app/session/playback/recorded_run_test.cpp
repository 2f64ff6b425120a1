// A recording as a film: the moments are those of the run that was recorded, cut off or not, in the background or not.
#include "app/session/playback/recorded_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recorded_run_test {
namespace {

using test::message_of;
using Stage = RecordedRun::Stage;

struct Seen {
  double t_s;
  TickRecord record;
  DirectorStatus status;
  TissueFrame tissue;
};

void expect_same(const Seen& was, const RunMoment& is) {
  ASSERT_EQ(was.t_s, is.t_s);
  EXPECT_EQ(was.record.stylus.X_TI.p, is.record.stylus.X_TI.p);
  EXPECT_EQ(was.record.stylus.X_TI.R, is.record.stylus.X_TI.R);
  EXPECT_EQ(was.record.stylus.F_I_T.force, is.record.stylus.F_I_T.force);
  EXPECT_EQ(was.record.stylus.rendered_force_T, is.record.stylus.rendered_force_T);
  EXPECT_EQ(was.record.stylus.grip_force_n, is.record.stylus.grip_force_n);
  EXPECT_EQ(was.record.q, is.record.q);
  EXPECT_EQ(was.record.torque, is.record.torque);
  EXPECT_EQ(was.record.patch_stamp, is.record.patch_stamp);
  EXPECT_EQ(was.record.winding_c, is.record.winding_c);
  EXPECT_EQ(was.status.phase, is.status.phase);
  EXPECT_EQ(was.status.cue, is.status.cue);
  EXPECT_EQ(was.status.run_time_s, is.status.run_time_s);
  EXPECT_EQ(was.status.hold_progress, is.status.hold_progress);
  EXPECT_EQ(was.status.done, is.status.done);
  EXPECT_EQ(was.status.peak_force_n, is.status.peak_force_n);
  EXPECT_EQ(was.status.message, is.status.message);
  EXPECT_EQ(was.tissue.stamp, is.tissue.stamp);
  EXPECT_EQ(was.tissue.t_s, is.tissue.t_s);
}

class RecordedRuns : public ::testing::Test {
 protected:
  /// Keeps every `each`-th view beside the file.
  std::filesystem::path record(int each = 23) {
    return record_short(folder_ / "run.trec", "expert", [this, each, n = 0](const SessionView& v) mutable {
      if (n++ % each == 0) seen_.push_back({v.t_s, v.record, v.director.status(), *v.tissue});
    });
  }
  test::TemporaryFolder folder_;
  std::vector<Seen> seen_;
};

TEST_F(RecordedRuns, HaveTheMomentsOfTheRunThatWasRecorded) {
  const auto file = record();
  const RecordedRun run(file, find_assets());
  ASSERT_EQ(run.stage(), Stage::kWhole);
  ASSERT_GT(seen_.size(), 20u);
  for (const Seen& was : seen_) expect_same(was, run.at(was.t_s));
  const Recording recording = read_recording(file);
  EXPECT_EQ(run.outcome().state_hash, recording.end->state_hash) << "every tick and tissue frame";
  EXPECT_EQ(run.torn(), "");
  EXPECT_EQ(run.events().size(), recording.events.size());
  EXPECT_TRUE(run.grade().score.has_value());
  EXPECT_EQ(run.available_until(), run.end_s());
  EXPECT_NEAR(run.at(run.begin_s()).status.run_time_s, 0, 0.011) << "RUN begins where begin_s() says";
  EXPECT_NEAR(run.at(run.begin_s() + 2).status.run_time_s, 2, 0.021);
  EXPECT_LT(static_cast<double>(run.bytes()) / run.end_s(), 100e6 / 300) << "100 MB in 5 min, in proportion";
  RecordProperty("bytes_per_s", static_cast<int>(static_cast<double>(run.bytes()) / run.end_s()));
}

TEST_F(RecordedRuns, ForceColumnsHoldTheLowestAndHighestOfTheRows) {
  const auto file = record();
  const RecordedRun run(file, find_assets());
  const Trace trace = rebuild_trace(read_recording(file).ticks, 1000);
  const double from = run.begin_s(), to = run.end_s();
  const int n = 37;
  const auto force = run.force_columns(n, from, to), grip = run.grip_columns(n, from, to);
  ASSERT_EQ(force.size(), 37u);
  double top = 0;
  for (int i = 0; i < n; ++i) {
    double low = 1e9, high = -1e9, most_grip = 0;
    for (const TraceSample& s : trace.samples) {
      if (s.t_s < from + (to - from) / n * i - 1e-9 || s.t_s >= from + (to - from) / n * (i + 1) - 1e-9) continue;
      low = std::min(low, s.force_T.norm());
      high = std::max(high, s.force_T.norm());
      most_grip = std::max(most_grip, s.grip_n);
    }
    EXPECT_NEAR(force[static_cast<std::size_t>(i)].low, low, 1e-6);
    EXPECT_NEAR(force[static_cast<std::size_t>(i)].high, high, 1e-6);
    EXPECT_NEAR(grip[static_cast<std::size_t>(i)].high, most_grip, 1e-6);
    top = std::max(top, high);
  }
  EXPECT_GT(top, 0.2) << "something was touched";
  EXPECT_EQ(run.force_columns(0, from, to).size(), 0u);
  EXPECT_EQ(run.force_columns(3, to + 1, to + 2)[1].high, 0) << "beyond the end there is nothing";
  const auto narrow = run.force_columns(3, from + 1, from + 1.0005);
  EXPECT_EQ(narrow[1].high, narrow[1].low) << "narrower than a tick: the tick";
}

TEST_F(RecordedRuns, PlayUpToWhereTheRecordingWasCutOff) {
  const auto file = record();
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  double before_s = 0;
  for (const double share : {0.35, 0.6, 0.9}) {
    const auto part =
        folder_.write("cut.trec", bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const RecordedRun run(part, find_assets());
    EXPECT_EQ(run.stage(), Stage::kWhole);
    EXPECT_NE(run.torn(), "") << share;
    EXPECT_FALSE(run.grade().score.has_value());
    EXPECT_GT(run.end_s(), before_s);
    before_s = run.end_s();
    for (const Seen& was : seen_)
      if (was.t_s < run.end_s() - 0.02) expect_same(was, run.at(was.t_s));
  }
}

TEST_F(RecordedRuns, CanBeStopped) {
  std::vector<double> told;
  const RecordedRun run(record(), find_assets(), "", [&told](double share) {
    told.push_back(share);
    return share < 0.3;
  });
  EXPECT_EQ(run.stage(), Stage::kStopped);
  EXPECT_GT(run.available_until(), 0.2 * run.end_s());
  EXPECT_LT(run.available_until(), 0.4 * run.end_s());
  EXPECT_TRUE(run.has_pictures());
  EXPECT_THROW(run.outcome(), std::logic_error);
  EXPECT_EQ(run.at(1e9).t_s, run.available_until()) << "what was run until then stays";
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LE(told.size(), 101u) << "once a percent, not once a moment";
}

TEST_F(RecordedRuns, CanBeSeenWhileTheRestIsStillBeingRun) {
  record();
  RecordedRun run = RecordedRun::in_background(folder_ / "run.trec", find_assets());
  bool early = false;
  while (run.stage() != Stage::kWhole && run.stage() != Stage::kFailed) {
    if (run.has_pictures() && run.stage() == Stage::kReplaying) {
      early = true;
      const RunMoment newest = run.at(run.available_until());
      EXPECT_LE(newest.t_s, run.end_s());
      EXPECT_EQ(run.scene().setup.hand, "expert");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(run.failure(), "");
  EXPECT_TRUE(early);
  for (const Seen& was : seen_) expect_same(was, run.at(was.t_s));
}

TEST_F(RecordedRuns, AreGivenUpWhenNobodyWantsThemAnyMore) {
  record();
  { const RecordedRun at_once = RecordedRun::in_background(folder_ / "run.trec", find_assets()); }
  RecordedRun moved = RecordedRun::in_background(folder_ / "run.trec", find_assets());
  while (!moved.has_pictures()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  moved = RecordedRun::in_background(folder_ / "none.trec", find_assets());
  while (moved.stage() == Stage::kLoading) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(moved.stage(), Stage::kFailed);
  EXPECT_CONTAINS(moved.failure(), "none.trec");
  EXPECT_THROW(moved.scene(), std::logic_error);
  EXPECT_FALSE(moved.has_pictures());
}

TEST_F(RecordedRuns, WhatIsNoRecordingIsRefused) {
  const auto file = folder_.write("text.trec", "no recording at all");
  EXPECT_CONTAINS(message_of<InputError>([&] { RecordedRun(file, find_assets()); }), "text.trec");
}

TEST_F(RecordedRuns, AnotherOrganIsRefused) {
  const auto file = record();
  EXPECT_CONTAINS(message_of<InputError>([&] { RecordedRun(file, find_assets(), "phantom-abdomen"); }),
                  "not the organ of the recording");
}

}  // namespace
}  // namespace trocar::recorded_run_test
