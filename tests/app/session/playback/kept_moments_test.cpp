// What is thinned out of a store of moments, and what is left of a run that somebody gave up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/session/playback/moment_store.h"
#include "app/session/playback/recorded_run.h"
#include "app/session/recording/recording_reader.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::kept_moments_test {
namespace {

using Stage = RecordedRun::Stage;

/// Numbered by its time and by a word of the tissue frame.
RunMoment numbered(int n) {
  RunMoment m;
  m.t_s = n;
  m.record.q[1] = 10.0 * n;
  m.status.message = std::to_string(n);
  m.tissue.stamp = static_cast<std::uint64_t>(n);
  m.tissue.slipped_m = 0.5 * n;
  return m;
}

std::set<int> times_in(const MomentStore& store, int last) {
  std::set<int> out;
  for (int n = 0; n <= last; ++n) out.insert(static_cast<int>(store.at(n).t_s));
  return out;
}

TEST(MomentThinning, NothingIsDroppedUntilThereIsOneTooMany) {
  MomentStore store(8);
  for (int n = 0; n < 8; ++n) store.add(numbered(n));
  EXPECT_EQ(times_in(store, 7), (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  store.add(numbered(8));
  EXPECT_EQ(times_in(store, 8), (std::set<int>{0, 2, 4, 6, 8}));
  store.add(numbered(9));
  EXPECT_EQ(times_in(store, 9), (std::set<int>{0, 2, 4, 6, 8})) << "every second of those that follow";
  EXPECT_EQ(store.at(9).t_s, 8);
  EXPECT_EQ(store.last_s(), 9);
  EXPECT_EQ(store.first_s(), 0);
}

TEST(MomentThinning, StepsStayEvenHoweverOftenItIsDoneForOddAndEvenRoom) {
  for (const std::size_t most : {1U, 2U, 3U, 7U, 8U, 13U, 64U}) {
    MomentStore store(most);
    for (int n = 0; n < 1000; ++n) {
      store.add(numbered(n));
      ASSERT_LE(store.size(), most) << n;
    }
    const std::set<int> kept = times_in(store, 999);
    ASSERT_EQ(kept.size(), store.size()) << most;
    EXPECT_EQ(*kept.begin(), 0);
    const int step = kept.size() > 1 ? *std::next(kept.begin()) : 1024;
    EXPECT_EQ(step & (step - 1), 0) << "a power of two: " << step;
    int wanted = 0;
    for (const int t : kept) EXPECT_EQ(t, std::exchange(wanted, wanted + step)) << most;
    EXPECT_GT(wanted, 999) << "none is missing at the end";
  }
}

TEST(MomentThinning, WhatIsLeftIsStillEachItsOwnMoment) {
  MomentStore store(10);
  for (int n = 0; n < 300; ++n) store.add(numbered(n));
  for (const int t : times_in(store, 299)) {
    const RunMoment m = store.at(t + 0.5);
    EXPECT_EQ(m.t_s, t);
    EXPECT_EQ(m.record.q[1], 10.0 * t);
    EXPECT_EQ(m.status.message, std::to_string(t));
    EXPECT_EQ(m.tissue.stamp, static_cast<std::uint64_t>(t));
    EXPECT_EQ(m.tissue.slipped_m, 0.5 * t);
  }
}

TEST(MomentThinning, GivesItsRoomBack) {
  MomentStore store(200);
  for (int n = 0; n < 200; ++n) store.add(numbered(n));
  const std::size_t full = store.bytes();
  store.add(numbered(200));
  EXPECT_EQ(store.size(), 101U);
  EXPECT_NEAR(static_cast<double>(store.bytes()), 101.0 / 200 * static_cast<double>(full),
              0.02 * static_cast<double>(full));
}

TEST(MomentThinning, OfTwoAtOneTimeTheLaterIsFound) {
  MomentStore store;
  store.add(numbered(1));
  RunMoment again = numbered(1);
  again.status.message = "later";
  store.add(again);
  EXPECT_EQ(store.size(), 2U);
  EXPECT_EQ(store.at(1).status.message, "later");
  EXPECT_EQ(store.at(0.5).status.message, "1") << "before the first: the first";
}

class GivenUpRun : public ::testing::Test {
 protected:
  RecordedRun run_until(double share) {
    return RecordedRun(file_, find_assets(), "", [share](double done) { return done < share; });
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = record_short(folder_ / "run.trec");
};

TEST_F(GivenUpRun, AtOnceThereIsOneMomentAndEverythingOfTheFile) {
  const RecordedRun run = run_until(0), whole(file_, find_assets());
  ASSERT_EQ(run.stage(), Stage::kStopped);
  EXPECT_TRUE(run.has_pictures());
  EXPECT_EQ(run.at(0).t_s, run.available_until());
  EXPECT_EQ(run.at(1e9).t_s, run.available_until());
  EXPECT_LT(run.available_until(), 0.1);
  EXPECT_EQ(run.begin_s(), whole.begin_s());
  EXPECT_EQ(run.end_s(), whole.end_s());
  EXPECT_EQ(run.failure(), "");
  EXPECT_EQ(run.torn(), "");
  ASSERT_EQ(run.grade().score, whole.grade().score);
  ASSERT_EQ(run.events().size(), whole.events().size());
  EXPECT_EQ(run.events().back().type, whole.events().back().type);
  const auto force = run.force_columns(20, 0, run.end_s()), all = whole.force_columns(20, 0, whole.end_s());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(force[i].high, all[i].high) << "forces come from the file";
}

TEST_F(GivenUpRun, WhatWasRunIsWhatTheWholeRunHasThere) {
  const RecordedRun run = run_until(0.5), whole(file_, find_assets());
  ASSERT_EQ(run.stage(), Stage::kStopped);
  EXPECT_GE(run.available_until(), 0.5 * run.end_s());
  EXPECT_LT(run.available_until(), 0.52 * run.end_s()) << "it stops at the next moment";
  EXPECT_LT(run.bytes(), whole.bytes());
  for (double t = 0; t < run.available_until(); t += 0.37) {
    const RunMoment a = run.at(t), b = whole.at(t);
    ASSERT_EQ(a.t_s, b.t_s);
    EXPECT_EQ(a.record.q, b.record.q);
    EXPECT_EQ(a.tissue.stamp, b.tissue.stamp);
    EXPECT_EQ(a.status.message, b.status.message);
  }
}

TEST_F(GivenUpRun, WhoNeverStopsItSeesTheEnd) {
  double told = 0;
  const RecordedRun run(file_, find_assets(), "", [&told](double done) {
    told = done;
    return true;
  });
  EXPECT_EQ(run.stage(), Stage::kWhole);
  EXPECT_GT(told, 0.98);
  EXPECT_LE(told, 1);
  EXPECT_EQ(run.outcome().state_hash, read_recording(file_).end->state_hash);
}

}  // namespace
}  // namespace trocar::kept_moments_test
